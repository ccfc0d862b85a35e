// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lighting/linear_value.h"
#include "lighting/scene.h"
#include "mesh/element_tree.h"

namespace clerestory::lighting {

/// The unknown: irradiance and radiosity of the elements, nodes × channels. Nodes above the open ones carry averages. A node is open
/// when its children take part; nodes that take part and are not open are the elements of the solution.
class Solution {
 public:
  Solution(const Scene& scene, mesh::ElementTree tree);

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const mesh::ElementTree& tree() const { return tree_; }
  [[nodiscard]] std::size_t channels() const { return scene_->channels; }

  [[nodiscard]] bool is_open(mesh::ElementId e) const { return open_[e.index()] != 0; }
  /// Makes the children of a node take part, splitting it if it has none. Precondition: the node above is open. Serial.
  void open(mesh::ElementId e);
  /// The most elements that there should be from here on; no limit at first. open() does as it is told, its callers ask.
  void limit_elements(std::size_t most) { most_elements_ = most; }
  /// Elements that there still may be more; 0 where there are too many.
  [[nodiscard]] std::size_t elements_left() const { return std::max(most_elements_, element_count_) - element_count_; }
  /// Elements that opening a node makes more.
  [[nodiscard]] std::size_t gained_by_opening(mesh::ElementId e) const;
  /// Whether opening a node keeps to the limit.
  [[nodiscard]] bool may_open(mesh::ElementId e) const { return gained_by_opening(e) <= elements_left(); }
  /// Splits a triangle without making its children take part: they are there to be told apart. Serial.
  void divide(mesh::ElementId e);

  /// The element that holds a point of a region of a face side; invalid where the side carries none.
  [[nodiscard]] mesh::ElementId element_at(mesh::FaceSide side, std::uint32_t region, const mesh::Point& point) const;
  /// The same from a triangle of the tree that holds it, whatever has been split since; invalid from an invalid one.
  [[nodiscard]] mesh::ElementId element_at(mesh::ElementId triangle, const mesh::Point& point) const;
  [[nodiscard]] std::size_t element_count() const { return element_count_; }
  /// All elements, in order of their ids.
  [[nodiscard]] std::vector<mesh::ElementId> elements() const;

  /// Light that arrives straight from sky and point sources, given at any node [lux per channel].
  [[nodiscard]] std::span<LinearValue> direct(mesh::ElementId e) {
    return std::span(direct_).subspan(e.index() * channels(), channels());
  }
  /// Irradiance by links of the node itself, without what its parents hand down.
  [[nodiscard]] std::span<LinearValue> gathered(mesh::ElementId e) {
    return std::span(gathered_).subspan(e.index() * channels(), channels());
  }
  [[nodiscard]] std::span<const LinearValue> gathered(mesh::ElementId e) const {
    return std::span(gathered_).subspan(e.index() * channels(), channels());
  }
  /// Takes away all light and its errors; elements and what closes them stay.
  void darken();
  void clear_gathered() { std::fill(gathered_.begin(), gathered_.end(), LinearValue{}); }
  /// Irradiance of an element in all [lux]; valid after push_pull().
  [[nodiscard]] std::span<const LinearValue> irradiance(mesh::ElementId e) const {
    return std::span(irradiance_).subspan(e.index() * channels(), channels());
  }
  /// Gives an element what another solution of the same tree has; for its light alone, nothing is handed on.
  void set_irradiance(mesh::ElementId e, std::span<const LinearValue> values) {
    std::copy(values.begin(), values.end(), irradiance_.begin() + static_cast<std::ptrdiff_t>(e.index() * channels()));
  }
  /// Scales what an element exchanges by links, both ways, so that its form factors add up to what they must; linear over the element,
  /// 1 at first. Takes effect with the next push_pull().
  void close(mesh::ElementId e, const LinearValue& scale) { closing_[e.index()] = scale; }
  [[nodiscard]] const LinearValue& closing(mesh::ElementId e) const { return closing_[e.index()]; }
  /// Whether the exchange of an element is scaled: all that surrounds it is wholly seen and fills its hemisphere.
  [[nodiscard]] bool is_closed(mesh::ElementId e) const { return !(closing(e) == kUnscaled); }
  /// What links take from a node: its radiosity, and that of an element as it is scaled.
  using Sent = MeanAndMoments<float>;
  [[nodiscard]] Sent sent(mesh::ElementId e, std::size_t channel) const;
  /// Mean radiosity of a node [lm/m²]; valid after push_pull(). Above the elements: of what they send.
  [[nodiscard]] std::span<const float> radiosity(mesh::ElementId e) const {
    return std::span(radiosity_).subspan(e.index() * channels(), channels());
  }
  /// First moments of the radiosity about the centroid, per area [lm/m², times m].
  [[nodiscard]] std::span<const Moments> moments(mesh::ElementId e) const {
    return std::span(moments_).subspan(e.index() * channels(), channels());
  }
  /// Luminance-weighted mean radiosity, and the standard deviation inside the node from the line through it.
  [[nodiscard]] float radiosity_mean(mesh::ElementId e) const { return mean_[e.index()]; }
  [[nodiscard]] float radiosity_deviation(mesh::ElementId e) const { return deviation_[e.index()]; }
  /// Variance of the radiosity inside a node, lines included.
  [[nodiscard]] float radiosity_variance(mesh::ElementId e) const { return variance_[e.index()]; }

  /// Adds to the squared error of what a node receives itself [lux²]: of its mean, and of what the line over the node misses elsewhere.
  void add_error(mesh::ElementId e, double noise2_lux2, double misfit2_lux2) {
    noise2_[e.index()] += static_cast<float>(noise2_lux2);
    misfit2_[e.index()] += static_cast<float>(misfit2_lux2);
  }
  /// Squared errors of what a node receives itself [lux²]: as add_error() has them.
  struct Errors {
    float noise2 = 0.0F;
    float misfit2 = 0.0F;
  };
  /// Of all nodes.
  [[nodiscard]] std::vector<Errors> errors() const;
  /// As errors() gave them.
  void set_errors(std::span<const Errors> errors);
  /// Standard errors of what a node receives itself [lux].
  [[nodiscard]] float noise(mesh::ElementId e) const { return std::sqrt(noise2_[e.index()]); }
  [[nodiscard]] float misfit(mesh::ElementId e) const { return std::sqrt(misfit2_[e.index()]); }
  /// Luminance-weighted reflectance.
  [[nodiscard]] float mean_reflectance(mesh::ElementId e) const {
    return luminance(scene_->side_reflectance(tree_.face_side(e)), scene_->channel_weights);
  }

  /// Luminance-weighted illuminance at a point of an element, by its line, which may be below zero at its edges [lux].
  [[nodiscard]] double illuminance_at(mesh::ElementId e, const mesh::Point& point) const;
  /// The same in one channel.
  [[nodiscard]] double illuminance_at(mesh::ElementId e, const mesh::Point& point, std::size_t channel) const;
  /// Radiosity at a point of an element, emission left out unless asked for [lm/m², channel].
  [[nodiscard]] float radiosity_at(mesh::ElementId e, const mesh::Point& point, std::size_t channel,
                                   bool with_emission) const;
  /// The same of all channels by their weights [lm/m²].
  [[nodiscard]] float luminous_radiosity_at(mesh::ElementId e, const mesh::Point& point, bool with_emission) const;

  /// Hands irradiance down to the elements and radiosity up to the roots. Returns the change of reflected flux that this made,
  /// as a share of all reflected flux.
  double push_pull();

 private:
  static constexpr LinearValue kUnscaled{1.0F, 0.0F, 0.0F};

  void push(mesh::ElementId e, const mesh::ElementId* parent);
  /// Scales what came to an element by links.
  void apply_closing(mesh::ElementId e);
  void pull(mesh::ElementId e);
  void pull_element(mesh::ElementId e);
  void pull_children(mesh::ElementId e);
  void set_deviation(mesh::ElementId e);
  void grow();
  /// From here on e is the highest node above its start triangles that is not open, or one of these.
  void put_on_top(mesh::ElementId e);

  const Scene* scene_;
  mesh::ElementTree tree_;
  std::vector<mesh::ElementId> top_;  ///< [start triangles] the highest node above each that is not open, or itself
  std::size_t element_count_;
  std::size_t most_elements_ = std::numeric_limits<std::size_t>::max();
  std::vector<std::uint8_t> open_;
  std::vector<LinearValue> direct_;
  std::vector<LinearValue> gathered_;
  std::vector<LinearValue> irradiance_;
  std::vector<float> radiosity_;
  std::vector<Moments> moments_;
  std::vector<float> mean_;
  std::vector<float> variance_;  ///< inside the node, luminance
  std::vector<float> deviation_;
  std::vector<float> noise2_;
  std::vector<float> misfit2_;
  std::vector<LinearValue> closing_;
  std::vector<float> change_;  ///< of an element's radiosity in the last push_pull, luminance
};

}  // namespace clerestory::lighting
