// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lighting/arrivals.h"
#include "lighting/direct_light.h"
#include "lighting/emitters.h"
#include "lighting/lamp_bodies.h"
#include "lighting/sampling.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"

namespace clerestory::lighting {

/// The local pass of hierarchical radiosity [Lischinski, Tampieri, Greenberg 1993]: light at single points of surfaces, finer than the elements
/// of the solution. What comes straight from surfaces that shine is exact, by clipping them by what stands before them, or by rays where that
/// is much; what comes through openings is sampled, and what surfaces reflect is gathered over the hemisphere from the solution. Where all that
/// surrounds an element is proven visible and fills its hemisphere, light comes by the links of the element, with exact form factors from the
/// point. Safe to call from many threads.
class LocalPass {
 public:
  struct Light {
    std::vector<double> lux;  ///< per channel
    double error_lux = 0.0;   ///< standard error: rays', and that of the solution they meet
  };

  /// @param solution  solved; kept by reference, as its links and errors are
  /// @param nodes     of light_directly(): the openings that each looks at
  /// @param accuracy  errors are brought to about twice this share
  /// @param dark_lux  darker points need not be better than points of so much light
  LocalPass(const Solution& solution, const Arrivals& arrivals, const SolutionErrors& errors,
            std::span<const NodeDirect> nodes, double accuracy, double dark_lux);
  LocalPass(const LocalPass&) = delete;
  LocalPass& operator=(const LocalPass&) = delete;

  /// A body that may be seen, and whether what faces a point is proven to be.
  struct BodyInSight {
    const LampBody* body = nullptr;
    bool clear = false;
  };
  /// Surfaces that shine and that points of an element may see.
  struct Lamps {
    std::vector<EmitterInSight> single;
    std::vector<BodyInSight> bodies;
  };
  [[nodiscard]] Lamps lamps_of(mesh::ElementId element) const;

  /// Light at a point of an element. Where nothing reaches the element, its points stay dark unless they see more than its error and than
  /// the accuracy lets pass: at the edge of what a solid covers that stops a hair short, light falls into the gap.
  /// @param lamps  of the element: for many points of it, found out once
  [[nodiscard]] Light at(mesh::ElementId element, const mesh::Point& point, const Lamps& lamps) const;
  /// The same at the point of a limit surface that a point of an element of a curved part stands for, with that surface's normal: shading is
  /// smooth over the triangles that rays see. Where that point is above its triangle rays start from it, else from the triangle. Nothing where the
  /// element is closed: links know its own plane alone.
  /// @param limit  its normal is that of the element's side
  [[nodiscard]] std::optional<Light> at_limit(mesh::ElementId element, const mesh::Point& point,
                                              const mesh::LimitPoint& limit) const;
  /// The part of it that comes from surfaces that shine and from point sources, luminance-weighted [lux]: it is exact at every point. Nothing where
  /// the element is closed, and where it takes rays, as panes or a crowd stand before a surface that shines.
  /// @param lamps      of the element
  /// @param least_lux  surfaces that could give less are left out
  [[nodiscard]] std::optional<double> by_lamps(mesh::ElementId element, const mesh::Point& point, const Lamps& lamps,
                                               double least_lux) const;
  [[nodiscard]] bool has_lamps() const { return !emitters_.empty() || !solution_.scene().luminaires.empty(); }

 private:
  struct Receiver {
    mesh::Point from;
    mesh::Vector normal;
    std::span<const LuminaireView> luminaires;  ///< those that it may see
    const Lamps& lamps;                         ///< the same of surfaces that shine
  };
  class Sum;
  /// An opening that all of so many rays have missed.
  struct Missed {
    MinorOpening opening;
    std::uint32_t rays = 0;
  };

  [[nodiscard]] Light light(mesh::ElementId element, const Receiver& receiver) const;
  [[nodiscard]] bool is_dark(mesh::ElementId element) const;
  [[nodiscard]] Light by_links(mesh::ElementId element, const Receiver& receiver) const;
  [[nodiscard]] bool is_near(mesh::ElementId source, const Receiver& receiver) const;
  bool add_source(mesh::ElementId source, const Receiver& receiver, std::vector<double>& lux) const;
  [[nodiscard]] std::uint32_t rays_each(std::size_t openings) const;
  [[nodiscard]] double by_luminaires(const Receiver& receiver, double tolerance) const;
  [[nodiscard]] std::span<const LuminaireView> luminaires(mesh::ElementId element) const;
  [[nodiscard]] SeenFactor seen(const EmitterInSight& lamp, double full, const Receiver& receiver) const;
  void from_emitter(const EmitterInSight& lamp, const Receiver& receiver, Sum& sum) const;
  /// What a point would get from a body's facets if nothing stood before them.
  struct FacetLight {
    const BodyFacet* facet = nullptr;
    double factor = 0.0;
  };
  struct BodyLight {
    std::vector<FacetLight> facets;  ///< those that give anything
    double lux = 0.0;                ///< luminance-weighted, of all of them
  };
  [[nodiscard]] BodyLight full_light(const LampBody& body, const Receiver& receiver) const;
  template <class Add, class Clip>
  double see_body(const BodyInSight& lamp, const BodyLight& full, const Receiver& receiver, const Add& add,
                  const Clip& clip) const;
  template <class Add>
  double see_middles(std::span<const FacetLight> facets, const Receiver& receiver, const Add& add) const;
  void from_body(const BodyInSight& lamp, const Receiver& receiver, Sum& sum) const;
  [[nodiscard]] bool through_opening(const MinorOpening& drawn, std::uint32_t rays, const Receiver& receiver,
                                     Sum& sum) const;
  void add_missed(std::span<const Missed> missed, const Receiver& receiver, Sum& sum) const;
  void from_surfaces(const Receiver& receiver, Sum& sum) const;

  /// Radiosities of a node and all below it as they are: the solution scales them where hemispheres were closed.
  void pull(mesh::ElementId e);

  const Solution& solution_;
  const Arrivals& arrivals_;
  const SolutionErrors& errors_;
  std::span<const NodeDirect> nodes_;
  std::vector<std::uint32_t> node_at_;  ///< [nodes of the tree] index into nodes_, kNone for others
  std::vector<Solution::Sent> sent_;    ///< [nodes × channels] where elements are closed
  std::vector<Emitter> emitters_;
  LampBodies bodies_;
  Lamps all_lamps_;                        ///< of which nothing is known
  std::vector<LuminaireView> luminaires_;  ///< all, of which nothing is known
  std::vector<mesh::ShaftEnd> opening_ends_;
  /// Points of the unit square, and the directions of the hemisphere about z that belong to them, by ray. They are the same at all points:
  /// differences between these are then the light's own.
  std::vector<std::array<double, 2>> numbers_;
  std::vector<mesh::Vector> hemisphere_;
  std::uint32_t rays_;  ///< towards a source that is not wholly seen
  std::uint32_t most_rays_;
  double accuracy_;
  double fine_;  ///< share of a luminaire's light that may be missed at a point
  double dark_lux_;
};

}  // namespace clerestory::lighting
