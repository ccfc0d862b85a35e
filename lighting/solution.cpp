// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/solution.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "lighting/parallel.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Vector;

Solution::Solution(const Scene& scene, mesh::ElementTree tree)
    : scene_(&scene), tree_(std::move(tree)), top_(tree_.start_triangle_count()), element_count_(tree_.roots().size()) {
  for (const ElementId root : tree_.roots()) put_on_top(root);
  grow();
}

void Solution::put_on_top(ElementId e) {
  std::fill_n(top_.begin() + static_cast<std::ptrdiff_t>(tree_.first_start_triangle(e)), tree_.start_triangle_count(e),
              e);
}

void Solution::grow() {
  const std::size_t n = tree_.size();
  open_.resize(n, 0);
  direct_.resize(n * channels());
  gathered_.resize(n * channels());
  irradiance_.resize(n * channels());
  radiosity_.resize(n * channels(), 0.0F);
  moments_.resize(n * channels());
  mean_.resize(n, 0.0F);
  variance_.resize(n, 0.0F);
  deviation_.resize(n, 0.0F);
  noise2_.resize(n, 0.0F);
  misfit2_.resize(n, 0.0F);
  closing_.resize(n, kUnscaled);
  change_.resize(n, 0.0F);
}

void Solution::divide(ElementId e) {
  tree_.split(e);
  grow();
}

void Solution::open(ElementId e) {
  if (open_[e.index()] != 0) return;
  assert(!tree_.parent(e).valid() || is_open(tree_.parent(e)));
  element_count_ += gained_by_opening(e);
  open_[e.index()] = 1;
  if (!tree_.has_children(e)) divide(e);
  // Until the next push the children show what their parent did.
  for (std::size_t k = 0; k < tree_.child_count(e); ++k) {
    const std::size_t child = tree_.first_child(e).index() + k;
    std::copy_n(radiosity_.begin() + static_cast<std::ptrdiff_t>(e.index() * channels()), channels(),
                radiosity_.begin() + static_cast<std::ptrdiff_t>(child * channels()));
    mean_[child] = mean_[e.index()];
    if (!tree_.is_triangle(e)) put_on_top(ElementId(child));
  }
}

std::size_t Solution::gained_by_opening(ElementId e) const {
  if (is_open(e)) return 0;
  return (tree_.has_children(e) ? tree_.child_count(e) : mesh::ElementTree::kPartsOfTriangle) - 1;
}

std::vector<Solution::Errors> Solution::errors() const {
  std::vector<Errors> all(noise2_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {noise2_[i], misfit2_[i]};
  return all;
}

void Solution::set_errors(std::span<const Errors> errors) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    noise2_[i] = errors[i].noise2;
    misfit2_[i] = errors[i].misfit2;
  }
}

ElementId Solution::element_at(mesh::FaceSide side, std::uint32_t region, const mesh::Point& point) const {
  const ElementId top = tree_.find(side, region, point, top_);
  if (!top.valid() || !is_open(top)) return top;
  return tree_.descend(top, point, [&](ElementId e) { return is_open(e); });
}

ElementId Solution::element_at(ElementId triangle, const mesh::Point& point) const {
  if (!triangle.valid()) return triangle;
  assert(tree_.is_triangle(triangle));
  const ElementId top = top_[tree_.first_start_triangle(triangle)];
  if (!is_open(top)) return top;
  ElementId element = tree_.descend(triangle, point, [&](ElementId e) { return is_open(e); });
  // The tree may be deeper than the solution.
  for (ElementId up = tree_.parent(element); !is_open(up); up = tree_.parent(up)) element = up;
  return element;
}

std::vector<ElementId> Solution::elements() const {
  std::vector<ElementId> found;
  for (std::size_t i = 0; i < tree_.size(); ++i) {
    const ElementId e(i);
    if (is_open(e)) continue;
    const ElementId parent = tree_.parent(e);
    if (!parent.valid() || is_open(parent)) found.push_back(e);
  }
  return found;
}

double Solution::illuminance_at(ElementId e, const mesh::Point& point) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < channels(); ++c) sum += scene_->channel_weights[c] * illuminance_at(e, point, c);
  return sum;
}

double Solution::illuminance_at(ElementId e, const mesh::Point& point, std::size_t channel) const {
  const Vector d = point - tree_.centroid(e);
  const LinearValue& v = irradiance(e)[channel];
  return v.value + v.slope_u * dot(d, tree_.axes(e).u) + v.slope_v * dot(d, tree_.axes(e).v);
}

float Solution::radiosity_at(ElementId e, const mesh::Point& point, std::size_t channel, bool with_emission) const {
  const mesh::FaceSide side = tree_.face_side(e);
  const mesh::Frame& axes = tree_.axes(e);
  const Vector d = point - tree_.centroid(e);
  const LinearValue& v = irradiance(e)[channel];
  const float lux = std::max(
      0.0F, v.value + v.slope_u * static_cast<float>(dot(d, axes.u)) + v.slope_v * static_cast<float>(dot(d, axes.v)));
  const float emission = with_emission ? scene_->side_exitance(side)[channel] : 0.0F;
  return emission + scene_->side_reflectance(side)[channel] * lux;
}

float Solution::luminous_radiosity_at(ElementId e, const mesh::Point& point, bool with_emission) const {
  float all = 0.0F;
  for (std::size_t c = 0; c < channels(); ++c)
    all += scene_->channel_weights[c] * radiosity_at(e, point, c, with_emission);
  return all;
}

void Solution::push(ElementId e, const ElementId* parent) {
  const std::size_t n = channels();
  for (std::size_t c = 0; c < n; ++c) {
    const LinearValue& own = direct_[e.index() * n + c];
    const LinearValue& link = gathered_[e.index() * n + c];
    LinearValue sum{own.value + link.value, own.slope_u + link.slope_u, own.slope_v + link.slope_v};
    if (parent != nullptr) {
      const LinearValue& above = irradiance_[parent->index() * n + c];
      const Vector d = tree_.centroid(e) - tree_.centroid(*parent);
      sum.value += above.value + above.slope_u * static_cast<float>(dot(d, tree_.axes(e).u)) +
                   above.slope_v * static_cast<float>(dot(d, tree_.axes(e).v));
      sum.slope_u += above.slope_u;
      sum.slope_v += above.slope_v;
    }
    irradiance_[e.index() * n + c] = sum;
  }
  if (!is_open(e)) {
    apply_closing(e);
    return;
  }
  for (std::size_t k = 0; k < tree_.child_count(e); ++k) push(ElementId(tree_.first_child(e).index() + k), &e);
}

void Solution::apply_closing(ElementId e) {
  if (!is_closed(e)) return;
  const LinearValue& scale = closing_[e.index()];
  const std::size_t n = channels();
  for (std::size_t c = 0; c < n; ++c) {
    LinearValue straight;
    for (ElementId up = e; up.valid(); up = tree_.parent(up)) {
      const LinearValue& given = direct_[up.index() * n + c];
      const Vector d = tree_.centroid(e) - tree_.centroid(up);
      straight.value += given.value + given.slope_u * static_cast<float>(dot(d, tree_.axes(e).u)) +
                        given.slope_v * static_cast<float>(dot(d, tree_.axes(e).v));
      straight.slope_u += given.slope_u;
      straight.slope_v += given.slope_v;
    }
    LinearValue& all = irradiance_[e.index() * n + c];
    const LinearValue linked{all.value - straight.value, all.slope_u - straight.slope_u,
                             all.slope_v - straight.slope_v};
    const LinearValue scaled = product(scale, linked, tree_.second_moments(e));
    all = {straight.value + scaled.value, straight.slope_u + scaled.slope_u, straight.slope_v + scaled.slope_v};
  }
}

Solution::Sent Solution::sent(ElementId e, std::size_t channel) const {
  const float value = radiosity_[e.index() * channels() + channel];
  const Moments& m = moments_[e.index() * channels() + channel];
  const LinearValue& scale = closing_[e.index()];
  if (!is_closed(e)) return {value, m.u, m.v};
  const Moments own = moments_of(scale, tree_.second_moments(e));
  return {scale.value * value + scale.slope_u * m.u + scale.slope_v * m.v, scale.value * m.u + value * own.u,
          scale.value * m.v + value * own.v};
}

void Solution::pull(ElementId e) {
  if (is_open(e)) {
    pull_children(e);
  } else {
    pull_element(e);
  }
  set_deviation(e);
}

void Solution::pull_element(ElementId e) {
  const mesh::FaceSide side = tree_.face_side(e);
  const mesh::SecondMoments& area = tree_.second_moments(e);
  float mean = 0.0F;
  double u = 0.0;
  double v = 0.0;
  for (std::size_t c = 0; c < channels(); ++c) {
    const LinearValue& lux = irradiance_[e.index() * channels() + c];
    const float rho = scene_->side_reflectance(side)[c];
    const float weight = scene_->channel_weights[c];
    radiosity_[e.index() * channels() + c] = scene_->side_exitance(side)[c] + rho * lux.value;
    moments_[e.index() * channels() + c] = {static_cast<float>(rho * (area.uu * lux.slope_u + area.uv * lux.slope_v)),
                                            static_cast<float>(rho * (area.uv * lux.slope_u + area.vv * lux.slope_v))};
    mean += weight * radiosity_[e.index() * channels() + c];
    u += weight * rho * lux.slope_u;
    v += weight * rho * lux.slope_v;
  }
  change_[e.index()] = mean - mean_[e.index()];
  mean_[e.index()] = mean;
  variance_[e.index()] = static_cast<float>(u * u * area.uu + 2.0 * u * v * area.uv + v * v * area.vv);
}

void Solution::pull_children(ElementId e) {
  const std::size_t n = channels();
  float* radiosity = &radiosity_[e.index() * n];
  Moments* moments = &moments_[e.index() * n];
  std::fill_n(radiosity, n, 0.0F);
  std::fill_n(moments, n, Moments{});
  double mean = 0.0;
  double square = 0.0;
  for (std::size_t k = 0; k < tree_.child_count(e); ++k) {
    const ElementId child(tree_.first_child(e).index() + k);
    pull(child);
    const PlaceInParent<float> place(tree_, child);
    for (std::size_t c = 0; c < n; ++c) {
      Sent sum{radiosity[c], moments[c].u, moments[c].v};
      sum.add_part(sent(child, c), place);
      radiosity[c] = sum.mean;
      moments[c] = {sum.u, sum.v};
    }
    const double m = mean_[child.index()];
    mean += place.share * m;
    square += place.share * (m * m + variance_[child.index()]);
  }
  mean_[e.index()] = static_cast<float>(mean);
  variance_[e.index()] = static_cast<float>(std::max(0.0, square - mean * mean));
}

void Solution::set_deviation(ElementId e) {
  // What the line through the node explains, comes off the variance.
  const mesh::SecondMoments& area = tree_.second_moments(e);
  double u = 0.0;
  double v = 0.0;
  for (std::size_t c = 0; c < channels(); ++c) {
    u += scene_->channel_weights[c] * moments_[e.index() * channels() + c].u;
    v += scene_->channel_weights[c] * moments_[e.index() * channels() + c].v;
  }
  const double determinant = area.uu * area.vv - area.uv * area.uv;
  const double explained =
      determinant > 0.0 ? (u * u * area.vv - 2.0 * u * v * area.uv + v * v * area.uu) / determinant : 0.0;
  deviation_[e.index()] = static_cast<float>(std::sqrt(std::max(0.0, variance_[e.index()] - explained)));
}

void Solution::darken() {
  std::fill(direct_.begin(), direct_.end(), LinearValue{});
  std::fill(noise2_.begin(), noise2_.end(), 0.0F);
  std::fill(misfit2_.begin(), misfit2_.end(), 0.0F);
  clear_gathered();
}

double Solution::push_pull() {
  const auto roots = tree_.roots();
  parallel_for(
      roots.size(),
      [&](std::size_t i) {
        push(roots[i], nullptr);
        pull(roots[i]);
      },
      16);
  double changed = 0.0;
  double all = 0.0;
  for (const ElementId e : elements()) {
    changed += tree_.area(e) * std::abs(change_[e.index()]);
    all += tree_.area(e) * std::abs(mean_[e.index()]);
  }
  return all > 0.0 ? changed / all : 0.0;
}

}  // namespace clerestory::lighting
