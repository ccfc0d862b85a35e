// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesh/clean.h"

namespace clerestory::io {

/// What the user can do about the defects of a kind, in one sentence without a full stop.
std::string defect_advice(const mesh::Defect& defect, mesh::CleanOptions::Repair repair);

/// The worst places of a kind: those that were left first, then the larger ones, else in the order of the file.
std::vector<mesh::Defect::Place> worst_places(const mesh::Defect& defect, std::size_t count = 3);

/// Why defects of a kind were left, each reason with how many of the places told, in the order in which they first come.
std::vector<std::pair<std::string, std::size_t>> reasons_of_left(const mesh::Defect& defect);

/// Whether the clean-up had to leave a defect.
bool has_unmended(const mesh::CleanReport& report);

}  // namespace clerestory::io
