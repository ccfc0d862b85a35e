// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "lighting/photometry.h"

namespace clerestory::io {

/// More bytes than any photometric file has.
inline constexpr std::uint64_t kLargestPhotometry = std::uint64_t{32} << 20;
/// More angles of one kind than any goniophotometer's file has.
inline constexpr double kMostAngles = 3601;
/// Brighter than any lamp [cd, lm, W].
inline constexpr double kMostCandela = 1e12;

/// What is wrong with what a photometric file says once it is read whole: throws InputError where its light has no flux. Adds notes on light that
/// is not stated for a part of the sphere, on lamps outshone by their luminaire, and on a flux that is not the one stated.
void check_photometry(lighting::Photometry& photometry, const std::string& file);

}  // namespace clerestory::io
