// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/model.h"

namespace clerestory::io {

/// How far a file has been read where a tag stands.
struct ObjPlace {
  std::string file;
  std::uint64_t line = 0;
  std::size_t vertices = 0;
  std::size_t polygons = 0;
};

/// Takes a `t` line of OpenSubdiv's OBJ files, split into words, to the tags of the model: crease, corner, hole, interpolateboundary,
/// creasemethod and smoothtriangles. Vertices and faces count from 0 over the file; the last three hold for the part in which they
/// stand, which they mark as a control cage. Tags of texture coordinates are passed over.
/// Throws InputError for a line that is not as OpenSubdiv writes it, and for vertices or faces that do not stand before it.
/// @param part  makes the id of the part that the line stands in
/// @return false for a tag that is not known, hierarchical edits among them
/// Source: OpenSubdiv 3.5, regression/common/shape_utils.h.
bool read_obj_tag(const std::vector<std::string_view>& words, const ObjPlace& place, mesh::PartId part,
                  mesh::SubdivisionTags& tags);

}  // namespace clerestory::io
