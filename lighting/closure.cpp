// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/closure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lighting/form_factor.h"
#include "lighting/parallel.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::OutlineEdge;
using mesh::Vector;

namespace {

/// A hemisphere is filled where point form factors add up to 1 to this.
constexpr double kFilled = 1e-6;
/// Sums this close to 1 are done: links in single precision tell no more.
constexpr double kClosed = 3e-6;
constexpr std::size_t kMostRounds = 100;

/// Whether all that an element sees is proven visible, and fills its hemisphere.
bool is_filled(const Solution& solution, const Arrivals& arrivals, ElementId e) {
  const mesh::ElementTree& tree = solution.tree();
  double sum = 0.0;
  for (ElementId up = e; up.valid(); up = tree.parent(up)) {
    const std::span<const Arrival> here = arrivals.at(up);
    if (!std::all_of(here.begin(), here.end(), [](const Arrival& a) { return a.is_proven(); })) return false;
    for (const Arrival& arrival : here) {
      const ElementId s = arrival.source().element();
      std::array<OutlineEdge, 3> scratch;
      sum += point_form_factor(tree.centroid(e), tree.normal(e), tree.outline(s, scratch), tree.normal(s));
    }
  }
  return std::abs(1.0 - sum) <= kFilled;
}

/// A function over the surfaces, linear on each element: what the links make of it.
class Exchange {
 public:
  Exchange(const Solution& solution, const Arrivals& arrivals)
      : solution_(solution), arrivals_(arrivals), sent_(solution.tree().size()), received_(solution.tree().size()) {}

  /// What arrives at elements if all elements send `values` [nodes].
  void apply(const std::vector<LinearValue>& values, std::span<const ElementId> elements,
             std::vector<LinearValue>& arrived) {
    for (const ElementId root : solution_.tree().roots()) pull(root, values);
    std::fill(received_.begin(), received_.end(), Line{});
    parallel_for(
        arrivals_.receivers(),
        [&](std::size_t i) {
          Line& line = received_[arrivals_.receiver(i).index()];
          for (const Arrival& arrival : arrivals_.at(i)) add(arrival, line);
        },
        64);
    parallel_for(
        elements.size(), [&](std::size_t i) { arrived[i] = arrived_at(elements[i]); }, 64);
  }

 private:
  struct Sent {
    double mean = 0.0;
    double u = 0.0;
    double v = 0.0;
  };
  struct Line {
    double value = 0.0;
    double u = 0.0;
    double v = 0.0;
  };

  void pull(ElementId e, const std::vector<LinearValue>& values) {
    const mesh::ElementTree& tree = solution_.tree();
    Sent& sent = sent_[e.index()];
    if (!solution_.is_open(e)) {
      const Moments m = moments_of(values[e.index()], tree.second_moments(e));
      sent = {values[e.index()].value, m.u, m.v};
      return;
    }
    sent = {};
    for (std::size_t k = 0; k < tree.child_count(e); ++k) {
      const ElementId child(tree.first_child(e).index() + k);
      pull(child, values);
      const Sent& part = sent_[child.index()];
      const double share = tree.area(child) / tree.area(e);
      const Vector d = tree.centroid(child) - tree.centroid(e);
      sent.mean += share * part.mean;
      sent.u += share * (part.u + part.mean * dot(d, tree.axes(e).u));
      sent.v += share * (part.v + part.mean * dot(d, tree.axes(e).v));
    }
  }

  void add(const Arrival& arrival, Line& line) const {
    const LinkSource source = arrival.source();
    const Sent sent = source.is_cluster() ? Sent{1.0, 0.0, 0.0} : sent_[source.element().index()];
    line.value += arrival.factor() * sent.mean + arrival.moment_u() * sent.u + arrival.moment_v() * sent.v;
    line.u += arrival.slope_u() * sent.mean;
    line.v += arrival.slope_v() * sent.mean;
  }

  [[nodiscard]] LinearValue arrived_at(ElementId e) const {
    const mesh::ElementTree& tree = solution_.tree();
    Line sum;
    for (ElementId up = e; up.valid(); up = tree.parent(up)) {
      const Vector d = tree.centroid(e) - tree.centroid(up);
      const Line& line = received_[up.index()];
      sum.value += line.value + line.u * dot(d, tree.axes(e).u) + line.v * dot(d, tree.axes(e).v);
      sum.u += line.u;
      sum.v += line.v;
    }
    return {static_cast<float>(sum.value), static_cast<float>(sum.u), static_cast<float>(sum.v)};
  }

  const Solution& solution_;
  const Arrivals& arrivals_;
  std::vector<Sent> sent_;      ///< [nodes]
  std::vector<Line> received_;  ///< [nodes]
};

std::vector<ElementId> filled_elements(const Solution& solution, const Arrivals& arrivals) {
  const std::vector<ElementId> elements = solution.elements();
  std::vector<std::uint8_t> filled(elements.size());
  parallel_for(
      elements.size(), [&](std::size_t i) { filled[i] = is_filled(solution, arrivals, elements[i]) ? 1 : 0; }, 16);
  std::vector<ElementId> found;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (filled[i] != 0) found.push_back(elements[i]);
  }
  return found;
}

}  // namespace

void close_hemispheres(Solution& solution, const Arrivals& arrivals) {
  const std::vector<ElementId> filled = filled_elements(solution, arrivals);
  if (filled.empty()) return;
  Exchange exchange(solution, arrivals);
  const mesh::ElementTree& tree = solution.tree();
  std::vector<LinearValue> scale(tree.size(), LinearValue{1.0F, 0.0F, 0.0F});
  std::vector<LinearValue> arrived(filled.size());
  for (std::size_t round = 0; round < kMostRounds; ++round) {
    exchange.apply(scale, filled, arrived);
    double worst = 0.0;
    for (std::size_t i = 0; i < filled.size(); ++i) {
      const ElementId e = filled[i];
      LinearValue& own = scale[e.index()];
      const LinearValue sum = product(own, arrived[i], tree.second_moments(e));
      const double slope = tree.radius(e) * std::hypot(sum.slope_u, sum.slope_v);
      worst = std::max(worst, std::max(std::abs(sum.value - 1.0), slope));
      own.value /= std::sqrt(sum.value);
      own.slope_u -= 0.5F * sum.slope_u;
      own.slope_v -= 0.5F * sum.slope_v;
    }
    if (worst <= kClosed) break;
  }
  for (const ElementId e : filled) solution.close(e, scale[e.index()]);
}

std::vector<double> factor_sums(const Solution& solution, const Arrivals& arrivals,
                                std::span<const ElementId> elements) {
  const mesh::ElementTree& tree = solution.tree();
  std::vector<LinearValue> scale(tree.size());
  for (const ElementId e : elements) scale[e.index()] = solution.closing(e);
  std::vector<LinearValue> arrived(elements.size());
  Exchange(solution, arrivals).apply(scale, elements, arrived);
  std::vector<double> sums;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const ElementId e = elements[i];
    sums.push_back(product(solution.closing(e), arrived[i], tree.second_moments(e)).value);
  }
  return sums;
}

}  // namespace clerestory::lighting
