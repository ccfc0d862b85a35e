// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/stored_solution.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lighting/scene.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "mesh/error.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

constexpr const char* kAgain = "run the study again with --save-solution";

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("", 0, "the stored solution is of another study: " + what, kAgain);
}

[[noreturn]] void damaged() { throw InputError("", 0, "the stored solution is damaged", kAgain); }

void expect_same(const SceneHash& stored, const SceneHash& now) {
  if (stored.model != now.model) refuse("the model has changed since");
  if (stored.materials != now.materials) refuse("materials have changed since");
  if (stored.sources != now.sources) refuse("the sky or the lamps have changed since");
}

void expect_whole(const StoredSolution& s, const Solution& solution) {
  const std::size_t count = s.elements.size();
  const bool fits = s.channels == solution.channels() && s.roots == solution.tree().roots().size() &&
                    s.irradiance.size() == count * s.channels && s.misfit_lux.size() == count &&
                    s.errors.size() == count;
  const auto finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  };
  if (!fits || !finite(s.misfit_lux) || !std::all_of(s.irradiance.begin(), s.irradiance.end(), finite) ||
      !std::all_of(s.errors.begin(), s.errors.end(), finite)) {
    damaged();
  }
}

void grow(const StoredSolution& stored, Solution& solution) {
  const mesh::ElementTree& tree = solution.tree();
  for (const std::uint32_t e : stored.divided) {
    if (e >= tree.size() || !tree.is_triangle(ElementId(e)) || tree.has_children(ElementId(e))) damaged();
    solution.divide(ElementId(e));
  }
  for (const std::uint32_t e : stored.open) {
    if (e >= tree.size() || !tree.has_children(ElementId(e))) damaged();
    solution.open(ElementId(e));
  }
  const std::vector<ElementId> elements = solution.elements();
  if (!std::equal(elements.begin(), elements.end(), stored.elements.begin(), stored.elements.end(),
                  [](ElementId e, std::uint32_t number) { return e.value == number; })) {
    damaged();
  }
}

}  // namespace

StoredSolution store(const Solution& solution, const SolutionErrors& errors, double accuracy) {
  const mesh::ElementTree& tree = solution.tree();
  StoredSolution stored;
  stored.scene = hash_of(solution.scene());
  stored.accuracy = accuracy;
  stored.channels = static_cast<std::uint32_t>(solution.channels());
  stored.roots = static_cast<std::uint32_t>(tree.roots().size());
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const ElementId e(i);
    if (tree.is_triangle(e) && tree.has_children(e)) stored.divided.push_back(e.value);
    if (solution.is_open(e)) stored.open.push_back(e.value);
  }
  std::sort(stored.divided.begin(), stored.divided.end(), [&](std::uint32_t a, std::uint32_t b) {
    return tree.first_child(ElementId(a)) < tree.first_child(ElementId(b));
  });
  stored.seed = errors.seed();
  for (const ElementId e : solution.elements()) {
    stored.elements.push_back(e.value);
    for (const LinearValue& v : solution.irradiance(e)) stored.irradiance.push_back({v.value, v.slope_u, v.slope_v});
    stored.misfit_lux.push_back(solution.misfit(e));
    stored.errors.push_back(errors.irradiance(e));
  }
  return stored;
}

SolutionErrors restore(const StoredSolution& stored, Solution& solution) {
  expect_same(stored.scene, hash_of(solution.scene()));
  expect_whole(stored, solution);
  grow(stored, solution);
  std::vector<SolutionErrors::Samples> errors(solution.tree().size());
  std::vector<LinearValue> lines(stored.channels);
  for (std::size_t i = 0; i < stored.elements.size(); ++i) {
    const ElementId e(stored.elements[i]);
    for (std::size_t c = 0; c < stored.channels; ++c) {
      const auto& [value, slope_u, slope_v] = stored.irradiance[i * stored.channels + c];
      lines[c] = {value, slope_u, slope_v};
    }
    solution.set_irradiance(e, lines);
    solution.add_error(e, 0.0, double{stored.misfit_lux[i]} * stored.misfit_lux[i]);
    errors[e.index()] = stored.errors[i];
  }
  return {std::move(errors), stored.seed};
}

}  // namespace clerestory::lighting
