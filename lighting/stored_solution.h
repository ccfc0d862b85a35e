// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lighting/energy_balance.h"
#include "lighting/scene_hash.h"
#include "mesh/faces.h"
#include "mesh/ids.h"

namespace clerestory::lighting {

class Arrivals;
class Solution;
class SolutionErrors;
struct KnownLight;
struct LinearValue;
struct Scene;
struct Transport;

/// What the start mesh of a tree is made with, besides the scene.
struct StartMesh {
  std::vector<mesh::FaceLine> lines;  ///< that elements do not cross, such as the edges of sun patches
  std::vector<std::uint8_t> refined;  ///< [faces] as mesh::MeshOptions has it
};

/// A solution as it is kept: what its element tree has become, by numbers of nodes, and what its elements receive. The start of the tree
/// follows from the scene, which the hash holds fast, its lines, and which faces are refined.
struct StoredSolution {
  SceneHash scene;
  double accuracy = 0.0;  ///< asked for
  std::uint32_t channels = 1;
  std::vector<std::uint32_t> start_faces;          ///< that have lines which elements do not cross
  std::vector<std::array<double, 6>> start_lines;  ///< of these, both ends [m, local coordinates]
  std::vector<std::uint32_t> start_refined;        ///< faces whose start mesh is refined, ascending
  std::uint32_t roots = 0;                         ///< of the tree
  std::vector<std::uint32_t> divided;              ///< nodes, in the order in which they were
  std::vector<std::uint32_t> open;                 ///< nodes whose children take part, in order
  std::vector<std::uint32_t> elements;
  std::vector<std::array<float, 3>>
      irradiance;                            ///< [elements × channels] value [lux] and slopes [lux/m], as LinearValue
  std::vector<float> misfit_lux;             ///< [elements] what a line misses elsewhere than in its middle
  std::vector<std::array<float, 8>> errors;  ///< [elements] samples of what the irradiance may be wrong by [lux]
  std::uint64_t seed = 0;                    ///< of these samples
  EnergyBalance energy;
  std::uint64_t links = 0;  ///< that it was made with

  // What it can be solved with anew.
  std::vector<std::array<std::uint32_t, 2>> receivers;  ///< node, and how many links arrive there
  std::vector<std::array<std::uint32_t, 4>> arrivals;   ///< at the receivers, one after the other, as Arrival::Words
  std::vector<std::array<float, 2>> arrival_errors;     ///< error and noise, as ArrivalError
  std::vector<std::uint32_t> arrivals_made;             ///< bits: 1 the smaller end is split, 2 rough
  std::vector<std::array<float, 3>> closing;            ///< [elements] as LinearValue
  std::vector<std::string> group_names;
  std::vector<double> group_strengths;
  std::vector<std::uint32_t> group_kinds;                       ///< as SourceGroup::Kind
  std::vector<std::uint64_t> group_sources;                     ///< as SourceGroup::source
  std::vector<std::array<std::uint32_t, 2>> group_nodes;        ///< node and group that it has direct light of
  std::vector<std::array<float, 3>> group_lux;                  ///< of these [lux, lux/m], as LinearValue
  std::vector<std::array<std::uint32_t, 2>> group_error_nodes;  ///< node and group whose errors are known apart
  std::vector<std::array<float, 2>> group_errors;               ///< of these, as GroupError
  std::vector<std::array<float, 2>> given_errors;               ///< [nodes that take part] Transport::given_errors
  std::vector<double> given_lm;                                 ///< [nodes that take part] Transport::given_lm
};

/// All but the energy balance, which the solution does not know. The links' errors must be kept.
/// @param light  that the solution's direct light is made of
StoredSolution store(const Solution& solution, const Transport& transport, const KnownLight& light, double accuracy);

/// The direct light of a stored solution whose tree has been regrown. Throws InputError where it is damaged.
KnownLight stored_light(const StoredSolution& stored, const Solution& solution);

/// Adds what the start mesh of the tree was made with.
void store(const StartMesh& start, StoredSolution& stored);

/// The same. Throws InputError where it is damaged, or the scene is another, and says what has changed.
StartMesh start_of(const StoredSolution& stored, const Scene& scene);

/// Whether surfaces reflect, or sources shine, otherwise than when the solution was stored.
bool needs_solving(const StoredSolution& stored, const Scene& scene);

/// Grows the tree of a fresh solution of the same scene to what the stored one's was.
/// Throws InputError where the two do not fit, and says what has changed.
void regrow(const StoredSolution& stored, Solution& solution);

/// Makes a fresh solution of the same scene, with the same light, what the stored one was, and gives its errors.
/// Throws InputError where the two do not fit, and says what has changed.
SolutionErrors restore(const StoredSolution& stored, Solution& solution);

/// The nodes of a solution that take part, in order.
std::vector<mesh::ElementId> nodes_of(const Solution& solution);

LinearValue line_of(const std::array<float, 3>& row);

/// The links of a stored solution whose tree has been regrown, with their errors. Throws InputError for damaged ones.
Arrivals stored_arrivals(const StoredSolution& stored, const Solution& solution, std::size_t clusters);

}  // namespace clerestory::lighting
