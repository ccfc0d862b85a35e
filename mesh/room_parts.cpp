// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/room_parts.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "mesh/disjoint_sets.h"

namespace clerestory::mesh {

namespace {

/// Walls are no thicker than this [m].
constexpr double kThickWall = 0.6;
/// Walls are at least this share of a border between rooms.
constexpr double kWalled = 0.5;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// What lies between two parts [cells].
struct Border {
  double open = 0.0;
  double shut = 0.0;

  [[nodiscard]] double length() const { return open + shut; }
  [[nodiscard]] double walled() const { return shut / length(); }
};

struct Part {
  double spans = 0.0;     ///< on which one can stand
  double boundary = 0.0;  ///< to all sides [cells]
  std::map<std::uint32_t, double> labels;

  [[nodiscard]] std::optional<std::uint32_t> label() const {
    const auto most = std::ranges::max_element(labels, {}, [](const auto& l) { return l.second; });
    return most == labels.end() ? std::nullopt : std::optional(most->first);
  }
};

class Parting {
 public:
  Parting(const Columns& columns, const PartingLines& lines, RoomCells& cells)
      : columns_(columns), lines_(lines), cells_(cells), sets_(columns.spans.size()), is_crossed_(cells.count, 0) {
    for (std::uint32_t s = 0; s < cells_.of_span.size(); ++s) {
      if (cells_.of_span[s] != kNoCell && (lines_.open[s] | lines_.shut[s]) != 0) is_crossed_[index(s)] = 1;
    }
    std::vector<std::uint32_t> joined;
    for_each_link([&](std::uint32_t s, std::uint32_t t, std::size_t axis) {
      if (on_line(s, axis)) {
        crossings_.push_back({s, t, (lines_.shut[s] >> axis & 1U) != 0});
      } else {
        sets_.join(s, t);
        joined.push_back(s);
      }
    });
    find_pieces();
    for (const std::uint32_t s : joined) pieces_.at(sets_.root(s)).boundary -= 2.0;
  }

  void run() {
    look_across_walls();
    while (merge_some()) {
    }
    number();
  }

 private:
  /// A link on a line.
  struct Crossing {
    std::uint32_t from;
    std::uint32_t to;
    bool shut;
  };

  template <class Visit>
  void for_each_link(const Visit& visit) const {
    for (std::uint32_t s = 0; s < cells_.of_span.size(); ++s) {
      if (!is_looked_at(s)) continue;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::uint32_t t = beside_in_cell(columns_, cells_.of_span, s, axis);
        if (t != Span::kNone) visit(s, t, axis);
      }
    }
  }

  [[nodiscard]] std::size_t index(std::uint32_t s) const { return static_cast<std::size_t>(cells_.of_span[s]); }
  /// Whether a span is of a cell that lines lead through: the others stay as they are.
  [[nodiscard]] bool is_looked_at(std::uint32_t s) const {
    return cells_.of_span[s] != kNoCell && is_crossed_[index(s)] != 0;
  }

  [[nodiscard]] bool on_line(std::uint32_t s, std::size_t axis) const {
    return ((lines_.open[s] | lines_.shut[s]) >> axis & 1U) != 0;
  }

  /// Spans of one cell that a wall parts.
  void look_across_walls() {
    const int most = static_cast<int>(kThickWall / columns_.raster.cell_m) + 1;
    for (std::uint32_t s = 0; s < cells_.of_span.size(); ++s) {
      if (!is_looked_at(s)) continue;
      for (const auto& [di, dj] : {std::pair(1, 0), std::pair(0, 1)}) {
        const std::uint32_t t = across(s, di, dj, most);
        if (t != Span::kNone) walls_.emplace_back(s, t);
      }
    }
  }

  [[nodiscard]] std::uint32_t across(std::uint32_t s, int di, int dj, int most) const {
    for (int k = 1; k <= most; ++k) {
      const auto column = columns_.raster.beside(columns_.spans[s].column, k * di, k * dj);
      if (!column) return Span::kNone;
      for (std::uint32_t t = columns_.of(*column).first; t < columns_.of(*column).second; ++t) {
        if (cells_.of_span[t] == cells_.of_span[s]) return k == 1 ? Span::kNone : t;
      }
    }
    return Span::kNone;
  }

  std::map<Pair, Border> borders() {
    std::map<Pair, Border> result;
    for (const Crossing& link : crossings_) {
      if (sets_.root(link.from) == sets_.root(link.to)) continue;
      Border& border = result[std::minmax(sets_.root(link.from), sets_.root(link.to))];
      (link.shut ? border.shut : border.open) += 1.0;
    }
    for (const auto& [s, t] : walls_) {
      const auto border = result.find(std::minmax(sets_.root(s), sets_.root(t)));
      if (border != result.end()) border->second.shut += 1.0;
    }
    return result;
  }

  /// What hangs together without a crossing.
  void find_pieces() {
    for (std::uint32_t s = 0; s < cells_.of_span.size(); ++s) {
      if (!is_looked_at(s)) continue;
      Part& piece = pieces_[sets_.root(s)];
      const bool furnished = !lines_.furnished.empty() && lines_.furnished[s] != 0;
      if (!furnished && columns_.spans[s].height() >= kHeadroom) piece.spans += 1.0;
      piece.boundary += 4.0;
      if (!lines_.label.empty()) piece.labels[lines_.label[s]] += 1.0;
    }
  }

  std::map<std::uint32_t, Part> parts() {
    std::map<std::uint32_t, Part> result;
    for (const auto& [root, piece] : pieces_) {
      Part& part = result[sets_.root(root)];
      part.spans += piece.spans;
      part.boundary += piece.boundary;
      for (const auto& [label, count] : piece.labels) part.labels[label] += count;
    }
    for (const Crossing& link : crossings_) {
      if (sets_.root(link.from) == sets_.root(link.to)) result[sets_.root(link.from)].boundary -= 2.0;
    }
    return result;
  }

  [[nodiscard]] bool could_be_room(const Part& part) const {
    const double cell = columns_.raster.cell_m;
    // Of a strip twice the area over the border is its width, of a square half of that.
    return part.spans * cell * cell >= kLeastRoom && 2.0 * part.spans * cell >= kLeastHalfWidth * part.boundary;
  }

  /// Of each cell the pair that has least reason to stay apart; what could not be a room comes first, with what it borders on most.
  std::map<CellId, Pair> worst_pairs() {
    const auto all = parts();
    struct Worst {
      Pair pair;
      std::pair<int, double> reason;
    };
    std::map<CellId, Worst> worst;
    for (const auto& [pair, border] : borders()) {
      const Part& a = all.at(pair.first);
      const Part& b = all.at(pair.second);
      const bool rooms = could_be_room(a) && could_be_room(b);
      const bool differ = lines_.label.empty() || a.label() != b.label();
      if (rooms && differ && border.walled() >= kWalled) continue;
      const std::pair<int, double> reason = rooms ? std::pair(1, border.walled()) : std::pair(0, -border.length());
      const CellId cell = cells_.of_span[pair.first];
      const auto [entry, fresh] = worst.try_emplace(cell, Worst{pair, reason});
      if (!fresh && reason < entry->second.reason) entry->second = {pair, reason};
    }
    std::map<CellId, Pair> result;
    for (const auto& [cell, w] : worst) result.emplace(cell, w.pair);
    return result;
  }

  bool merge_some() {
    const auto worst = worst_pairs();
    for (const auto& [cell, pair] : worst) sets_.join(pair.first, pair.second);
    return !worst.empty();
  }

  /// What was never linked stays as it was: of each linked piece the largest part keeps the number.
  void number() {
    const auto all = parts();
    std::vector<std::uint32_t> parts_root;
    for (std::uint32_t s = 0; s < cells_.of_span.size(); ++s) parts_root.push_back(sets_.root(s));
    for (const Crossing& link : crossings_) sets_.join(link.from, link.to);
    std::map<std::uint32_t, std::uint32_t> largest;  // of a piece
    for (const auto& [part, figures] : all) {
      const auto [entry, fresh] = largest.try_emplace(sets_.root(part), part);
      if (!fresh && figures.spans > all.at(entry->second).spans) entry->second = part;
    }
    std::map<std::uint32_t, CellId> numbers;
    for (std::uint32_t s = 0; s < cells_.of_span.size(); ++s) {
      if (!is_looked_at(s) || largest.at(sets_.root(s)) == parts_root[s]) continue;
      const auto [entry, fresh] = numbers.try_emplace(parts_root[s], static_cast<CellId>(cells_.count));
      if (fresh) ++cells_.count;
      cells_.of_span[s] = entry->second;
    }
  }

  const Columns& columns_;
  const PartingLines& lines_;
  RoomCells& cells_;
  DisjointSets<std::uint32_t> sets_;
  std::vector<std::uint8_t> is_crossed_;  ///< [cells] non-zero where a line leads through
  std::vector<Crossing> crossings_;
  std::map<std::uint32_t, Part> pieces_;  ///< by their roots before any were merged
  std::vector<Pair> walls_;
};

}  // namespace

std::uint32_t beside_in_cell(const Columns& columns, const std::vector<CellId>& of_span, std::uint32_t span,
                             std::size_t axis) {
  const auto column = columns.raster.beside(columns.spans[span].column, axis == 0 ? 1 : 0, axis == 0 ? 0 : 1);
  if (!column) return Span::kNone;
  std::uint32_t best = Span::kNone;
  float most = 0.0F;
  for (std::uint32_t t = columns.of(*column).first; t < columns.of(*column).second; ++t) {
    if (of_span[t] != of_span[span]) continue;
    const float overlap = overlap_m(columns.spans[span], columns.spans[t]);
    if (overlap <= most) continue;
    most = overlap;
    best = t;
  }
  return best;
}

void part_cells(const Columns& columns, const PartingLines& lines, RoomCells& cells) {
  Parting(columns, lines, cells).run();
}

}  // namespace clerestory::mesh
