// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/emitters.h"

#include <algorithm>
#include <array>

#include "lighting/form_factor.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;
using mesh::Visibility;

std::vector<Emitter> emitters(const Solution& solution) {
  std::vector<Emitter> found;
  const Scene& scene = solution.scene();
  for (const ElementId root : solution.tree().roots()) {
    const double exitance = luminance(scene.side_exitance(solution.tree().face_side(root)), scene.channel_weights);
    if (exitance > 0.0) found.push_back({root, exitance, mesh::shaft_end(solution.tree(), root)});
  }
  return found;
}

EmitterView look(const Solution& solution, const Emitter& emitter, const Point& at, const Receiver& receiver) {
  std::array<mesh::OutlineEdge, 3> scratch;
  const double factor = receiver.form_factor(at, solution.tree().outline(emitter.root, scratch), emitter.end.normal);
  if (factor <= kLeastFactor) return {factor, Visibility::kHidden};
  const mesh::ShaftEnd own{.corners = {at}, .count = 1, .normal = {}};
  return {factor, solution.scene().shafts->classify(own, emitter.end)};
}

SeenFactor seen_factor(const Solution& solution, const Emitter& emitter, const EmitterView& view, const Point& at,
                       const Receiver& receiver) {
  if (view.visibility == Visibility::kHidden) return {};
  if (view.visibility == Visibility::kVisible) return {view.factor, true};
  SeenFactor sum;
  for (const std::array<Point, 3>& t : solution.tree().triangles(emitter.root)) {
    const mesh::ShaftEnd triangle{.corners = {t[0], t[1], t[2]}, .count = t.size(), .normal = emitter.end.normal};
    const SeenFactor seen = seen_factor(*solution.scene().shafts, at, receiver, triangle);
    sum = {sum.factor + seen.factor, sum.exact && seen.exact};
  }
  return sum;
}

EmitterSample sample(const Solution& solution, const Emitter& emitter, const Point& at, const Receiver& receiver,
                     double a, double b) {
  const Point q = solution.tree().sample(emitter.root, a, b);
  const Vector to = q - at;
  const double distance2 = dot(to, to);
  const double kernel =
      std::max(0.0, receiver.kernel(to)) * std::max(0.0, -dot(to, emitter.end.normal)) / (distance2 * distance2);
  if (kernel <= 0.0) return {};
  const mesh::Segment segment{at, q + solution.scene().rays->offset_m() * emitter.end.normal};
  float passed = 0.0F;
  solution.scene().rays->transmittance({&segment, 1}, {&passed, 1});
  return {kernel, passed};
}

}  // namespace clerestory::lighting
