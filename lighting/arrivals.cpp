// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/arrivals.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

/// Of a link without factor nothing runs anywhere.
PackedSlopes packed(const Link& link) {
  if (!(link.factor > 0.0F)) return {};
  const auto relative = [&](float slope) { return Packed(slope / link.factor); };
  return {relative(link.slope_u), relative(link.slope_v), relative(link.moment_u), relative(link.moment_v)};
}

std::uint32_t word(Packed low, Packed high) { return std::uint32_t{low.bits()} | std::uint32_t{high.bits()} << 16U; }

Packed low_of(std::uint32_t word) { return Packed::of_bits(static_cast<std::uint16_t>(word & 0xFFFFU)); }
Packed high_of(std::uint32_t word) { return Packed::of_bits(static_cast<std::uint16_t>(word >> 16U)); }

/// Calls f(receiver, link, back) for every arrival, in order of the links.
template <typename F>
void visit_arrivals(std::initializer_list<std::span<const Link>> lists, F&& f) {
  for (const std::span<const Link> links : lists) {
    for (const Link& link : links) {
      f(link.receiver, link, false);
      if (link.mutual) f(link.source.element(), link, true);
    }
  }
}

}  // namespace

Arrival::Arrival(const Link& link, bool back)
    : source_(link.source.number()), factor_(link.factor), slopes_(packed(link)) {
  assert((source_ & ~kClusterBit) <= kNumber);
  Made made = kSampled;
  if (link.mutual) {
    made = back ? kBack : kMutual;
  } else if (link.by_rays) {
    made = kByRays;
  } else if (link.visibility == mesh::Visibility::kVisible) {
    made = kProven;
  }
  source_ |= made << kMadeShift;
}

Arrival::Words Arrival::words() const {
  return {source_, std::bit_cast<std::uint32_t>(factor_), word(slopes_.slope_u, slopes_.slope_v),
          word(slopes_.moment_u, slopes_.moment_v)};
}

std::optional<Arrival> Arrival::of_words(const Words& words) {
  Arrival arrival;
  arrival.source_ = words[0];
  arrival.factor_ = std::bit_cast<float>(words[1]);
  arrival.slopes_ = {low_of(words[2]), high_of(words[2]), low_of(words[3]), high_of(words[3])};
  const bool clusters_mutual = arrival.source().is_cluster() && arrival.is_mutual();
  if (arrival.made() > kByRays || clusters_mutual || !(std::isfinite(arrival.factor_) && arrival.factor_ >= 0.0F))
    return std::nullopt;
  return arrival;
}

Arrivals::Arrivals(std::initializer_list<std::span<const Link>> lists, const mesh::ElementTree& tree,
                   bool with_errors) {
  std::vector<std::size_t> next(tree.size() + 1, 0);
  visit_arrivals(lists, [&](ElementId receiver, const Link&, bool) { ++next[receiver.index()]; });
  std::size_t before = 0;
  for (std::size_t node = 0; node < tree.size(); ++node) {
    const std::size_t own = std::exchange(next[node], before);
    if (own == 0) continue;
    before += own;
    receivers_.emplace_back(node);
    starts_.push_back(before);
  }
  arrivals_.resize(before);
  if (with_errors) errors_.resize(before);
  visit_arrivals(lists, [&](ElementId receiver, const Link& link, bool back) {
    const std::size_t place = next[receiver.index()]++;
    const Link& arriving = back ? reversed(link, tree) : link;
    arrivals_[place] = Arrival(arriving, back);
    if (with_errors) errors_[place] = {arriving.error, arriving.noise, arriving.split_small, arriving.rough};
  });
}

Arrivals::Arrivals(std::vector<ElementId> receivers, std::vector<std::size_t> starts, std::vector<Arrival> arrivals,
                   std::vector<ArrivalError> errors)
    : receivers_(std::move(receivers)),
      starts_(std::move(starts)),
      arrivals_(std::move(arrivals)),
      errors_(std::move(errors)) {
  assert(starts_.size() == receivers_.size() + 1 && starts_.back() == arrivals_.size());
}

std::size_t Arrivals::bytes() const {
  return arrivals_.size() * sizeof(Arrival) + errors_.size() * sizeof(ArrivalError) +
         receivers_.size() * sizeof(ElementId) + starts_.size() * sizeof(std::size_t);
}

std::span<const Arrival> Arrivals::at(ElementId node) const {
  const auto found = std::lower_bound(receivers_.begin(), receivers_.end(), node);
  if (found == receivers_.end() || *found != node) return {};
  return at(static_cast<std::size_t>(found - receivers_.begin()));
}

void Arrivals::forget_errors() { std::vector<ArrivalError>().swap(errors_); }

Link Arrivals::link(std::size_t i, std::size_t k) const {
  const Arrival& arrival = at(i)[k];
  const ArrivalError& known = errors_at(i)[k];
  Link link;
  link.receiver = receiver(i);
  link.source = arrival.source();
  link.factor = arrival.factor();
  link.slope_u = arrival.slope_u();
  link.slope_v = arrival.slope_v();
  link.moment_u = arrival.moment_u();
  link.moment_v = arrival.moment_v();
  link.error = known.error;
  link.noise = known.noise;
  link.visibility = arrival.is_proven() ? mesh::Visibility::kVisible : mesh::Visibility::kPartial;
  link.by_rays = arrival.by_rays();
  link.split_small = known.split_small;
  link.rough = known.rough;
  link.mutual = arrival.is_mutual();
  return link;
}

}  // namespace clerestory::lighting
