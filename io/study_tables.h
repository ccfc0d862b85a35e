// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/model_file.h"
#include "io/study_tree.h"
#include "lighting/perez.h"
#include "lighting/study.h"
#include "mesh/subdivision.h"

// The readers of the tables of a study: checked, with all defaults filled in. What they assume goes to study.assumptions.
namespace clerestory::io {

/// Where a study stands, and what was read for it.
struct StudyPlace {
  std::filesystem::path folder;              ///< that paths are relative to
  std::vector<std::filesystem::path> files;  ///< that were read
};

/// [model]: reads the model file into study.model.
/// Throws InputError for a model that is not there, of an unsupported format, or at fault.
ModelFile read_model_table(const StudyValue& root, StudyPlace& place, lighting::Study& study);

/// model.north and [site]: what the study leaves open is as the model's file says, in the tree too.
void read_site_table(StudyValue& root, const ModelSite& site, lighting::Study& study);

/// [parts]: replaces the control cages of study.model by triangles on their limit surfaces. Cages are the parts that the study
/// names as such, and those that the file tags.
/// Throws InputError with the model's file and line for a cage at fault, and for names that match no part.
mesh::SubdivisionReport read_parts_table(const StudyValue& root, const std::filesystem::path& model,
                                         lighting::Study& study);

/// [spectrum]: the bands. Throws InputError for weights that are none.
void read_spectrum_table(const StudyValue& root, lighting::Study& study);

/// [materials]: one material a model material. The study counts first, then names like glass, then the MTL, then orientation.
/// Throws InputError for entries that contradict themselves, and names that match no material.
void read_materials_table(const StudyValue& root, const ModelFile& model, lighting::Study& study);

/// Where the sun stands for a study, and what the weather is.
struct StudySun {
  mesh::Vector towards;  ///< unit vector in model coordinates
  std::string moment;    ///< as columns are called by it, "2026-03-21T1200"; empty where no time is given
  double altitude_deg = 0.0;
  std::optional<lighting::Irradiance> irradiance;  ///< of the weather file, where it is asked for
  int day_of_year = 80;                            ///< the 21st of March where no time is given
};

/// At the moments of sky.time with [site], each once, or by sky.sun_altitude and sky.sun_azimuth; none where neither is given. With sky.type =
/// "weather" the file of site.weather tells the irradiances, and the place where the study does not.
/// Throws InputError for what is missing or contradicts itself.
std::vector<StudySun> read_study_suns(const StudyValue& root, StudyPlace& place, lighting::Study& study);

/// [sky]. For the daylight factor it becomes the CIE overcast sky, in the tree too.
/// Throws InputError for keys that contradict each other, and for a sky without what it needs.
void read_sky_table(StudyValue& root, StudyPlace& place, lighting::Study& study);

/// [[luminaires]], each with its photometry; tables of several luminaires and arrays become one entry a luminaire. None for the daylight factor.
/// Throws InputError for photometric files at fault, and for places, directions and arrays that are none.
void read_luminaires_table(const StudyValue& root, StudyPlace& place, lighting::Study& study);

/// [fixtures]: the light fixtures of the model become luminaires where a pattern fits their type; the exact name counts before patterns, the first
/// of these. Those that none fits are told in study.assumptions. None for the daylight factor.
/// Throws InputError as read_luminaires_table(), and for names that fit no fixture.
void read_fixtures_table(const StudyValue& root, const std::vector<ModelFixture>& fixtures, StudyPlace& place,
                         lighting::Study& study);

/// [[grids]]. Throws InputError for names that are no file names or not unique, surfaces that the model does not have,
/// and sensor files at fault.
void read_grids_table(const StudyValue& root, StudyPlace& place, lighting::Study& study);

/// Throws InputError where a name cannot be that of a result's file, or is taken.
/// @param table  with the key name
/// @param what   "grid", "task": for the message
/// @param taken  in small letters; the name is added
void check_result_name(const StudyValue& table, std::string_view what, const std::string& name,
                       std::set<std::string>& taken);

/// [[observers]] and [[tasks]]; none for the daylight factor, which has no lamps. After the grids, whose names tasks may not have.
/// Throws InputError for places and directions that are none, and for tasks that ask nothing.
void read_observers_table(const StudyValue& root, lighting::Study& study);
void read_tasks_table(const StudyValue& root, lighting::Study& study);

/// [results] and [groups].
/// Throws InputError for names of groups that no column can bear.
void read_results_table(const StudyValue& root, lighting::Study& study);

/// [mesh].
void read_mesh_table(const StudyValue& root, lighting::Study& study);

/// [accuracy]. A share in per cent becomes a number, in the tree too.
void read_accuracy_table(StudyValue& root, lighting::Study& study);

}  // namespace clerestory::io
