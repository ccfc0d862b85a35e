// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "lighting/results.h"
#include "lighting/run.h"
#include "lighting/study.h"

namespace clerestory::test {

/// A study of a model all of whose materials have one reflectance on both sides; no sky, no light yet.
lighting::Study grey_study(mesh::Model model, double reflectance);

/// The material of that name. Throws std::out_of_range where the model has none.
lighting::Material& material(lighting::Study& study, const std::string& name);

/// Lets the front of a material shine [lm/m²].
void shine(lighting::Material& material, double emission_lm_m2);

/// Adds sensors of one normal to the study's only grid.
void add_sensors(lighting::Study& study, std::span<const mesh::Point> points, const mesh::Vector& normal);

/// The same number of points along x and y in the middle of the cells of a rectangle at one height.
std::vector<mesh::Point> cell_centres(const mesh::Point& low, double width_m, double depth_m, int count);

/// Runs a study that nobody watches.
inline lighting::Results answer(const lighting::Study& study) {
  NoProgress nobody;
  return lighting::run(study, nobody);
}

}  // namespace clerestory::test
