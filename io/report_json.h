// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lighting/results.h"
#include "mesh/clean.h"
#include "mesh/discontinuity_selection.h"
#include "mesh/faces.h"
#include "mesh/rooms.h"

// Private to io/: what summary.json, inspect and clean say in the same words.
namespace clerestory::io {

using Json = nlohmann::ordered_json;

/// What marks a JSON file as ours: the value of `program`.
inline constexpr const char* kProgram = "clerestory";

/// name, became, why.
Json materials_json(const std::vector<lighting::Results::MaterialUse>& uses);

/// name, floor_area_m2, volume_m3, closed, source, openings.
/// @param rooms  in model coordinates
Json rooms_json(const std::vector<mesh::Room>& rooms);

/// kind → found, mended, and where some were left why: a list of reason and count.
Json defects_json(const mesh::CleanReport& report);

/// What of a model is no defect, though its surfaces share a place: contacts, uncut_crossings, two_sided_polygons.
Json meetings_json(const mesh::CleanReport& report);

/// found, kept, merged, within_tolerance, over_cap, sources.
Json shadow_lines_json(const mesh::LineSelection& selection, std::size_t sources);

/// triangles, their angles, and what lines they follow.
Json mesh_json(const mesh::MeshReport& report);

/// To a tenth of a millimetre, or of a square decimetre: more is noise.
double rounded(double value);

/// Each sentence once, in the order of its first appearance.
std::vector<std::string> without_repeats(std::vector<std::string> sentences);

/// The text of a file: indented, bad bytes of UTF-8 replaced.
std::string json_text(const Json& json);

}  // namespace clerestory::io
