// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lighting/direct_light.h"
#include "lighting/links.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// The local pass of hierarchical radiosity [Lischinski, Tampieri, Greenberg 1993]: what comes straight from the sky, through openings, from
/// point sources and from surfaces that shine is computed anew at single points, where the solution has it as lines over nodes: of surfaces that shine exactly, by clipping
/// them by what stands before them, of openings by rays. All else is taken from the solution. Safe to call from many threads.
class StraightLight {
 public:
  /// @param solution  solved; kept by reference
  /// @param direct    what light_directly() gave before it was solved
  /// @param links     of the transport; those made by rays may be among them
  /// @param rays      towards each opening, and towards surfaces of which a part is hidden by so much that clipping them would take longer
  StraightLight(const Solution& solution, DirectLight direct, std::span<const Link> links, std::uint32_t rays);

  /// Straight light at a point of an element [lux, per channel]; nothing where that of the solution is as good: where form factors were made
  /// to add up, all that surrounds the element is wholly seen.
  [[nodiscard]] std::optional<std::vector<double>> at(mesh::ElementId element, const mesh::Point& point) const;
  /// What the solution has in its place there [lux].
  [[nodiscard]] double in_solution(mesh::ElementId element, const mesh::Point& point, std::size_t channel) const;

 private:
  /// A surface that shines, as a node is linked to it.
  struct Emitter {
    mesh::ElementId receiver;
    mesh::ElementId source;
    bool wholly_seen = false;
  };

  void add_link(const Link& link);
  void add_emitter(const Link& link);
  void through_opening(std::uint32_t opening, std::uint32_t rays, const mesh::Point& from, const mesh::Vector& normal,
                       std::vector<double>& lux) const;
  void from_open_sky(const mesh::Point& from, const mesh::Vector& normal, std::vector<double>& lux) const;
  void from_emitter(const Emitter& emitter, const mesh::Point& from, const mesh::Vector& normal,
                    std::vector<double>& lux) const;
  [[nodiscard]] std::optional<double> seen_factor(mesh::ElementId source, const mesh::Point& from,
                                                  const mesh::Vector& normal) const;
  [[nodiscard]] double seen_share(mesh::ElementId source, const mesh::Point& from, const mesh::Vector& normal) const;

  const Solution& solution_;
  std::vector<NodeDirect> nodes_;
  std::vector<std::uint32_t> node_at_;  ///< [nodes of the tree] index into nodes_, kNone for others
  std::vector<LinearValue> straight_;   ///< [nodes × channels] as the solution has it
  std::vector<Emitter> emitters_;       ///< by receiver
  std::uint32_t rays_;
};

}  // namespace clerestory::lighting
