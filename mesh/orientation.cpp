// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/orientation.h"

#include <cmath>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mesh/edge_uses.h"

namespace clerestory::mesh {

namespace {

/// Volume of a shell over that of a cube of its area, below which it has no outside to speak of: folded sheets.
constexpr double kNoVolume = 1e-9;

/// What hangs together, and how.
struct ShellGraph {
  std::vector<std::vector<std::pair<std::uint32_t, bool>>>
      neighbours;                  ///< of each polygon: the other one, whether opposed
  std::vector<std::uint8_t> open;  ///< of each polygon: an edge without neighbour
  std::vector<std::uint8_t> lone;  ///< of each polygon: an edge that no other polygon has at all

  /// @param across_parts  whether two polygons hang together that alone have an edge, but are of different parts
  ShellGraph(const Soup& soup, bool across_parts)
      : neighbours(soup.polygons.size()), open(soup.polygons.size(), 0), lone(soup.polygons.size(), 0) {
    const std::vector<EdgeUse> uses = sorted_edge_uses(soup);
    for_each_edge_group(uses, [&](std::size_t first, std::size_t last) {
      if (last - first == 1) lone[uses[first].polygon] = 1;
      if (last - first == 2 && across_parts) {
        connect(uses[first], uses[first + 1]);
      } else {
        connect_within_parts(soup, uses, first, last);
      }
    });
  }

 private:
  void connect(const EdgeUse& a, const EdgeUse& b) {
    if (a.polygon == b.polygon) return;
    neighbours[a.polygon].emplace_back(b.polygon, a.forward == b.forward);
    neighbours[b.polygon].emplace_back(a.polygon, a.forward == b.forward);
  }

  void connect_within_parts(const Soup& soup, const std::vector<EdgeUse>& uses, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::size_t partner = last;
      std::size_t partners = 0;
      for (std::size_t j = first; j < last; ++j) {
        if (j == i || soup.polygons[uses[j].polygon].part != soup.polygons[uses[i].polygon].part) continue;
        partner = j;
        ++partners;
      }
      if (partners != 1) open[uses[i].polygon] = 1;
      if (partners == 1 && partner > i) connect(uses[i], uses[partner]);
    }
  }
};

/// One shell, and which of its polygons must be turned so that they look as the first does.
struct Shell {
  std::vector<std::uint32_t> polygons;
  std::vector<std::uint8_t> turned;
  bool closed = true;
  bool sealed = true;  ///< none of its polygons has an edge of its own
  bool one_sided = false;
};

Shell grow(const ShellGraph& graph, std::uint32_t seed, std::vector<std::uint8_t>& state) {
  constexpr std::uint8_t kTurned = 2;  // of state; 1 is as given, 0 not seen
  Shell shell;
  shell.polygons.push_back(seed);
  state[seed] = 1;
  for (std::size_t i = 0; i < shell.polygons.size(); ++i) {
    const std::uint32_t p = shell.polygons[i];
    shell.closed = shell.closed && graph.open[p] == 0;
    shell.sealed = shell.sealed && graph.lone[p] == 0;
    for (const auto& [next, opposed] : graph.neighbours[p]) {
      const auto wanted = static_cast<std::uint8_t>((state[p] == kTurned) != opposed ? kTurned : 1);
      if (state[next] == 0) {
        state[next] = wanted;
        shell.polygons.push_back(next);
      } else if (state[next] != wanted) {
        shell.one_sided = true;
      }
    }
  }
  for (const std::uint32_t p : shell.polygons) shell.turned.push_back(state[p] == kTurned ? 1 : 0);
  return shell;
}

Point corner_of(const Soup& soup, std::uint32_t polygon) { return soup.points[soup.polygons[polygon].loops[0][0]]; }

/// What a shell holds once its polygons look as the first one does.
struct ShellFigures {
  double volume = 0.0;  ///< [m³]
  double area = 0.0;    ///< [m²]
  double turned_area = 0.0;

  [[nodiscard]] bool holds_volume() const { return std::abs(volume) > kNoVolume * std::pow(area, 1.5); }
};

ShellFigures figures_of(const Soup& soup, const Shell& shell) {
  ShellFigures figures;
  // From its middle all sides of a shell add up, even where a piece of it is missing.
  Box box;
  for (const std::uint32_t p : shell.polygons) {
    for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t) { box.add(soup.points[a]); });
  }
  const Point origin = box.centre();
  for (std::size_t i = 0; i < shell.polygons.size(); ++i) {
    const SoupPolygon& polygon = soup.polygons[shell.polygons[i]];
    Vector doubled;
    for (const std::vector<std::uint32_t>& loop : polygon.loops) doubled = doubled + newell(soup.points, loop);
    const double part = dot(corner_of(soup, shell.polygons[i]) - origin, doubled) / 6.0;
    figures.volume += shell.turned[i] != 0 ? -part : part;
    figures.area += 0.5 * norm(doubled);
    if (shell.turned[i] != 0) figures.turned_area += 0.5 * norm(doubled);
  }
  return figures;
}

/// Whether the shell looks the wrong way once its polygons look as the first one does.
bool is_inside_out(const Soup& soup, const Shell& shell) {
  const ShellFigures figures = figures_of(soup, shell);
  if (shell.closed && figures.holds_volume()) return figures.volume < 0.0;
  // Equal halves stay as the first polygon is, whatever rounding says.
  return figures.turned_area > (0.5 + 1e-9) * figures.area;
}

/// @param told  polygons of the model that are told as turned; of one that was cut, pieces are not counted apart
void orient(Soup& soup, const Shell& shell, std::unordered_set<std::uint32_t>& told, DefectList& defects) {
  const std::uint32_t first = shell.polygons[0];
  if (shell.one_sided) {
    defects.leave("one-sided shells", {soup.polygons[first].source, corner_of(soup, first)},
                  "no way of turning its polygons makes all of them look the same way");
    return;
  }
  const bool inside_out = is_inside_out(soup, shell);
  std::vector<std::uint32_t> to_flip;
  for (std::size_t i = 0; i < shell.polygons.size(); ++i) {
    if ((shell.turned[i] != 0) != inside_out) to_flip.push_back(shell.polygons[i]);
  }
  const bool all = to_flip.size() == shell.polygons.size();
  for (const std::uint32_t p : to_flip) {
    flip(soup.polygons[p]);
    if (all || !told.insert(soup.polygons[p].source).second) continue;
    const double size = std::sqrt(area(soup.points, soup.polygons[p]));
    defects.add("mixed orientation", {soup.polygons[p].source, corner_of(soup, p), size});
  }
  if (all) defects.add("inside-out shells", {soup.polygons[first].source, corner_of(soup, first)});
}

}  // namespace

bool mark_solids(Soup& soup) {
  bool changed = false;
  const ShellGraph graph(soup, false);
  std::vector<std::uint8_t> state(soup.polygons.size(), 0);
  for (std::uint32_t seed = 0; seed < soup.polygons.size(); ++seed) {
    if (state[seed] != 0) continue;
    const Shell shell = grow(graph, seed, state);
    const ShellFigures figures = figures_of(soup, shell);
    const bool solid = shell.sealed && !shell.one_sided && figures.holds_volume();
    for (std::size_t i = 0; i < shell.polygons.size(); ++i) {
      const bool outward = (shell.turned[i] != 0) == (figures.volume < 0.0);
      const auto mark = static_cast<std::int8_t>(!solid ? 0 : outward ? 1 : -1);
      SoupPolygon& polygon = soup.polygons[shell.polygons[i]];
      if (polygon.outward == mark) continue;
      polygon.outward = mark;
      polygon.checked = false;
      changed = true;
    }
  }
  return changed;
}

std::size_t orient_shells(Soup& soup, DefectList& defects) {
  const ShellGraph graph(soup, true);
  std::vector<std::uint8_t> state(soup.polygons.size(), 0);
  std::size_t closed = 0;
  std::unordered_set<std::uint32_t> told;
  for (std::uint32_t seed = 0; seed < soup.polygons.size(); ++seed) {
    if (state[seed] != 0) continue;
    const Shell shell = grow(graph, seed, state);
    orient(soup, shell, told, defects);
    if (shell.closed && !shell.one_sided) ++closed;
  }
  return closed;
}

}  // namespace clerestory::mesh
