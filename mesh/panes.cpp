// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/panes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesh/box_tree.h"
#include "mesh/coplanar.h"

namespace clerestory::mesh {

namespace {

/// Sheets within this angle are parallel: 1 degree, so that rounded coordinates of small panes pass.
constexpr double kParallelCosine = 0.99985;
/// Share of the smaller sheet that the larger must cover.
constexpr double kMinCover = 0.5;
/// Least width of a sheet over the distance to its partner; below it is a rod or a rim.
constexpr double kMinWidthOverDistance = 2.0;
/// Sheets whose offsets differ by less belong to one layer, and rims may stand out by as much [m].
constexpr double kLayerTolerance = 1e-4;
/// Rounding of a thickness that is exactly the greatest allowed.
constexpr double kThicknessRounding = 1.0 + 1e-9;

/// Coplanar polygons of a sheet material.
struct Sheet {
  CoplanarGroup group;
  MaterialId material;
  double area = 0.0;
  Box box;
  std::vector<Point> corners;
};

/// Parallel sheets that are one pane, and the sheets that close the rim between them.
struct Pane {
  std::vector<std::uint32_t> layers;
  std::vector<std::uint32_t> rim;
  Frame frame;  ///< w is the normal of the first layer
  Box space;    ///< the box around the layers, in the frame's coordinates
};

Point in_frame(const Frame& frame, const Point& p) {
  const Vector v = p - Point{};
  return {dot(v, frame.u), dot(v, frame.v), dot(v, frame.w)};
}

Box box_in(const Frame& frame, const Sheet& sheet) {
  Box box;
  for (const Point& p : sheet.corners) box.add(in_frame(frame, p));
  return box;
}

double middle(const Box& box) { return 0.5 * (box.low.z + box.high.z); }

double face_area(const Box& box) {
  const Vector size = box.size();
  return std::max(size.x, 0.0) * std::max(size.y, 0.0);
}

Box common(const Box& a, const Box& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
}

bool contains(const Box& outer, const Box& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
         outer.high.x >= inner.high.x && outer.high.y >= inner.high.y && outer.high.z >= inner.high.z;
}

std::vector<Sheet> find_sheets(const Soup& soup, const CleanOptions& options) {
  std::vector<Sheet> sheets;
  for (CoplanarGroup& group : group_coplanar(soup, {options.weld_tolerance_m, 1e-3, false})) {
    const MaterialId material = soup.polygons[group.polygons[0]].material;
    if (material.index() >= options.sheet_materials.size() || !options.sheet_materials[material.index()]) continue;
    Sheet sheet;
    sheet.material = material;
    for (const std::uint32_t p : group.polygons) {
      sheet.area += area(soup.points, soup.polygons[p]);
      for_each_edge(soup.polygons[p],
                    [&](std::uint32_t corner, std::uint32_t) { sheet.corners.push_back(soup.points[corner]); });
    }
    for (const Point& p : sheet.corners) sheet.box.add(p);
    sheet.group = std::move(group);
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

/// A frame with u along the longest edge, in which the box around a pane is tight.
Frame frame_of(const Soup& soup, const Sheet& sheet) {
  Vector longest;
  for (const std::uint32_t p : sheet.group.polygons) {
    for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t b) {
      const Vector edge = soup.points[b] - soup.points[a];
      if (norm(edge) > norm(longest)) longest = edge;
    });
  }
  const Vector w = sheet.group.plane.normal;
  const Vector u = normalized(longest - dot(longest, w) * w);
  return {u, cross(w, u), w};
}

class PaneSearch {
 public:
  PaneSearch(const Soup& soup, const std::vector<Sheet>& sheets, double max_thickness)
      : soup_(soup), sheets_(sheets), max_thickness_(max_thickness * kThicknessRounding), taken_(sheets.size(), false) {
    std::vector<Box> boxes;
    for (const Sheet& sheet : sheets) boxes.push_back(sheet.box);
    tree_ = BoxTree(boxes);
  }

  /// Large sheets first, so that rims are known as such before they could be taken for panes.
  std::vector<Pane> run() {
    std::vector<std::uint32_t> order(sheets_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return sheets_[a].area > sheets_[b].area; });
    std::vector<Pane> panes;
    for (const std::uint32_t seed : order) {
      if (taken_[seed]) continue;
      Pane pane = grow(seed);
      if (pane.space.size().z <= kLayerTolerance) continue;
      for (const std::uint32_t s : pane.layers) taken_[s] = true;
      take_rim(pane);
      panes.push_back(std::move(pane));
    }
    return panes;
  }

 private:
  /// The seed and the sheets parallel to it, nearest first, as long as all stay within the pane thickness.
  Pane grow(std::uint32_t seed) const {
    Pane pane{{seed}, {}, frame_of(soup_, sheets_[seed]), {}};
    const Box seed_box = box_in(pane.frame, sheets_[seed]);
    std::vector<std::pair<double, std::uint32_t>> partners;
    const Box near = grown(sheets_[seed].box, max_thickness_);
    tree_.visit([&](const Box& box) { return overlap(near, box); },
                [&](std::uint32_t s) {
                  if (s == seed || !is_partner(pane, seed, seed_box, s)) return;
                  partners.emplace_back(std::abs(middle(box_in(pane.frame, sheets_[s])) - middle(seed_box)), s);
                });
    std::sort(partners.begin(), partners.end());
    double low = middle(seed_box);
    double high = low;
    pane.space = seed_box;
    for (const auto& [distance, s] : partners) {
      const Box box = box_in(pane.frame, sheets_[s]);
      if (std::max(high, middle(box)) - std::min(low, middle(box)) > max_thickness_) continue;
      low = std::min(low, middle(box));
      high = std::max(high, middle(box));
      pane.space.add(box);
      pane.layers.push_back(s);
    }
    pane.space.low.z = low;
    pane.space.high.z = high;
    return pane;
  }

  bool is_partner(const Pane& pane, std::uint32_t seed, const Box& seed_box, std::uint32_t s) const {
    const Sheet& other = sheets_[s];
    if (taken_[s] || other.material != sheets_[seed].material) return false;
    if (std::abs(dot(other.group.plane.normal, pane.frame.w)) < kParallelCosine) return false;
    const Box box = box_in(pane.frame, other);
    const double distance = std::abs(middle(box) - middle(seed_box));
    const double width = std::min({seed_box.size().x, seed_box.size().y, box.size().x, box.size().y});
    return distance <= max_thickness_ && width >= kMinWidthOverDistance * distance &&
           face_area(common(seed_box, box)) >= kMinCover * std::min(face_area(seed_box), face_area(box));
  }

  /// Takes the sheets that lie wholly within the pane's space.
  void take_rim(Pane& pane) {
    const Box space = grown(pane.space, kLayerTolerance);
    Box near;
    for (const std::uint32_t s : pane.layers) near.add(sheets_[s].box);
    near = grown(near, kLayerTolerance);
    tree_.visit([&](const Box& box) { return overlap(near, box); },
                [&](std::uint32_t s) {
                  if (taken_[s] || sheets_[s].material != sheets_[pane.layers[0]].material) return;
                  if (!contains(space, box_in(pane.frame, sheets_[s]))) return;
                  taken_[s] = true;
                  pane.rim.push_back(s);
                });
  }

  const Soup& soup_;
  const std::vector<Sheet>& sheets_;
  double max_thickness_;
  std::vector<bool> taken_;
  BoxTree tree_;
};

/// The sheets of the pane's layer of largest area; of equal ones that of the first sheet.
std::vector<std::uint32_t> widest_layer(const Pane& pane, const std::vector<Sheet>& sheets) {
  std::vector<std::uint32_t> best;
  double best_area = 0.0;
  for (const std::uint32_t first : pane.layers) {
    const double at = middle(box_in(pane.frame, sheets[first]));
    std::vector<std::uint32_t> layer;
    double layer_area = 0.0;
    for (const std::uint32_t s : pane.layers) {
      if (std::abs(middle(box_in(pane.frame, sheets[s])) - at) > kLayerTolerance) continue;
      layer.push_back(s);
      layer_area += sheets[s].area;
    }
    if (layer_area <= best_area * kThicknessRounding) continue;
    best_area = layer_area;
    best = layer;
  }
  return best;
}

/// Moves polygons by a vector, to points of their own: others may use the old ones.
void move_polygons(Soup& soup, const std::vector<std::uint32_t>& polygons, const Vector& by) {
  std::map<std::uint32_t, std::uint32_t> moved;
  for (const std::uint32_t p : polygons) {
    for (std::vector<std::uint32_t>& loop : soup.polygons[p].loops) {
      for (std::uint32_t& corner : loop) {
        const auto [place, fresh] = moved.try_emplace(corner, static_cast<std::uint32_t>(soup.points.size()));
        if (fresh) soup.points.push_back(Point(soup.points[corner]) + by);
        corner = place->second;
      }
    }
  }
}

/// Puts the widest layer at the middle and marks the polygons of all else.
void collapse(Soup& soup, const Pane& pane, const std::vector<Sheet>& sheets, std::vector<bool>& dropped) {
  const std::vector<std::uint32_t> kept = widest_layer(pane, sheets);
  std::vector<std::uint32_t> all = pane.layers;
  all.insert(all.end(), pane.rim.begin(), pane.rim.end());
  for (const std::uint32_t s : all) {
    if (std::find(kept.begin(), kept.end(), s) == kept.end()) {
      for (const std::uint32_t p : sheets[s].group.polygons) dropped[p] = true;
      continue;
    }
    const double shift = middle(pane.space) - middle(box_in(pane.frame, sheets[s]));
    move_polygons(soup, sheets[s].group.polygons, shift * pane.frame.w);
  }
}

/// What a notice counts together: material, whether solids, thickness [0.1 mm].
using PaneKind = std::tuple<MaterialId, bool, long>;

std::string notice(const PaneKind& kind, std::size_t count, const std::vector<std::string>& material_names) {
  const auto& [material, solid, tenths] = kind;
  const std::string_view what =
      solid ? (count == 1 ? "solid" : "solids") : (count == 1 ? "stack of sheets" : "stacks of sheets");
  return fmt::format("material {}: {} {} of {:g} mm became {}", material_names[material.index()], count, what,
                     static_cast<double>(tenths) / 10.0,
                     count == 1 ? "a pane at its mid-surface" : "panes at their mid-surface");
}

}  // namespace

bool reduce_panes(Soup& soup, const CleanOptions& options, const std::vector<std::string>& material_names,
                  std::vector<std::string>& notices) {
  const std::vector<Sheet> sheets = find_sheets(soup, options);
  const std::vector<Pane> panes = PaneSearch(soup, sheets, options.pane_thickness_m).run();
  if (panes.empty()) return false;
  std::vector<bool> dropped(soup.polygons.size(), false);
  std::map<PaneKind, std::size_t> counts;
  for (const Pane& pane : panes) {
    collapse(soup, pane, sheets, dropped);
    const double thickness = pane.space.size().z;
    ++counts[{sheets[pane.layers[0]].material, !pane.rim.empty(), std::lround(thickness * 1e4)}];
  }
  for (const auto& [kind, count] : counts) notices.push_back(notice(kind, count, material_names));
  std::size_t kept = 0;
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    if (dropped[p]) continue;
    if (kept != p) soup.polygons[kept] = std::move(soup.polygons[p]);
    ++kept;
  }
  soup.polygons.resize(kept);
  return true;
}

}  // namespace clerestory::mesh
