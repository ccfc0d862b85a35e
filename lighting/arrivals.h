// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "lighting/links.h"
#include "lighting/packed_slopes.h"
#include "mesh/element_tree.h"

namespace clerestory::lighting {

/// Light that arrives at a node by a link, as solving goes through it, in 16 bytes: source, form factor times visibility, how that runs over
/// both ends, and how the link was made. What only the oracle needs is apart.
class Arrival {
 public:
  Arrival() = default;
  /// @param back  whether this is what the link's source receives: the link is reversed() already then
  Arrival(const Link& link, bool back);

  [[nodiscard]] LinkSource source() const {
    return LinkSource::of_number((source_ & kNumber) | (source_ & kClusterBit));
  }
  [[nodiscard]] float factor() const { return factor_; }
  [[nodiscard]] float slope_u() const { return factor_ * slopes_.slope_u.value(); }
  [[nodiscard]] float slope_v() const { return factor_ * slopes_.slope_v.value(); }
  [[nodiscard]] float moment_u() const { return factor_ * slopes_.moment_u.value(); }
  [[nodiscard]] float moment_v() const { return factor_ * slopes_.moment_v.value(); }
  [[nodiscard]] const PackedSlopes& slopes() const { return slopes_; }
  /// Proven to see all of its source.
  [[nodiscard]] bool is_proven() const { return made() == kProven || is_mutual(); }
  /// One of the two ways of a mutual link, and of these the one in which it was made second.
  [[nodiscard]] bool is_mutual() const { return made() == kMutual || made() == kBack; }
  [[nodiscard]] bool is_back() const { return made() == kBack; }
  [[nodiscard]] bool by_rays() const { return made() == kByRays; }

  /// As it is kept in files.
  using Words = std::array<std::uint32_t, 4>;
  [[nodiscard]] Words words() const;
  /// None for words that no arrival has.
  static std::optional<Arrival> of_words(const Words& words);

 private:
  enum Made : std::uint32_t { kSampled, kProven, kMutual, kBack, kByRays };
  static constexpr std::uint32_t kClusterBit = 0x80000000U;
  static constexpr std::uint32_t kMadeShift = 28;
  static constexpr std::uint32_t kNumber = (1U << kMadeShift) - 1U;  ///< more nodes than memory has room for
  static_assert(sizeof(PackedSlopes) == 8);

  [[nodiscard]] Made made() const { return static_cast<Made>((source_ & ~kClusterBit) >> kMadeShift); }

  std::uint32_t source_ = 0;  ///< number, how the link was made, and the highest bit for a cluster
  float factor_ = 0.0F;
  PackedSlopes slopes_;
};
static_assert(sizeof(Arrival) == 16);

/// What only the oracle needs of a link, in the direction of its arrival.
struct ArrivalError {
  float error = 0.0F;  ///< as Link has it
  float noise = 0.0F;
  bool split_small = false;
  bool rough = false;
};

/// Links by where their light arrives; mutual links arrive at both ends.
class Arrivals {
 public:
  Arrivals() = default;
  /// @param lists        links at one node stay in this order
  /// @param with_errors  whether the links' errors are kept too
  Arrivals(std::initializer_list<std::span<const Link>> lists, const mesh::ElementTree& tree, bool with_errors);
  /// As they were kept. Arrivals at one node follow each other; `errors` is empty or has one for each of them.
  Arrivals(std::vector<mesh::ElementId> receivers, std::vector<std::size_t> starts, std::vector<Arrival> arrivals,
           std::vector<ArrivalError> errors);

  /// How many arrivals there are, and the bytes that they and their order take.
  [[nodiscard]] std::size_t count() const { return arrivals_.size(); }
  [[nodiscard]] std::size_t bytes() const;
  /// How many nodes receive.
  [[nodiscard]] std::size_t receivers() const { return receivers_.size(); }
  /// In ascending order.
  [[nodiscard]] mesh::ElementId receiver(std::size_t i) const { return receivers_[i]; }
  /// What arrives at the i-th receiver.
  [[nodiscard]] std::span<const Arrival> at(std::size_t i) const {
    return std::span(arrivals_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }
  /// What arrives at a node.
  [[nodiscard]] std::span<const Arrival> at(mesh::ElementId node) const;

  [[nodiscard]] bool has_errors() const { return !errors_.empty() || arrivals_.empty(); }
  /// Of what arrives at the i-th receiver. Precondition: they are kept.
  [[nodiscard]] std::span<const ArrivalError> errors_at(std::size_t i) const {
    return std::span(errors_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }
  void forget_errors();
  /// What arrives k-th at the i-th receiver, as the link that it came by; of a mutual one without the error of the other way.
  /// Precondition: errors are kept.
  [[nodiscard]] Link link(std::size_t i, std::size_t k) const;

 private:
  std::vector<mesh::ElementId> receivers_;
  std::vector<std::size_t> starts_{0};  ///< [receivers + 1]
  std::vector<Arrival> arrivals_;       ///< by receiver
  std::vector<ArrivalError> errors_;    ///< [arrivals], or empty
};

}  // namespace clerestory::lighting
