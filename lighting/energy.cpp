// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "lighting/closure.h"
#include "lighting/light_paths.h"
#include "lighting/luminaire_mounting.h"
#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "lighting/web_sampler.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

/// Rays that measure what leaves: 0.2 % of the flux at worst, nothing in closed scenes.
constexpr std::uint32_t kRays = 1U << 16U;

/// The share of a ray that ends on opaque surfaces.
struct Landing {
  double share = 0.0;
  void surface(const SurfacePoint&, float weight, bool) { share += weight; }
  void sky(const Vector&, float, bool) {}
};

bool is_pane(const Solution& solution, ElementId e) { return solution.scene().is_pane(solution.tree().face_side(e)); }

double mean_direct(Solution& solution, ElementId e) {
  // What is given at a node or above it; slopes do not change means of nodes, but they do those of their parts.
  const mesh::ElementTree& tree = solution.tree();
  double sum = 0.0;
  for (ElementId up = e; up.valid(); up = tree.parent(up)) {
    const Vector d = tree.centroid(e) - tree.centroid(up);
    const auto direct = solution.direct(up);
    for (std::size_t c = 0; c < direct.size(); ++c) {
      sum += solution.scene().channel_weights[c] * (direct[c].value + direct[c].slope_u * dot(d, tree.axes(e).u) +
                                                    direct[c].slope_v * dot(d, tree.axes(e).v));
    }
  }
  return sum;
}

double irradiance_mean(const Solution& solution, ElementId e) {
  double sum = 0.0;
  const auto irradiance = solution.irradiance(e);
  for (std::size_t c = 0; c < irradiance.size(); ++c) sum += solution.scene().channel_weights[c] * irradiance[c].value;
  return sum;
}

/// The share of the flux that elements send out which lands on opaque surfaces, and for the same elements the sum of the form
/// factors that the links give them.
struct Measured {
  double landed = 0.0;
  double factors = 0.0;
};

Measured measure(const Solution& solution, const std::vector<ElementId>& elements,
                 const std::vector<double>& flux_before, const std::vector<double>& factor_sums, std::uint64_t seed) {
  const Scene& scene = solution.scene();
  const mesh::ElementTree& tree = solution.tree();
  const double all = flux_before.back();
  constexpr std::uint32_t kBatch = 1024;
  std::vector<Measured> batches(kRays / kBatch);
  parallel_for(batches.size(), [&](std::size_t b) {
    const SobolPoints points(mesh::hash(seed, 4711));
    for (std::uint32_t k = 0; k < kBatch; ++k) {
      const auto i = static_cast<std::uint32_t>(b) * kBatch + k;
      const double wanted = all * (i + 0.5) / kRays;
      const auto found = std::upper_bound(flux_before.begin() + 1, flux_before.end() - 1, wanted);
      const auto n = static_cast<std::size_t>(found - flux_before.begin()) - 1;
      const ElementId e = elements[n];
      const Vector& normal = tree.normal(e);
      const Point at = tree.sample(e, points.at(i, 0), points.at(i, 1)) + scene.rays->offset_m() * normal;
      Landing landing;
      follow(scene, at, cosine_direction(tree.axes(e), points.at(i, 2), points.at(i, 3)), 1.0F,
             PathRule{PathRule::Part::kAll, -1, true}, landing);
      batches[b].landed += landing.share / kRays;
      batches[b].factors += factor_sums[n] / kRays;
    }
  });
  Measured sum;
  for (const Measured& m : batches) {
    sum.landed += m.landed;
    sum.factors += m.factors;
  }
  return sum;
}

/// Where a ray from a luminaire starts, in a direction of its own axes; nothing where what it is flush with takes it.
std::optional<Point> start(const Luminaire& luminaire, const std::vector<mesh::FaceId>& flush, const Vector& own) {
  if (own.z <= 0.0) return light_start(luminaire, flush);
  if (!flush.empty()) return std::nullopt;
  return luminaire.at + (luminaire.at - light_start(luminaire, flush));
}

/// The flux of the luminaires that lands on opaque surfaces [lm].
double landed_of_luminaires(const Scene& scene, std::uint64_t seed) {
  constexpr std::uint32_t kRaysEach = 1U << 12U;
  std::vector<double> landed(scene.luminaires.size());
  parallel_for(landed.size(), [&](std::size_t k) {
    const Luminaire& luminaire = scene.luminaires[k];
    if (luminaire.flux_lm() <= 0.0) return;
    const WebSampler sampler(*luminaire.web);
    const SobolPoints points(mesh::hash(mesh::hash(seed, 4712), k));
    Landing landing;
    for (std::uint32_t i = 0; i < kRaysEach; ++i) {
      const WebSample s = sampler.sample(points.at(i, 0), points.at(i, 1));
      const auto from = start(luminaire, scene.flush_faces[k], s.direction);
      if (!from || s.weight <= 0.0) continue;
      const Vector d = luminaire.place(s.direction) - luminaire.at;
      follow(scene, *from, d, static_cast<float>(s.weight), PathRule{PathRule::Part::kAll, -1, true}, landing);
    }
    landed[k] = luminaire.flux_lm() * landing.share / kRaysEach;
  });
  return std::accumulate(landed.begin(), landed.end(), 0.0);
}

/// Sum of |A_r F_rs - A_s F_sr| over the pairs linked both ways, as a share of what they exchange.
double reciprocity(const Solution& solution, const Arrivals& arrivals) {
  const mesh::ElementTree& tree = solution.tree();
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> exchange;
  double differs = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < arrivals.receivers(); ++i) {
    const ElementId receiver = arrivals.receiver(i);
    for (const Arrival& arrival : arrivals.at(i)) {
      if (arrival.source().is_cluster() || arrival.by_rays() || arrival.is_back()) continue;
      const std::uint32_t r = receiver.value;
      const std::uint32_t s = arrival.source().element().value;
      const double g = tree.area(receiver) * arrival.factor();
      if (arrival.is_mutual()) {
        all += g;
        continue;
      }
      const auto other = exchange.find({s, r});
      if (other == exchange.end()) {
        exchange[{r, s}] += g;
      } else {
        differs += std::abs(g - other->second);
        all += std::max(g, other->second);
      }
    }
  }
  return all > 0.0 ? differs / all : 0.0;
}

}  // namespace

EnergyBalance energy_balance(Solution& solution, const Transport& transport, std::uint64_t seed) {
  const mesh::ElementTree& tree = solution.tree();
  const Scene& scene = solution.scene();
  EnergyBalance balance;
  const std::vector<ElementId> elements = solution.elements();
  std::vector<double> flux_before{0.0};
  for (const ElementId e : elements) {
    const double area = tree.area(e);
    // What panes mirror is still on its way from the surfaces that sent it.
    const bool pane = is_pane(solution, e);
    const double sent = pane ? 0.0 : area * solution.radiosity_mean(e);
    flux_before.push_back(flux_before.back() + std::max(0.0, sent));
    if (pane) continue;
    const double own = luminance(scene.side_exitance(tree.face_side(e)), scene.channel_weights);
    balance.emitted_lm += area * own;
    balance.received_lm += area * mean_direct(solution, e);
    balance.absorbed_lm += area * irradiance_mean(solution, e) - (sent - area * own);
  }
  balance.received_lm = std::max(0.0, balance.received_lm - transport.by_luminaires_lm);
  balance.emitted_lm += luminaire_flux(scene);
  const double sent = flux_before.back();
  const double in = balance.emitted_lm + balance.received_lm;
  if (sent > 0.0) {
    const Measured measured =
        measure(solution, elements, flux_before, factor_sums(solution, transport.arrivals, elements), seed);
    balance.left_lm = sent * (1.0 - measured.landed);
    balance.closure = std::abs(measured.factors - measured.landed);
  }
  balance.left_lm += luminaire_flux(scene) - landed_of_luminaires(scene, seed);
  balance.residual = in > 0.0 ? (in - balance.absorbed_lm - balance.left_lm) / in : 0.0;
  balance.reciprocity = reciprocity(solution, transport.arrivals);
  return balance;
}

std::optional<std::string> imbalance_note(const EnergyBalance& balance, double accuracy) {
  constexpr double kTold = 2.0;  // times the accuracy: below is the noise of surfaces that hardly matter to the sensors
  const double share = std::abs(balance.residual);
  if (share <= kTold * accuracy) return std::nullopt;
  return fmt::format(
      "surfaces take {:.1f} % {} light than there is, which the errors stated do not account for: values may be wrong "
      "by as much; ask for a finer accuracy and compare",
      100.0 * share, balance.residual > 0.0 ? "less" : "more");
}

}  // namespace clerestory::lighting
