// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lit_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include "lighting/mesh_grading.h"
#include "lighting/parallel.h"
#include "lighting/points_by_element.h"
#include "mesh/contact_sectors.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::FaceSide;
using mesh::Point;

namespace {

constexpr std::size_t kBatch = 64;  ///< groups of points between two signs of life

/// Where the light at a point is computed: a hair inside of one of its cells.
struct Place {
  ElementId element;
  Point inside;
};

class Lighter {
 public:
  Lighter(const Solution& solution, const ShownMesh& shown, const LocalPass& local)
      : solution_(solution), shown_(shown), local_(local), sectors_(solution.scene().faces) {}

  LitMesh run(Progress& progress) {
    for (std::size_t s = 0; s < shown_.shown.size(); ++s) {
      if (shown_.shown[s] != 0) add_side(mesh::face_side(s));
    }
    lit_.error_lux.resize(lit_.points.size());
    std::vector<ElementId> elements;
    for (const Place& place : places_) elements.push_back(place.element);
    const PointsByElement places(elements);
    for (std::size_t first = 0; first < places.groups(); first += kBatch) {
      const std::size_t end = std::min(first + kBatch, places.groups());
      parallel_for(end - first, [&](std::size_t k) {
        const LocalPass::Lamps lamps = local_.lamps_of(places.element(first + k));
        for (const std::uint32_t i : places.points(first + k)) light_point(i, lamps);
      });
      progress.advance(static_cast<double>(end) / static_cast<double>(places.groups()));
    }
    for (double& l : lit_.lux) l = std::max(0.0, l);
    return std::move(lit_);
  }

 private:
  void light_point(std::size_t i, const LocalPass::Lamps& lamps) {
    const LocalPass::Light light = local_.at(places_[i].element, places_[i].inside, lamps);
    std::copy(light.lux.begin(), light.lux.end(), lit_.lux.begin() + static_cast<long>(i * solution_.channels()));
    lit_.error_lux[i] = light.error_lux;
  }

  void add_side(FaceSide side) {
    known_.clear();
    for (const mesh::Triangle& t : shown_.mesh.of(side.face)) add_cell(side, t);
  }

  void add_cell(FaceSide side, const mesh::Triangle& t) {
    std::array<std::uint32_t, 3> vertices = t.vertices;
    if (side.side == mesh::Side::kBack) std::swap(vertices[1], vertices[2]);
    std::array<Point, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = shown_.mesh.vertices[vertices[k]];
    LitMesh::Cell cell;
    cell.middle = c[0] + (c[1] - c[0] + (c[2] - c[0])) / 3.0;
    cell.area = 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
    cell.element = solution_.element_at(side, t.region, cell.middle);
    if (!cell.element.valid()) return;
    const std::uint32_t patch = shown_.jump[side.face.index()] != 0 ? t.patch : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      // Off the edges of the face, and of the patch.
      const Point inside = inside_from(c[k], cell.middle);
      const auto number = static_cast<std::uint32_t>(lit_.points.size());
      const auto [entry, added] =
          known_.try_emplace({vertices[k], t.region, patch, sectors_.at(side.face, c[k], cell.middle)}, number);
      if (added) add_point(c[k], {solution_.element_at(side, t.region, inside), inside});
      cell.points[k] = entry->second;
    }
    lit_.cells.push_back(cell);
  }

  void add_point(const Point& at, const Place& place) {
    lit_.points.push_back(at);
    places_.push_back(place);
    lit_.lux.resize(lit_.lux.size() + solution_.channels(), 0.0);
  }

  const Solution& solution_;
  const ShownMesh& shown_;
  const LocalPass& local_;
  LitMesh lit_;
  std::vector<Place> places_;
  mesh::ContactSectors sectors_;
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> known_;  // vertex, region, patch and sector of a side
};

}  // namespace

LitMesh light_mesh(const Solution& solution, const ShownMesh& shown, const LocalPass& local, Progress& progress) {
  return Lighter(solution, shown, local).run(progress);
}

}  // namespace clerestory::lighting
