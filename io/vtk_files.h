// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/result_context.h"
#include "lighting/element_mesh.h"
#include "lighting/results.h"
#include "mesh/model.h"

namespace clerestory::io {

/// Writes a grid as VTK XML polygons (.vtp): one quadrilateral a sensor where the grid has cells, one vertex a sensor
/// where it has none, in the order of the sensors. Cell data: `id`, `normal` and the light_columns(). Field data as in write_surfaces_vtp(), and the name of the `grid`.
/// Positions are in double precision [m, model coordinates]; corners closer than 1 µm are one point, so that ParaView
/// can smooth across cells. The bytes depend on the arguments alone, not on locale, time or threads.
/// Throws MachineError when the file cannot be written whole.
void write_grid_vtp(const std::filesystem::path& file, const lighting::Results& results,
                    std::span<const lighting::GridResult> moments, const ResultContext& context);

/// Writes the solution on the surfaces as VTK XML polygons (.vtp), one triangle a side of an element (`side` 0 front,
/// 1 back, wound the other way). Cell data: `illuminance_lux`, `error_lux`, `radiosity_lm_m2`, `luminance_cd_m2`,
/// `reflectance`, `side`, `level`, and the indices `part`, `material` and `room` (-1: none) into the field arrays
/// `part_names`, `material_names`, `room_names`. Point data: `illuminance_lux`, smooth inside regions and split where
/// light is discontinuous. Arrays of light at one of several moments have `_MOMENT` behind their names. Field data in words: `units`, `sky`, `study`, `version`; and the number
/// `horizontal_illuminance_lux`, unobstructed.
/// Throws MachineError when the file cannot be written whole.
void write_surfaces_vtp(const std::filesystem::path& file, const lighting::Results& results,
                        const ResultContext& context);

/// Writes a model as VTK XML polygons (.vtp), in double precision: of each polygon the outer loop. Cell data: the indices `part` and
/// `material` into the field arrays `part_names` and `material_names`; `units` in words.
/// Throws MachineError when the file cannot be written whole.
void write_model_vtp(const std::filesystem::path& file, const mesh::Model& model);

/// Writes where the rooms are not closed as VTK XML points (.vtp), one a hole to the outside, at its middle. Cell data: `room` (an
/// index into the field array `room_names`), `area_m2`. Field data as in write_surfaces_vtp().
/// Throws MachineError when the file cannot be written whole.
void write_leaks_vtp(const std::filesystem::path& file, const lighting::Results& results, const ResultContext& context);

/// Writes the places of defects as VTK XML points (.vtp), one a defect [m, model coordinates]. Cell data: `kind` (an index into the
/// field array `kind_names`), `mended` (0 or 1), `polygon` (of the model as read, from 0), `size_m` (how bad), `note` in words.
/// Throws MachineError when the file cannot be written whole.
void write_defects_vtp(const std::filesystem::path& file, const mesh::CleanReport& report);

/// Writes the elements of a study as VTK XML polygons (.vtp), one triangle a side. Cell data: `side` (0 front, 1 back, wound the other way),
/// `level`, `size_m` (longest edge), `min_angle_deg`, `face`, `region` and `patch` (of the face), `shade` (0 faces no source, 1 lit, 2
/// penumbra, 3 umbra), and the indices `part` and `material` into the field arrays `part_names`, `material_names`.
/// Throws MachineError when the file cannot be written whole.
void write_elements_vtp(const std::filesystem::path& file, const lighting::ElementMesh& elements,
                        const ResultContext& context);

/// Writes lines of discontinuity as VTK XML polygons (.vtp), one line a cell. Cell data: `order` (0, 1, 2), `no_sky` (0 or 1), `side`, and
/// the indices `source` into the field array `source_names`, `occluder` and `part` into `part_names`.
/// Throws MachineError when the file cannot be written whole.
void write_discontinuities_vtp(const std::filesystem::path& file, const lighting::ElementLines& lines,
                               const ResultContext& context);

/// Whether write_leaks_vtp() has anything to write.
bool has_leaks(const lighting::Results& results);

/// One file that a collection opens.
struct VtmEntry {
  std::string block;  ///< the name that ParaView shows
  std::string file;   ///< relative to the collection's folder
};

/// Writes a VTK multi-block collection (.vtm) that opens the given .vtp files at once.
/// Throws MachineError when the file cannot be written whole.
void write_result_vtm(const std::filesystem::path& file, const std::vector<VtmEntry>& entries);

}  // namespace clerestory::io
