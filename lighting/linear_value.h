// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/element_tree.h"

namespace clerestory::lighting {

/// Irradiance that varies linearly over a planar node: value at the centroid [lux] and slopes along the side's axes [lux/m].
struct LinearValue {
  float value = 0.0F;
  float slope_u = 0.0F;
  float slope_v = 0.0F;

  bool operator==(const LinearValue&) const = default;
};

/// First moments of a value over a planar node, per area.
struct Moments {
  float u = 0.0F;
  float v = 0.0F;
};

/// The product of two linear functions over a node, as the line that fits it best but for third moments: as an operator it is
/// symmetric under integration over the node.
inline LinearValue product(const LinearValue& a, const LinearValue& b, const mesh::SecondMoments& area) {
  const double covariance = area.uu * a.slope_u * b.slope_u +
                            area.uv * (a.slope_u * b.slope_v + a.slope_v * b.slope_u) + area.vv * a.slope_v * b.slope_v;
  return {a.value * b.value + static_cast<float>(covariance), a.value * b.slope_u + a.slope_u * b.value,
          a.value * b.slope_v + a.slope_v * b.value};
}

/// First moments of a line over a node.
inline Moments moments_of(const LinearValue& line, const mesh::SecondMoments& area) {
  return {static_cast<float>(area.uu * line.slope_u + area.uv * line.slope_v),
          static_cast<float>(area.uv * line.slope_u + area.vv * line.slope_v)};
}

/// Where a node lies in the one above it.
template <class Real>
struct PlaceInParent {
  Real share{};  ///< of the area
  Real du{};     ///< from the centroid, along the axes [m]
  Real dv{};

  PlaceInParent() = default;
  /// Precondition: the node is no root.
  PlaceInParent(const mesh::ElementTree& tree, mesh::ElementId node) {
    const mesh::ElementId parent = tree.parent(node);
    const mesh::Vector d = tree.centroid(node) - tree.centroid(parent);
    share = static_cast<Real>(tree.area(node) / tree.area(parent));
    du = static_cast<Real>(dot(d, tree.axes(parent).u));
    dv = static_cast<Real>(dot(d, tree.axes(parent).v));
  }
};

/// A value over a planar node: its mean and its first moments about the centroid, per area.
template <class Real>
struct MeanAndMoments {
  Real mean{};
  Real u{};
  Real v{};

  /// Adds what the value is over a part of the node.
  template <class PlaceReal>
  void add_part(const MeanAndMoments& part, const PlaceInParent<PlaceReal>& place) {
    mean += place.share * part.mean;
    u += place.share * (part.u + part.mean * place.du);
    v += place.share * (part.v + part.mean * place.dv);
  }
};

}  // namespace clerestory::lighting
