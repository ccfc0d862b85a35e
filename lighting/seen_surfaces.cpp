// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/seen_surfaces.h"

#include <algorithm>

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Vector;

namespace {

/// A ray's end on a source, by its coordinates from the centroid.
struct End {
  ElementId source;
  double factor = 0.0;
  double u = 0.0;
  double v = 0.0;
};

/// The link to one source from all that ends on it.
Link link_of(const mesh::ElementTree& tree, std::span<const End> ends) {
  double factor = 0.0;
  double u = 0.0;
  double v = 0.0;
  for (const End& end : ends) {
    factor += end.factor;
    u += end.factor * end.u;
    v += end.factor * end.v;
  }
  Link link;
  link.by_rays = true;
  link.source = LinkSource::element(ends.front().source);
  link.factor = static_cast<float>(factor);
  const mesh::SecondMoments& area = tree.second_moments(ends.front().source);
  const double determinant = area.uu * area.vv - area.uv * area.uv;
  if (determinant <= 0.0) return link;
  link.moment_u = static_cast<float>((u * area.vv - v * area.uv) / determinant);
  link.moment_v = static_cast<float>((v * area.uu - u * area.uv) / determinant);
  return link;
}

}  // namespace

double illuminance_by(const Solution& solution, std::span<const SeenSurface> seen) {
  double lux = 0.0;
  for (const SeenSurface& one : seen) {
    const ElementId e = solution.element_at(one.node, one.at);
    if (e.valid()) lux += static_cast<double>(one.factor) * solution.luminous_radiosity_at(e, one.at, true);
  }
  return lux;
}

std::vector<Link> links_to_seen(const Solution& solution, ElementId receiver, std::span<const SeenSurface> seen,
                                const LinearValue& slope) {
  const mesh::ElementTree& tree = solution.tree();
  std::vector<End> ends;
  ends.reserve(seen.size());
  for (const SeenSurface& one : seen) {
    const ElementId source = solution.element_at(one.node, one.at);
    if (!source.valid()) continue;
    const Vector d = one.at - tree.centroid(source);
    ends.push_back({source, one.factor, dot(d, tree.axes(source).u), dot(d, tree.axes(source).v)});
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.source < b.source; });
  std::vector<Link> links;
  for (auto first = ends.begin(); first != ends.end();) {
    const auto last = std::find_if(first, ends.end(), [&](const End& end) { return end.source != first->source; });
    Link link = link_of(tree, std::span(first, last));
    link.receiver = receiver;
    link.slope_u = link.factor * slope.slope_u;
    link.slope_v = link.factor * slope.slope_v;
    links.push_back(link);
    first = last;
  }
  return links;
}

}  // namespace clerestory::lighting
