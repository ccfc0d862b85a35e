// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/seen_surfaces.h"

#include <map>

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Vector;

namespace {

struct Sum {
  double factor = 0.0;
  double u = 0.0;
  double v = 0.0;
};

Link link_of(const mesh::ElementTree& tree, ElementId source, const Sum& sum) {
  Link link;
  link.by_rays = true;
  link.source = LinkSource::element(source);
  link.factor = static_cast<float>(sum.factor);
  const mesh::SecondMoments& area = tree.second_moments(source);
  const double determinant = area.uu * area.vv - area.uv * area.uv;
  if (determinant <= 0.0) return link;
  link.moment_u = static_cast<float>((sum.u * area.vv - sum.v * area.uv) / determinant);
  link.moment_v = static_cast<float>((sum.v * area.uu - sum.u * area.uv) / determinant);
  return link;
}

}  // namespace

std::vector<Link> links_to_seen(const Solution& solution, ElementId receiver, std::span<const SeenSurface> seen,
                                const LinearValue& slope) {
  const mesh::ElementTree& tree = solution.tree();
  std::map<std::uint32_t, Sum> sums;
  for (const SeenSurface& one : seen) {
    const ElementId source = solution.element_at(one.point.side, one.point.region, one.point.at);
    if (!source.valid()) continue;
    const Vector d = one.point.at - tree.centroid(source);
    Sum& sum = sums[source.value];
    sum.factor += one.factor;
    sum.u += one.factor * dot(d, tree.axes(source).u);
    sum.v += one.factor * dot(d, tree.axes(source).v);
  }
  std::vector<Link> links;
  for (const auto& [source, sum] : sums) {
    Link link = link_of(tree, ElementId(source), sum);
    link.receiver = receiver;
    link.slope_u = link.factor * slope.slope_u;
    link.slope_v = link.factor * slope.slope_v;
    links.push_back(link);
  }
  return links;
}

}  // namespace clerestory::lighting
