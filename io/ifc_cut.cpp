// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/words.h"

namespace clerestory::io {

namespace {

/// An end of an opening this near to a face of its element is meant to lie on it [m].
constexpr double kNear = 0.002;
/// So near is on it, whichever way [m].
constexpr double kOn = 1e-5;
/// Ends on a face are moved out by this, so that no film is left [m].
constexpr double kLengthened = 0.005;
/// Directions within this angle are one.
constexpr double kSameDirection = 0.9999;
/// What is left of a body after a cut may differ by this share from what it should be.
constexpr double kWrongVolume = 1e-4;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range range_of(const mesh::Solid& body, const mesh::Vector& along) {
  Range range;
  for (const mesh::Point& p : body.points) {
    const double at = mesh::dot(p - mesh::Point{}, along);
    range.low = std::min(range.low, at);
    range.high = std::max(range.high, at);
  }
  return range;
}

/// The directions in which an opening may end: the element's axes, and the normals of the opening's own faces, each once.
std::vector<mesh::Vector> directions_of(const mesh::Solid& tool) {
  constexpr std::size_t kMost = 16;  // round openings have many faces, and their ends are among the axes
  std::vector<mesh::Vector> directions{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const auto& [a, b, c] : tool.triangles) {
    const mesh::Vector normal =
        mesh::normalized(mesh::cross(tool.points[b] - tool.points[a], tool.points[c] - tool.points[a]));
    if (mesh::norm(normal) == 0.0 || directions.size() >= kMost) continue;
    const auto is_known = [&](const mesh::Vector& d) { return std::abs(mesh::dot(d, normal)) > kSameDirection; };
    if (std::none_of(directions.begin(), directions.end(), is_known)) directions.push_back(normal);
  }
  return directions;
}

/// Moves what lies at the end of a body.
void move_end(mesh::Solid& tool, const mesh::Vector& along, double end, double by) {
  for (mesh::Point& p : tool.points)
    if (std::abs(mesh::dot(p - mesh::Point{}, along) - end) < kOn) p = p + by * along;
}

bool goes_through(const Range& tool, const Range& body) {
  return tool.low < body.low + kNear && tool.high > body.high - kNear;
}

/// Lengthens a tool where its ends lie on faces of the body that it is cut from. Ends that stop short of a face count as on it only
/// where the whole opening goes through.
void lengthen(mesh::Solid& tool, const mesh::Solid& opening, const mesh::Solid& body) {
  for (const mesh::Vector& along : directions_of(opening)) {
    const Range of_body = range_of(body, along);
    const Range of_tool = range_of(tool, along);
    const double inside = goes_through(range_of(opening, along), of_body) ? kNear : kOn;
    if (of_tool.low < of_body.low + inside && of_tool.low > of_body.low - kNear)
      move_end(tool, along, of_tool.low, -(kLengthened + std::max(0.0, of_tool.low - of_body.low)));
    if (of_tool.high > of_body.high - inside && of_tool.high < of_body.high + kNear)
      move_end(tool, along, of_tool.high, kLengthened + std::max(0.0, of_body.high - of_tool.high));
  }
}

/// The direction in which an opening goes through a body: that in which the body is thinnest, where there are several.
std::optional<mesh::Vector> way_through(const mesh::Solid& opening, const mesh::Solid& body) {
  std::optional<mesh::Vector> way;
  double thinnest = std::numeric_limits<double>::infinity();
  for (const mesh::Vector& along : directions_of(opening)) {
    const Range of_body = range_of(body, along);
    if (!goes_through(range_of(opening, along), of_body) || of_body.high - of_body.low >= thinnest) continue;
    thinnest = of_body.high - of_body.low;
    way = along;
  }
  return way;
}

class Cutter {
 public:
  explicit Cutter(IfcBuilding& building) : building_(building) {}

  std::vector<IfcCut> run() {
    for (std::size_t e = 0; e < building_.elements.size(); ++e) {
      if (building_.elements[e].items.empty()) continue;
      for (const std::size_t o : building_.elements[e].openings) cut(e, o);
      std::erase_if(building_.elements[e].items, [](const IfcItem& item) { return item.body.empty(); });
    }
    if (!failed_.empty())
      building_.notices.push_back(fmt::format("Openings that could not be cut stay closed: {}.", list_names(failed_)));
    return std::move(cuts_);
  }

 private:
  void cut(std::size_t e, std::size_t o) {
    IfcElement& element = building_.elements[e];
    IfcOpening& opening = building_.openings[o];
    const mesh::Affine to_element = inverse(element.placement) * opening.placement;
    std::vector<mesh::Solid> tools;
    mesh::Solid all;
    for (const mesh::Solid& body : opening.bodies) {
      tools.push_back(mesh::outward(mesh::snapped(mesh::transformed(body, to_element))));
      mesh::append(all, tools.back());
    }
    for (IfcItem& item : element.items) {
      if (!mesh::interiors_overlap(mesh::box_of(item.body), mesh::box_of(all))) continue;
      IfcCut made{e, o, {}, way_through(all, item.body), false};
      if (made.way) opening.through = inverse(to_element).turn(*made.way);
      const mesh::Solid uncut = item.body;
      for (mesh::Solid tool : tools) {
        lengthen(tool, all, uncut);
        mesh::append(made.tool, tool);
        auto left = remainder(item.body, tool);
        if (left) item.body = std::move(*left);
        made.failed = made.failed || !left;
      }
      if (made.failed) failed_.push_back(fmt::format("#{} of {} {}", opening.id, element.class_name, element.name));
      cuts_.push_back(std::move(made));
    }
  }

  /// What is left; nothing where exact arithmetic cannot tell, or tells what cannot be.
  static std::optional<mesh::Solid> remainder(const mesh::Solid& body, const mesh::Solid& tool) {
    if (body.empty() || !mesh::interiors_overlap(mesh::box_of(body), mesh::box_of(tool))) return body;
    if (!mesh::is_closed(body)) return mesh::clipped(body, tool);
    auto left = mesh::difference(body, tool);
    const auto taken = left ? mesh::intersection(body, tool) : std::nullopt;
    if (!taken) return std::nullopt;
    const double whole = mesh::volume(body);
    if (std::abs(mesh::volume(*left) + mesh::volume(*taken) - whole) > kWrongVolume * whole) return std::nullopt;
    return left;
  }

  IfcBuilding& building_;
  std::vector<IfcCut> cuts_;
  std::vector<std::string> failed_;
};

}  // namespace

std::vector<IfcCut> cut_openings(IfcBuilding& building) { return Cutter(building).run(); }

}  // namespace clerestory::io
