// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/stored_solution.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "lighting/arrivals.h"
#include "lighting/known_light.h"
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
                    s.arrivals.size() == s.arrival_errors.size() && s.arrivals.size() == s.arrivals_made.size() &&
                    s.group_nodes.size() == s.group_lux.size() && s.group_names.size() == s.group_strengths.size() &&
                    s.group_names.size() == s.group_kinds.size() && s.group_names.size() == s.group_sources.size() &&
                    s.group_error_nodes.size() == s.group_errors.size() &&
                    s.given_errors.size() == count + s.open.size() && s.given_lm.size() == s.given_errors.size();
  const auto finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  };
  const auto all_finite = [&](const auto& rows) { return std::all_of(rows.begin(), rows.end(), finite); };
  if (!fits || !finite(s.misfit_lux) || !all_finite(s.irradiance) || !all_finite(s.errors) ||
      !all_finite(s.arrival_errors) || !all_finite(s.closing) || !all_finite(s.group_lux) ||
      !all_finite(s.given_errors) || !finite(s.given_lm) || !all_finite(s.group_errors)) {
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
enum MadeBit : std::uint32_t { kSplitSmall = 1, kRough = 2 };

Arrival arrival_of(const Arrival::Words& words, std::size_t nodes, std::size_t clusters) {
  const std::optional<Arrival> arrival = Arrival::of_words(words);
  if (!arrival) damaged();
  const LinkSource source = arrival->source();
  if (source.is_cluster() ? source.cluster() >= clusters : source.element().index() >= nodes) damaged();
  return *arrival;
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
  const Arrivals& arrivals = transport.arrivals;
  stored.links = arrivals.count();
  for (std::size_t i = 0; i < arrivals.receivers(); ++i) {
    stored.receivers.push_back({arrivals.receiver(i).value, static_cast<std::uint32_t>(arrivals.at(i).size())});
    for (const Arrival& arrival : arrivals.at(i)) stored.arrivals.push_back(arrival.words());
    for (const ArrivalError& error : arrivals.errors_at(i)) {
      stored.arrival_errors.push_back({error.error, error.noise});
      stored.arrivals_made.push_back((error.split_small ? kSplitSmall : 0U) | (error.rough ? kRough : 0U));
    }
  }
  for (const ElementId e : nodes_of(solution)) {
    const Solution::Errors& errors = transport.given_errors[e.index()];
    stored.given_errors.push_back({errors.noise2, errors.misfit2});
    stored.given_lm.push_back(transport.given_lm[e.index()]);
  }
}

void store_light(const KnownLight& light, StoredSolution& stored) {
  for (const SourceGroup& group : light.groups) {
    stored.group_names.push_back(group.name);
    stored.group_strengths.push_back(group.strength);
    stored.group_kinds.push_back(static_cast<std::uint32_t>(group.kind));
    stored.group_sources.push_back(group.source);
  }
  for (const GroupDirect& direct : light.direct) {
    stored.group_nodes.push_back({direct.node.value, direct.group});
    stored.group_lux.push_back(row_of(direct.lux));
  }
  for (const GroupError& error : light.errors) {
    stored.group_error_nodes.push_back({error.node.value, error.group});
    stored.group_errors.push_back({error.errors.noise2, error.errors.misfit2});
  }
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

void store(const StartMesh& start, StoredSolution& stored) {
  for (const mesh::FaceLine& line : start.lines) {
    const auto& [a, b] = line.ends;
    stored.start_faces.push_back(line.face.value);
    stored.start_lines.push_back({a.x, a.y, a.z, b.x, b.y, b.z});
  }
  for (std::uint32_t f = 0; f < start.refined.size(); ++f) {
    if (start.refined[f] != 0) stored.start_refined.push_back(f);
  }
}

StartMesh start_of(const StoredSolution& stored, const Scene& scene) {
  expect_same(stored.scene, hash_of(scene));
  if (stored.start_faces.size() != stored.start_lines.size()) damaged();
  StartMesh start{{}, std::vector<std::uint8_t>(scene.faces.count(), 0)};
  for (std::size_t i = 0; i < stored.start_faces.size(); ++i) {
    const std::array<double, 6>& p = stored.start_lines[i];
    const bool finite = std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
    if (stored.start_faces[i] >= scene.faces.count() || !finite) damaged();
    start.lines.push_back({mesh::FaceId(stored.start_faces[i]), {mesh::Point{p[0], p[1], p[2]}, {p[3], p[4], p[5]}}});
  }
  for (const std::uint32_t f : stored.start_refined) {
    if (f >= scene.faces.count()) damaged();
    start.refined[f] = 1;
  }
  return start;
}

bool needs_solving(const StoredSolution& stored, const Scene& scene) {
  const SceneHash now = hash_of(scene);
  return stored.scene.reflectances != now.reflectances || stored.scene.light != now.light;
}

StoredSolution store(const Solution& solution, const Transport& transport, const KnownLight& light, double accuracy) {
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
  store_light(light, stored);
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

KnownLight stored_light(const StoredSolution& stored, const Solution& solution) {
  KnownLight light;
  for (std::size_t g = 0; g < stored.group_names.size(); ++g) {
    if (stored.group_kinds[g] > static_cast<std::uint32_t>(SourceGroup::Kind::kLamps)) damaged();
    light.groups.push_back({stored.group_names[g], static_cast<SourceGroup::Kind>(stored.group_kinds[g]),
                            stored.group_strengths[g], stored.group_sources[g]});
  }
  const auto expect_known = [&](const std::array<std::uint32_t, 2>& where) {
    if (where[0] >= solution.tree().size() || where[1] >= light.groups.size()) damaged();
  };
  for (std::size_t i = 0; i < stored.group_nodes.size(); ++i) {
    expect_known(stored.group_nodes[i]);
    light.direct.push_back(
        {ElementId(stored.group_nodes[i][0]), stored.group_nodes[i][1], line_of(stored.group_lux[i])});
  }
  for (std::size_t i = 0; i < stored.group_error_nodes.size(); ++i) {
    expect_known(stored.group_error_nodes[i]);
    light.errors.push_back({ElementId(stored.group_error_nodes[i][0]),
                            stored.group_error_nodes[i][1],
                            {stored.group_errors[i][0], stored.group_errors[i][1]}});
  }
  return light;
}

Arrivals stored_arrivals(const StoredSolution& stored, const Solution& solution, std::size_t clusters) {
  const std::size_t nodes = solution.tree().size();
  std::vector<ElementId> receivers;
  std::vector<std::size_t> starts{0};
  for (const auto& [node, count] : stored.receivers) {
    const bool ascends = receivers.empty() || node > receivers.back().value;
    if (node >= nodes || !ascends || count > stored.arrivals.size() - starts.back()) damaged();
    receivers.emplace_back(node);
    starts.push_back(starts.back() + count);
  }
  if (starts.back() != stored.arrivals.size()) damaged();
  std::vector<Arrival> arrivals;
  arrivals.reserve(stored.arrivals.size());
  for (const Arrival::Words& words : stored.arrivals) arrivals.push_back(arrival_of(words, nodes, clusters));
  std::vector<ArrivalError> errors;
  errors.reserve(stored.arrivals.size());
  for (std::size_t k = 0; k < stored.arrivals.size(); ++k) {
    const auto& [error, noise] = stored.arrival_errors[k];
    const std::uint32_t made = stored.arrivals_made[k];
    errors.push_back({error, noise, (made & kSplitSmall) != 0, (made & kRough) != 0});
  }
  return {std::move(receivers), std::move(starts), std::move(arrivals), std::move(errors)};
}

}  // namespace clerestory::lighting
