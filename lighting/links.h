// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/element_tree.h"
#include "mesh/ids.h"
#include "mesh/shafts.h"

namespace clerestory::lighting {

/// Where a link's light comes from: a node of the element tree, or a cluster of the cluster tree.
class LinkSource {
 public:
  LinkSource() = default;
  static LinkSource element(mesh::ElementId e) { return LinkSource(e.value); }
  static LinkSource cluster(std::uint32_t c) { return LinkSource(c | kCluster); }

  [[nodiscard]] bool is_cluster() const { return (value_ & kCluster) != 0; }
  [[nodiscard]] mesh::ElementId element() const { return mesh::ElementId(value_); }
  [[nodiscard]] std::uint32_t cluster() const { return value_ & ~kCluster; }
  /// As it is kept in files.
  [[nodiscard]] std::uint32_t number() const { return value_; }
  static LinkSource of_number(std::uint32_t number) { return LinkSource(number); }
  bool operator==(const LinkSource&) const = default;

 private:
  static constexpr std::uint32_t kCluster = 0x80000000U;
  explicit LinkSource(std::uint32_t value) : value_(value) {}
  std::uint32_t value_ = 0;
};

/// Light from a source to a receiver, linear on both: the mean irradiance of the receiver and its slopes per unit of the source's
/// mean radiosity, and the mean irradiance per unit of the first moments of the source's radiosity. Constant sources would lose
/// flux, because what a receiver sees of a source and how bright it is there go together.
/// A mutual link carries light the other way as well, from the receiver to the source: see reversed().
struct Link {
  mesh::ElementId receiver;
  LinkSource source;
  float factor = 0.0F;   ///< form factor times visibility, transmittances included
  float slope_u = 0.0F;  ///< [1/m]
  float slope_v = 0.0F;
  float moment_u = 0.0F;  ///< [1/m]
  float moment_v = 0.0F;
  float error = 0.0F;       ///< of the factor over the receiver: what the line misses, and the noise of the visibility
  float back_error = 0.0F;  ///< the same of the factor of a mutual link the other way
  float noise = 0.0F;       ///< the part of the error that the mean over the receiver has
  mesh::Visibility visibility = mesh::Visibility::kPartial;
  bool by_rays = false;  ///< what rays of the receiver ended on, not an estimate of the pair
  bool split_small =
      false;  ///< the light differs over the smaller end: refining that one tells more than refining the larger
  bool rough = false;   ///< made of a few rays, because it could not matter with the light there was
  bool mutual = false;  ///< between two elements, both of which receive by it
};

/// A mutual link as its source receives by it. What is exchanged is one symmetric kernel, linear in the places on both pieces, so that
/// reciprocity holds exactly: what one piece's slope is, is the other's moment.
inline Link reversed(const Link& link, const mesh::ElementTree& tree) {
  const auto ratio = static_cast<float>(tree.area(link.receiver) / tree.area(link.source.element()));
  Link back = link;
  back.receiver = link.source.element();
  back.source = LinkSource::element(link.receiver);
  back.factor = link.factor * ratio;
  back.slope_u = link.moment_u * ratio;
  back.slope_v = link.moment_v * ratio;
  back.moment_u = link.slope_u * ratio;
  back.moment_v = link.slope_v * ratio;
  back.noise = link.noise * ratio;
  back.error = link.back_error;
  back.back_error = link.error;
  return back;
}

}  // namespace clerestory::lighting
