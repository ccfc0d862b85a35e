// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/room_floors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace clerestory::mesh {

namespace {

/// Floors rise and fall by steps of no more than this [m].
constexpr float kStep = 0.25F;
/// What one falls less than this from is no gallery, nor is what has less above it [m].
constexpr float kStorey = 1.8F;
/// Shares of a surface's border over which one falls that make furniture of it: freely standing; standing at a wall, when it is narrow
/// or hollow below; a block, however high.
constexpr double kFreeStanding = 0.5;
constexpr double kPartStanding = 0.2;
constexpr double kBlock = 0.9;
/// Twice the area by the border, of what is narrow [m].
constexpr double kNarrow = 0.5;

/// What is walked on without falling.
struct Deck {
  CellId room = kNoCell;
  std::vector<std::uint32_t> spans;
  std::size_t border = 0;                      ///< [cells]
  std::size_t shallow = 0;                     ///< of them, with a floor of the room less than a storey lower
  std::size_t deep = 0;                        ///< … and a storey or more lower
  std::size_t hollow = 0;                      ///< spans with something free right below
  std::map<std::uint32_t, std::size_t> lower;  ///< decks that one falls on, with the length of the border to them
  float level = 0.0F;                          ///< median [m]
  float headroom = 0.0F;                       ///< where there is most [m]
  bool floorless = false;                      ///< the plane in which a stairwell opens
};

class Decks {
 public:
  explicit Decks(const RoomDrafts& drafts) : drafts_(drafts), deck_of_(drafts.of_span.size(), Span::kNone) {
    for (std::uint32_t s = 0; s < drafts.of_span.size(); ++s) {
      if (drafts.of_span[s] != kNoCell && deck_of_[s] == Span::kNone) grow(s);
    }
    for (std::uint32_t s = 0; s < drafts.of_span.size(); ++s) {
      if (deck_of_[s] != Span::kNone) look_down(s);
    }
  }

  std::vector<RoomColumn> columns() {
    std::vector<std::uint32_t> stands;
    for (std::uint32_t d = 0; d < decks_.size(); ++d) stands.push_back(floor_below(d));
    std::vector<RoomColumn> result;
    for (std::uint32_t s = 0; s < drafts_.of_span.size(); ++s) {
      if (deck_of_[s] == Span::kNone) continue;
      const Span& span = drafts_.columns.spans[s];
      const std::uint32_t stands_on = stands[deck_of_[s]];
      const float floor = stands_on == deck_of_[s] ? span.low : std::min(span.low, decks_[stands_on].level);
      const auto kind = decks_[stands_on].floorless ? RoomColumn::Kind::kFloorless : RoomColumn::Kind::kWhole;
      add(result, {span.column, static_cast<std::uint32_t>(drafts_.of_span[s]), floor, span.high, span.low, kind});
    }
    return result;
  }

 private:
  template <class Visit>
  void beside(std::uint32_t s, const Visit& visit) const {
    for (const auto& column : drafts_.columns.raster.four_beside(drafts_.columns.spans[s].column)) {
      visit(column ? neighbour(s, *column) : Span::kNone);
    }
  }

  /// The span of the same room beside one, that which shares most height with it.
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t s, std::uint32_t column) const {
    const auto [first, last] = drafts_.columns.of(column);
    std::uint32_t best = Span::kNone;
    float most = 0.0F;
    for (std::uint32_t t = first; t < last; ++t) {
      const float overlap = overlap_m(drafts_.columns.spans[s], drafts_.columns.spans[t]);
      if (drafts_.of_span[t] != drafts_.of_span[s] || overlap <= most) continue;
      most = overlap;
      best = t;
    }
    return best;
  }

  [[nodiscard]] bool is_floorless(std::uint32_t s) const { return s > 0 && drafts_.columns.spans[s - 1].stairs; }

  void grow(std::uint32_t start) {
    const auto number = static_cast<std::uint32_t>(decks_.size());
    Deck deck;
    deck.room = drafts_.of_span[start];
    deck.floorless = is_floorless(start);
    deck.spans.push_back(start);
    deck_of_[start] = number;
    const auto& spans = drafts_.columns.spans;
    for (std::size_t next = 0; next < deck.spans.size(); ++next) {
      const std::uint32_t s = deck.spans[next];
      beside(s, [&](std::uint32_t t) {
        if (t == Span::kNone || deck_of_[t] != Span::kNone || std::abs(spans[t].low - spans[s].low) > kStep) return;
        if (is_floorless(t) != deck.floorless) return;
        deck_of_[t] = number;
        deck.spans.push_back(t);
      });
    }
    std::vector<float> levels;
    for (const std::uint32_t s : deck.spans) {
      levels.push_back(spans[s].low);
      deck.headroom = std::max(deck.headroom, spans[s].height());
    }
    const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
    std::nth_element(levels.begin(), middle, levels.end());
    deck.level = *middle;
    decks_.push_back(std::move(deck));
  }

  void look_down(std::uint32_t s) {
    Deck& deck = decks_[deck_of_[s]];
    const auto& spans = drafts_.columns.spans;
    beside(s, [&](std::uint32_t t) {
      if (t != Span::kNone && deck_of_[t] == deck_of_[s]) return;
      ++deck.border;
      if (t == Span::kNone || spans[t].low >= spans[s].low) return;
      ++(spans[s].low - spans[t].low < kStorey ? deck.shallow : deck.deep);
      ++deck.lower[deck_of_[t]];
    });
    constexpr float kThinnest = 0.2F;
    if (s > 0 && spans[s - 1].column == spans[s].column && spans[s].low - spans[s - 1].high < kThinnest) ++deck.hollow;
  }

  [[nodiscard]] bool is_furniture(const Deck& deck) const {
    if (deck.lower.empty() || deck.floorless) return false;
    if (deck.headroom < kStorey) return true;
    const auto border = static_cast<double>(deck.border);
    const double shallow = static_cast<double>(deck.shallow) / border;
    const double any = static_cast<double>(deck.shallow + deck.deep) / border;
    if (shallow >= kFreeStanding || any >= kBlock) return true;
    const double width = 2.0 * static_cast<double>(deck.spans.size()) * drafts_.columns.raster.cell_m / border;
    if (any >= kPartStanding && width < kNarrow) return true;
    return shallow >= kPartStanding && 2 * deck.hollow >= deck.spans.size();
  }

  /// The deck that a deck stands on: itself, unless it is furniture. Each is lower than the one before.
  [[nodiscard]] std::uint32_t floor_below(std::uint32_t deck) const {
    while (is_furniture(decks_[deck])) {
      const auto& lower = decks_[deck].lower;
      const auto longest = std::ranges::max_element(lower, {}, [](const auto& l) { return l.second; });
      if (decks_[longest->first].level >= decks_[deck].level) break;
      deck = longest->first;
    }
    return deck;
  }

  /// Spans come from below: a column that reaches down over the one before takes its place.
  static void add(std::vector<RoomColumn>& result, RoomColumn column) {
    while (!result.empty() && result.back().column == column.column && result.back().room == column.room &&
           result.back().ceiling > column.floor) {
      column.floor = std::min(column.floor, result.back().floor);
      result.pop_back();
    }
    result.push_back(column);
  }

  const RoomDrafts& drafts_;
  std::vector<std::uint32_t> deck_of_;
  std::vector<Deck> decks_;
};

}  // namespace

std::vector<RoomColumn> room_columns(const RoomDrafts& drafts) { return Decks(drafts).columns(); }

}  // namespace clerestory::mesh
