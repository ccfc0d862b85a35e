// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_panes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/material_rules.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

/// Panes are thinner than this [m]; units of three panes reach 50 mm.
constexpr double kThickestPane = 0.05;
/// A pane is at least this much longer and wider than thick.
constexpr double kFlat = 5.0;
/// Pieces with at least this share of the largest plate's area are panes too.
constexpr double kLikeLargest = 0.1;
/// Glazing bars are narrower than this [m].
constexpr double kWidestBar = 0.06;
/// A pane fills at least this share of its window, or the plate is a fitting or a sill.
constexpr double kLeastShare = 0.25;
/// Width and height of the glass over those of the opening: a frame of 10 % each side leaves 64 % of the area.
constexpr double kGlassShare = 0.8;

/// Extents of a body in the axes of its element, in ascending order.
std::array<double, 3> extents_of(const mesh::Solid& body) {
  const mesh::Vector size = mesh::box_of(body).size();
  std::array<double, 3> extents{size.x, size.y, size.z};
  std::sort(extents.begin(), extents.end());
  return extents;
}

double plate_area(const mesh::Solid& body) {
  const auto extents = extents_of(body);
  if (extents[0] > kThickestPane || extents[1] < kFlat * extents[0]) return 0.0;
  return extents[1] * extents[2];
}

class PaneSearch {
 public:
  explicit PaneSearch(IfcBuilding& building) : building_(building), parts_(building.elements.size()) {
    for (std::size_t e = 0; e < building.elements.size(); ++e)
      if (building.elements[e].whole) parts_[*building.elements[e].whole].push_back(e);
  }

  void run() {
    for (IfcElement& element : building_.elements)
      for (IfcItem& item : element.items) item.pane = element.class_name != "Member" && is_glass(element, item);
    for (std::size_t e = 0; e < building_.elements.size(); ++e) {
      const std::string& kind = building_.elements[e].class_name;
      if (kind == "Window" || kind == "CurtainWall") find_in(e);
    }
    for (IfcElement& element : building_.elements)
      if (element.class_name == "Window") release_bars(element);
    tell(plates_, "the plates among their parts were taken for panes");
    tell(thin_, "their thin plates were taken for panes");
    tell(rectangles_, "a rectangle in the opening was taken for the pane");
    tell(blind_, "no pane was found, so that no light passes");
  }

 private:
  bool is_glass(const IfcElement& element, const IfcItem& item) const {
    const auto& surface = item.style ? item.style : element.material;
    if (!surface) return false;
    const IfcSurface& look = building_.surfaces[*surface];
    return look.transparency >= kTransparent || is_named_like_glass(look.name);
  }

  /// Glazing bars that were drawn with the style of the glass get that of the frame.
  static void release_bars(IfcElement& window) {
    double largest = 0.0;
    const IfcItem* frame = nullptr;
    for (const IfcItem& item : window.items) {
      if (item.pane) largest = std::max(largest, plate_area(item.body));
      if (!item.pane && frame == nullptr) frame = &item;
    }
    if (frame == nullptr) return;
    for (IfcItem& item : window.items) {
      const auto extents = extents_of(item.body);
      if (!item.pane || extents[1] > kWidestBar || extents[1] * extents[2] > kLikeLargest * largest) continue;
      item.pane = false;
      item.style = frame->style;
    }
  }

  std::vector<std::size_t> family_of(std::size_t e) const {
    std::vector<std::size_t> family{e};
    for (std::size_t i = 0; i < family.size() && i < building_.elements.size(); ++i)
      family.insert(family.end(), parts_[family[i]].begin(), parts_[family[i]].end());
    return family;
  }

  void find_in(std::size_t e) {
    const std::vector<std::size_t> family = family_of(e);
    bool has_body = false;
    for (const std::size_t member : family) {
      for (const IfcItem& item : building_.elements[member].items) {
        if (item.pane) return;
        has_body = true;
      }
    }
    const IfcElement& window = building_.elements[e];
    if (!has_body && !window.fills) return;
    if (take_plates(family)) return plates_.push_back(name_of(window));
    if (take_thin_pieces(family)) return thin_.push_back(name_of(window));
    if (window.class_name != "Window") return;
    (add_rectangle(building_.elements[e]) ? rectangles_ : blind_).push_back(name_of(window));
  }

  bool take_plates(const std::vector<std::size_t>& family) {
    bool any = false;
    for (const std::size_t member : family) {
      if (building_.elements[member].class_name != "Plate") continue;
      for (IfcItem& item : building_.elements[member].items) any = item.pane = true;
    }
    return any;
  }

  bool take_thin_pieces(const std::vector<std::size_t>& family) {
    double largest = 0.0;
    double least = 0.0;
    for (const std::size_t member : family) {
      for (const IfcItem& item : building_.elements[member].items) {
        const auto whole = extents_of(item.body);
        least = std::max(least, kLeastShare * whole[1] * whole[2]);
        for (const mesh::Solid& piece : mesh::connected_pieces(item.body))
          largest = std::max(largest, plate_area(piece));
      }
    }
    if (largest == 0.0 || largest < least) return false;
    for (const std::size_t member : family) split(building_.elements[member], kLikeLargest * largest);
    return true;
  }

  /// Makes the plates of at least an area items of their own.
  static void split(IfcElement& element, double least_area) {
    std::vector<IfcItem> items;
    for (const IfcItem& item : element.items) {
      IfcItem rest{{}, item.style, false};
      for (mesh::Solid& piece : mesh::connected_pieces(item.body)) {
        if (plate_area(piece) >= least_area) {
          items.push_back({std::move(piece), item.style, true});
        } else {
          mesh::append(rest.body, piece);
        }
      }
      if (!rest.body.empty()) items.push_back(std::move(rest));
    }
    element.items = std::move(items);
  }

  /// A pane across the middle of the opening: all of it where the window has a frame, else with a ring for the frame round it.
  bool add_rectangle(IfcElement& window) const {
    if (!window.fills || building_.openings[*window.fills].bodies.empty()) return false;
    const IfcOpening& opening = building_.openings[*window.fills];
    const auto whole = rectangle(opening, 1.0);
    const auto glass = window.items.empty() ? rectangle(opening, kGlassShare) : whole;
    const mesh::Affine to_window = mesh::inverse(window.placement) * opening.placement;
    if (window.items.empty()) {
      mesh::Solid frame;
      mesh::add_face(frame, std::array{whole, glass});
      window.items.push_back({mesh::transformed(std::move(frame), to_window), {}, false});
    }
    mesh::Solid pane;
    mesh::add_face(pane, {&glass, 1});
    window.items.push_back({mesh::transformed(std::move(pane), to_window), {}, true});
    return true;
  }

  /// Across the way through the opening, with a share of its width and height.
  static std::vector<mesh::Point> rectangle(const IfcOpening& opening, double share) {
    const mesh::Box box = mesh::box_of(opening.bodies.front());
    const mesh::Vector half = 0.5 * share * box.size();
    const mesh::Vector way = opening.through.value_or(mesh::Vector{1.0 / half.x, 1.0 / half.y, 1.0 / half.z});
    mesh::Vector u{half.x, 0.0, 0.0};
    mesh::Vector v{0.0, half.y, 0.0};
    if (std::abs(way.x) > std::max(std::abs(way.y), std::abs(way.z))) {
      u = {0.0, 0.0, half.z};
    } else if (std::abs(way.y) > std::abs(way.z)) {
      v = {0.0, 0.0, half.z};
    }
    const mesh::Point c = box.centre();
    return {c - u - v, c + u - v, c + u + v, c - u + v};
  }

  static std::string name_of(const IfcElement& element) {
    return element.name.empty() ? fmt::format("#{}", element.id) : element.name;
  }

  void tell(const std::vector<std::string>& windows, std::string_view what) {
    if (windows.empty()) return;
    building_.notices.push_back(fmt::format("Nothing says what of {} windows is glass, and {}: {}.", windows.size(),
                                            what, list_names(windows)));
  }

  IfcBuilding& building_;
  std::vector<std::vector<std::size_t>> parts_;
  std::vector<std::string> plates_;
  std::vector<std::string> thin_;
  std::vector<std::string> rectangles_;
  std::vector<std::string> blind_;
};

}  // namespace

void find_panes(IfcBuilding& building) { PaneSearch(building).run(); }

}  // namespace clerestory::io
