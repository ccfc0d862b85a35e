// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/stored_solution.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lighting/links.h"
#include "lighting/radiosity.h"
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
  if (stored.materials != now.materials) refuse("glazing, openings or bands have changed since");
  if (stored.sources != now.sources) refuse("other surfaces or lamps shine than did");
}

void expect_whole(const StoredSolution& s, const Solution& solution) {
  const std::size_t count = s.elements.size();
  const bool fits = s.channels == solution.channels() && s.roots == solution.tree().roots().size() &&
                    s.irradiance.size() == count * s.channels && s.misfit_lux.size() == count &&
                    s.errors.size() == count && s.closing.size() == count &&
                    s.link_ends.size() == s.link_values.size() && s.group_nodes.size() == s.group_lux.size() &&
                    s.group_names.size() == s.group_strengths.size() && s.given_errors.size() == count + s.open.size();
  const auto finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  };
  const auto all_finite = [&](const auto& rows) { return std::all_of(rows.begin(), rows.end(), finite); };
  if (!fits || !finite(s.misfit_lux) || !all_finite(s.irradiance) || !all_finite(s.errors) ||
      !all_finite(s.link_values) || !all_finite(s.closing) || !all_finite(s.group_lux) || !all_finite(s.given_errors)) {
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

std::array<float, 3> row_of(const LinearValue& line) { return {line.value, line.slope_u, line.slope_v}; }

/// How a link was made, a bit each.
enum LinkBit : std::uint32_t { kByRays = 4, kSplitSmall = 8, kRough = 16, kMutual = 32 };
constexpr std::uint32_t kVisibilityBits = 3;

std::array<std::uint32_t, 3> ends_of(const Link& link) {
  const std::uint32_t made = static_cast<std::uint32_t>(link.visibility) | (link.by_rays ? kByRays : 0U) |
                             (link.split_small ? kSplitSmall : 0U) | (link.rough ? kRough : 0U) |
                             (link.mutual ? kMutual : 0U);
  return {link.receiver.value, link.source.number(), made};
}

Link link_of(const std::array<std::uint32_t, 3>& ends, const std::array<float, 8>& values) {
  Link link;
  link.receiver = ElementId(ends[0]);
  link.source = LinkSource::of_number(ends[1]);
  link.visibility = static_cast<mesh::Visibility>(ends[2] & kVisibilityBits);
  link.by_rays = (ends[2] & kByRays) != 0;
  link.split_small = (ends[2] & kSplitSmall) != 0;
  link.rough = (ends[2] & kRough) != 0;
  link.mutual = (ends[2] & kMutual) != 0;
  link.factor = values[0];
  link.slope_u = values[1];
  link.slope_v = values[2];
  link.moment_u = values[3];
  link.moment_v = values[4];
  link.error = values[5];
  link.back_error = values[6];
  link.noise = values[7];
  return link;
}

void store_elements(const Solution& solution, const SolutionErrors& errors, StoredSolution& stored) {
  stored.seed = errors.seed();
  for (const ElementId e : solution.elements()) {
    stored.elements.push_back(e.value);
    for (const LinearValue& v : solution.irradiance(e)) stored.irradiance.push_back(row_of(v));
    stored.misfit_lux.push_back(solution.misfit(e));
    stored.errors.push_back(errors.irradiance(e));
    stored.closing.push_back(row_of(solution.closing(e)));
  }
}

void store_transport(const Solution& solution, const Transport& transport, StoredSolution& stored) {
  stored.links = transport.links.size();
  for (const Link& link : transport.links) {
    stored.link_ends.push_back(ends_of(link));
    stored.link_values.push_back({link.factor, link.slope_u, link.slope_v, link.moment_u, link.moment_v, link.error,
                                  link.back_error, link.noise});
  }
  for (const SourceGroup& group : solution.scene().groups.all()) {
    stored.group_names.push_back(group.name);
    stored.group_strengths.push_back(group.strength);
  }
  for (const GroupDirect& direct : transport.groups) {
    stored.group_nodes.push_back({direct.node.value, direct.group});
    stored.group_lux.push_back(row_of(direct.lux));
  }
  for (const ElementId e : nodes_of(solution))
    stored.given_errors.push_back(
        {transport.given_errors[e.index()].noise2, transport.given_errors[e.index()].misfit2});
}

}  // namespace

std::vector<ElementId> nodes_of(const Solution& solution) {
  std::vector<ElementId> nodes = solution.elements();
  for (std::size_t i = 0; i < solution.tree().size(); ++i) {
    if (solution.is_open(ElementId(i))) nodes.push_back(ElementId(i));
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

LinearValue line_of(const std::array<float, 3>& row) { return {row[0], row[1], row[2]}; }

bool needs_solving(const StoredSolution& stored, const Scene& scene) {
  const SceneHash now = hash_of(scene);
  return stored.scene.reflectances != now.reflectances || stored.scene.light != now.light;
}

StoredSolution store(const Solution& solution, const Transport& transport, double accuracy) {
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
  store_elements(solution, transport.errors, stored);
  store_transport(solution, transport, stored);
  return stored;
}

void regrow(const StoredSolution& stored, Solution& solution) {
  expect_same(stored.scene, hash_of(solution.scene()));
  expect_whole(stored, solution);
  grow(stored, solution);
}

SolutionErrors restore(const StoredSolution& stored, Solution& solution) {
  regrow(stored, solution);
  std::vector<SolutionErrors::Samples> errors(solution.tree().size());
  std::vector<LinearValue> lines(stored.channels);
  for (std::size_t i = 0; i < stored.elements.size(); ++i) {
    const ElementId e(stored.elements[i]);
    for (std::size_t c = 0; c < stored.channels; ++c) lines[c] = line_of(stored.irradiance[i * stored.channels + c]);
    solution.set_irradiance(e, lines);
    solution.add_error(e, 0.0, double{stored.misfit_lux[i]} * stored.misfit_lux[i]);
    errors[e.index()] = stored.errors[i];
  }
  return {std::move(errors), stored.seed};
}

std::vector<Link> stored_links(const StoredSolution& stored, const Solution& solution) {
  const std::size_t nodes = solution.tree().size();
  std::vector<Link> links;
  links.reserve(stored.link_ends.size());
  for (std::size_t i = 0; i < stored.link_ends.size(); ++i) {
    const Link link = link_of(stored.link_ends[i], stored.link_values[i]);
    const bool fits = link.source.is_cluster() ? !link.mutual : link.source.element().index() < nodes;
    if (link.receiver.index() >= nodes || !fits) damaged();
    links.push_back(link);
  }
  return links;
}

}  // namespace clerestory::lighting
