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

/// Tells which elements' hemispheres are filled, by proven links.
class Filled {
 public:
  Filled(const Solution& solution, const Arrivals& arrivals) : solution_(solution), arrivals_(arrivals) {}

  /// Whether all that an element sees is proven visible, and fills its hemisphere, as seen from its centroid.
  [[nodiscard]] bool exactly(ElementId e) const { return is_proven(e) && std::abs(1.0 - seen_from(e)) <= kFilled; }
  /// The same for an element beside one that is filled. What that one sees leaves no gap: where links say the same of this one, in single
  /// precision and linear over their receivers, there is none here.
  [[nodiscard]] bool beside_filled(ElementId e) const {
    if (!is_proven(e)) return false;
    return std::abs(1.0 - linked(e)) <= kAlike || std::abs(1.0 - seen_from(e)) <= kFilled;
  }

 private:
  /// Elements beside a filled one are looked at closely where their links' factors add up to something else than 1 by more.
  static constexpr double kAlike = 0.01;

  [[nodiscard]] bool is_proven(ElementId e) const {
    for (ElementId up = e; up.valid(); up = solution_.tree().parent(up)) {
      const std::span<const Arrival> here = arrivals_.at(up);
      if (!std::all_of(here.begin(), here.end(), [](const Arrival& a) { return a.is_proven(); })) return false;
    }
    return true;
  }

  [[nodiscard]] double seen_from(ElementId e) const {
    const mesh::ElementTree& tree = solution_.tree();
    double sum = 0.0;
    for (ElementId up = e; up.valid(); up = tree.parent(up)) {
      for (const Arrival& arrival : arrivals_.at(up)) {
        const ElementId s = arrival.source().element();
        std::array<OutlineEdge, 3> scratch;
        sum += point_form_factor(tree.centroid(e), tree.normal(e), tree.outline(s, scratch), tree.normal(s));
      }
    }
    return sum;
  }

  [[nodiscard]] double linked(ElementId e) const {
    const mesh::ElementTree& tree = solution_.tree();
    double sum = 0.0;
    for (ElementId up = e; up.valid(); up = tree.parent(up)) {
      const Vector d = tree.centroid(e) - tree.centroid(up);
      const double u = dot(d, tree.axes(e).u);
      const double v = dot(d, tree.axes(e).v);
      for (const Arrival& a : arrivals_.at(up)) sum += a.factor() + a.slope_u() * u + a.slope_v() * v;
    }
    return sum;
  }

  const Solution& solution_;
  const Arrivals& arrivals_;
};

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
  using Sent = MeanAndMoments<double>;
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
      sent.add_part(sent_[child.index()], PlaceInParent<double>(tree, child));
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
  const mesh::ElementTree& tree = solution.tree();
  const Filled is_filled(solution, arrivals);
  const std::vector<ElementId> elements = solution.elements();
  // The first of those that hang on one node is looked at closely.
  std::vector<std::size_t> first(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const bool beside =
        i > 0 && tree.parent(elements[i]).valid() && tree.parent(elements[i]) == tree.parent(elements[i - 1]);
    first[i] = beside ? first[i - 1] : i;
  }
  std::vector<std::uint8_t> filled(elements.size());
  parallel_for(
      elements.size(),
      [&](std::size_t i) {
        if (first[i] == i) filled[i] = is_filled.exactly(elements[i]) ? 1 : 0;
      },
      16);
  parallel_for(
      elements.size(),
      [&](std::size_t i) {
        if (first[i] == i) return;
        const bool beside = filled[first[i]] != 0;
        filled[i] = (beside ? is_filled.beside_filled(elements[i]) : is_filled.exactly(elements[i])) ? 1 : 0;
      },
      16);
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
