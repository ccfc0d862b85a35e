// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/specks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/box_tree.h"
#include "mesh/disjoint_sets.h"

namespace clerestory::mesh {

namespace {

/// Anything larger may be a thing of its own [m].
constexpr double kSpeckSize = 5e-3;
/// Nothing smaller is modelled on purpose, floating in the air [m].
constexpr double kCertainSize = 1e-3;

/// Polygons that hang together by vertices.
struct Component {
  std::vector<std::uint32_t> polygons;
  Box box;
};

std::vector<Component> components_of(const Soup& soup) {
  DisjointSets<std::uint32_t> joined(soup.points.size());
  for (const SoupPolygon& polygon : soup.polygons) {
    const std::uint32_t first = polygon.loops[0][0];
    for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t) { joined.join(first, a); });
  }
  std::vector<std::uint32_t> number(soup.points.size(), 0);  // of a root's component, counted from 1
  std::vector<Component> components;
  for (std::uint32_t p = 0; p < soup.polygons.size(); ++p) {
    std::uint32_t& n = number[joined.root(soup.polygons[p].loops[0][0])];
    if (n == 0) {
      components.emplace_back();
      n = static_cast<std::uint32_t>(components.size());
    }
    components[n - 1].polygons.push_back(p);
    for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t) { components[n - 1].box.add(soup.points[a]); });
  }
  return components;
}

/// Whether things pass within a distance of a component.
class Surroundings {
 public:
  explicit Surroundings(const Soup& soup) {
    std::vector<Box> boxes(soup.polygons.size());
    for (std::size_t p = 0; p < boxes.size(); ++p) {
      for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t) { boxes[p].add(soup.points[a]); });
      planes_.push_back(plane_of(soup.points, soup.polygons[p], 0.0));
    }
    tree_ = BoxTree(boxes);
  }

  [[nodiscard]] bool alone(const Component& component) const {
    const double reach = component.box.diagonal();
    const Box near = grown(component.box, reach);
    bool alone = true;
    tree_.visit([&](const Box& box) { return alone && overlap(near, box); },
                [&](std::uint32_t p) {
                  if (std::binary_search(component.polygons.begin(), component.polygons.end(), p)) return;
                  const bool passes =
                      planes_[p] && std::abs(planes_[p]->distance(component.box.centre())) > 1.5 * reach;
                  alone = alone && passes;
                });
    return alone;
  }

 private:
  std::vector<std::optional<Plane>> planes_;
  BoxTree tree_;
};

/// Which materials are on anything larger than a speck.
std::vector<bool> materials_in_use(const Soup& soup, const std::vector<Component>& components) {
  std::vector<bool> used;
  for (const Component& component : components) {
    if (component.box.diagonal() < kSpeckSize) continue;
    for (const std::uint32_t p : component.polygons) {
      const std::size_t m = soup.polygons[p].material.index();
      if (m >= used.size()) used.resize(m + 1, false);
      used[m] = true;
    }
  }
  return used;
}

}  // namespace

void remove_specks(Soup& soup, DefectList& defects) {
  const std::vector<Component> components = components_of(soup);
  std::vector<bool> dropped(soup.polygons.size(), false);
  std::vector<bool> used;
  std::optional<Surroundings> surroundings;
  for (const Component& component : components) {
    const double size = component.box.diagonal();
    if (size >= kSpeckSize) continue;
    if (!surroundings) {
      surroundings.emplace(soup);
      used = materials_in_use(soup, components);
    }
    if (!surroundings->alone(component)) continue;
    const auto in_use = [&](std::uint32_t p) {
      const std::size_t m = soup.polygons[p].material.index();
      return m < used.size() && used[m];
    };
    const DefectPlace place{soup.polygons[component.polygons[0]].source, component.box.centre(), size};
    if (size >= kCertainSize) {
      defects.leave("stray specks", place, "large enough to be meant");
    } else if (!std::all_of(component.polygons.begin(), component.polygons.end(), in_use)) {
      defects.leave("stray specks", place, "has a material that nothing larger has");
    } else {
      defects.add("stray specks", place, "removed");
      for (const std::uint32_t p : component.polygons) dropped[p] = true;
    }
  }
  std::size_t index = 0;
  std::erase_if(soup.polygons, [&](const SoupPolygon&) { return dropped[index++]; });
}

}  // namespace clerestory::mesh
