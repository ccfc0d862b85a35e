// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "lighting/channel_deviations.h"
#include "lighting/clusters.h"
#include "lighting/importance.h"
#include "lighting/links.h"
#include "lighting/slit_feet.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// A pair that may exchange light, to be linked or refined. Visibility is what was proven for a pair that holds this one.
struct LinkCandidate {
  mesh::ElementId receiver;
  LinkSource source;
  mesh::Visibility visibility = mesh::Visibility::kPartial;
  bool mutual = false;  ///< both are elements, proven to see each other, and both receive
};

/// What became of a candidate.
struct LinkDecision {
  enum class Kind { kNone, kLink, kSplitReceiver, kSplitSource };

  Kind kind = Kind::kNone;
  Link link;
};

/// The oracle of hierarchical radiosity [Hanrahan, Salzman, Aupperle 1991; Lischinski, Smits, Greenberg 1994]: estimates a link
/// and decides whether it is good enough, by the error of the transported light and what that matters to the sensors.
/// Pure functions of geometry and of the solution as it stands; safe to call from many threads.
class Linker {
 public:
  /// @param channels       where light is told apart, how unevenly it shines in channels: a link's error is the largest over channels then, by
  ///                       their weights, of which all light together is one; or else nothing
  /// @param tolerance_lux  error at the sensors that one link may cause
  Linker(const Solution& solution, const Clusters& clusters, const ChannelDeviations& channels,
         const Importance& importance, double tolerance_lux, std::uint64_t seed);

  [[nodiscard]] LinkDecision decide(const LinkCandidate& candidate) const;
  /// Where refinement must end: the pair is linked as it is, its error with it; clusters that hold the receiver are parted all the same.
  [[nodiscard]] LinkDecision settle(const LinkCandidate& candidate) const;
  /// The link of a pair, good enough or not; none where the pair does not see each other.
  [[nodiscard]] std::optional<Link> link(const LinkCandidate& candidate) const;
  /// The link of a pair that holds as it is to stay; none where it gives nothing. Links of elements are given back. A link of a cluster is measured at
  /// points of its own: those that found little light when it was judged also told of a small error, so that links which hold would
  /// give too little on the whole [Kirk, Arvo 1991].
  [[nodiscard]] std::optional<Link> remeasured(const Link& link) const;
  /// What can be proven of two elements without rays.
  [[nodiscard]] mesh::Visibility prove(mesh::ElementId receiver, mesh::ElementId source) const;
  /// How a mutual link is refined at ends that other links have opened, whose parts would share more than `most` of what its lines
  /// miss; kLink where nothing is to be done.
  [[nodiscard]] LinkDecision::Kind split_at_open_ends(const Link& link, double most) const;
  /// Whether a link made at a coarser tolerance, or with less light, still is good enough.
  [[nodiscard]] bool holds(const Link& link) const;
  /// Error of a link over what is tolerated, at the end where that is more; a link holds up to 1.
  [[nodiscard]] double worst_strain(const Link& link) const;
  /// How a link that does not hold is refined.
  [[nodiscard]] LinkDecision::Kind split_of(const Link& link) const;
  /// Error of a receiver's illuminance that causes as much at the sensors as one link may [lux].
  [[nodiscard]] double tolerance(mesh::ElementId receiver) const;

 private:
  [[nodiscard]] std::optional<Link> link_element(const LinkCandidate& candidate) const;
  /// Error at the receiver over what it tolerates.
  [[nodiscard]] double strain(const Link& link) const;
  [[nodiscard]] LinkDecision::Kind split_for_receiver(const Link& link) const;
  /// A bound on the illuminance that a source can give, were all of it to face the receiver [lux].
  [[nodiscard]] double most_light(mesh::ElementId receiver, LinkSource source) const;
  [[nodiscard]] bool cannot_matter(mesh::ElementId receiver, mesh::ElementId source) const;
  [[nodiscard]] std::optional<Link> link_roughly(const LinkCandidate& candidate) const;
  /// @param stream  numbers of links with other streams are independent
  [[nodiscard]] std::optional<Link> link_cluster(const LinkCandidate& candidate, std::uint64_t stream) const;
  /// Where importance lies on a part of the receiver, that part may get as much as a receiver of the source's own size would: a
  /// factor's error, for receivers whose places do not tell.
  [[nodiscard]] double unseen_peak(mesh::ElementId receiver, double exchange, double source_area) const;
  /// Lets the end be refined that is too large for the slit at which it lies, where one is: its places may all miss the strip at the slit's foot
  /// that sees most, and parts of the other end would miss it one like the other.
  void split_at_slits(Link& link) const;
  /// How far the source differs from its line, or a cluster from its mean, in the channel where it does so most [lm/m²].
  [[nodiscard]] double deviation(LinkSource source) const;
  [[nodiscard]] bool overlaps(mesh::ElementId receiver, std::uint32_t cluster) const;

  const Solution& solution_;
  const Clusters& clusters_;
  const ChannelDeviations& channels_;
  const Importance& importance_;
  double tolerance_lux_;
  std::uint64_t seed_;
  SlitFeet feet_;
};

}  // namespace clerestory::lighting
