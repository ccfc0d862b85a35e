// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mesh/model.h"

namespace clerestory::io {

/// The unit of length of a model file.
enum class LengthUnit { kMetre, kCentimetre, kMillimetre, kInch, kFoot };

/// Which axis of a model file points up.
enum class UpAxis { kZ, kY };

/// The unit that the study's words m, cm, mm, in, ft name; nothing for any other word.
std::optional<LengthUnit> length_unit(std::string_view word);

/// The study's word for a unit.
std::string_view unit_word(LengthUnit unit);

double metres_per(LengthUnit unit);

/// The unit that a comment of a file's header names, as in "File units = meters" or "z up, metres".
/// Nothing where it names none, or several.
std::optional<LengthUnit> unit_in_comment(std::string_view comment);

/// The unit in which a model of that vertical extent is most probably drawn: metres below 100, then centimetres, from 1500
/// millimetres. A storey has 2.4 to 6 m, so that this holds for buildings of up to 15 m in centimetres, up to 100 m in metres, and
/// from 1.5 m in millimetres. Inches and feet are never guessed.
LengthUnit guess_unit(double vertical_extent);

/// Brings a model from its file's unit and axis to metres with z up. Handedness stays: y up becomes (x, -z, y).
void to_metres_z_up(mesh::Model& model, LengthUnit unit, UpAxis up);

}  // namespace clerestory::io
