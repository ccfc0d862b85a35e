// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channel_solver.h"

#include <algorithm>
#include <cmath>

#include "lighting/parallel.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

/// Channels of a block: as many as keep what links read of a source within a few lines of cache, and their sums in registers.
constexpr std::size_t kLanes = 16;
/// What may be missing of a channel, as a share of it.
constexpr double kConverged = 1e-5;
constexpr std::size_t kMostIterations = 5000;

/// A value a channel of the block.
struct Lanes {
  float values __attribute__((vector_size(kLanes * sizeof(float))));
};

/// A line over a node, or a node's radiosity with its first moments, a channel each.
struct Line {
  Lanes value{};
  Lanes u{};
  Lanes v{};
};

void add(Lanes& sum, float factor, const Lanes& more) { sum.values += factor * more.values; }

void add(Line& sum, const Line& more) {
  sum.value.values += more.value.values;
  sum.u.values += more.u.values;
  sum.v.values += more.v.values;
}

/// Adds a line over a parent as its child has it.
void add_shifted(Line& sum, const ChannelSystem::Row& row, const Line& parent) {
  sum.value.values += parent.value.values + row.place.du * parent.u.values + row.place.dv * parent.v.values;
  sum.u.values += parent.u.values;
  sum.v.values += parent.v.values;
}

/// A product of lines as Solution has it: see product() there.
Line scaled(const ChannelSystem::Row& row, const Line& line) {
  const LinearValue& s = row.closing;
  const auto au = static_cast<float>(row.area.uu * s.slope_u + row.area.uv * s.slope_v);
  const auto av = static_cast<float>(row.area.uv * s.slope_u + row.area.vv * s.slope_v);
  Line result;
  result.value.values = s.value * line.value.values + au * line.u.values + av * line.v.values;
  result.u.values = s.value * line.u.values + s.slope_u * line.value.values;
  result.v.values = s.value * line.v.values + s.slope_v * line.value.values;
  return result;
}

/// What links take of an element that is closed: see Solution::sent().
Line sent_by_closed(const ChannelSystem::Row& row, const Line& own) {
  const LinearValue& s = row.closing;
  const Moments m = moments_of(s, row.area);
  Line result;
  result.value.values = s.value * own.value.values + s.slope_u * own.u.values + s.slope_v * own.v.values;
  result.u.values = s.value * own.u.values + m.u * own.value.values;
  result.v.values = s.value * own.v.values + m.v * own.value.values;
  return result;
}

/// The groups from `first` on in one band.
class Block {
 public:
  Block(const Solution& solution, const ChannelSystem& system, std::size_t first, std::size_t band)
      : solution_(solution),
        system_(system),
        first_(first),
        band_(band),
        straight_(system.rows.size()),
        own_(system.rows.size()),
        linked_(system.rows.size()),
        radiosity_(system.rows.size()),
        sent_(system.row_count()) {}

  /// @param direct  of these groups
  /// @param flux    first reflected and emitted by all groups [lm]
  /// Returns the number of iterations.
  std::size_t run(std::span<const GroupDirect> direct, double flux) {
    give(direct);
    emit();
    guess(direct, flux);
    Lanes last{};
    for (std::size_t i = 1;; ++i) {
      push();
      pull();
      // The first change is from nothing to the guess: it tells nothing of how changes shrink.
      if ((i > 1 && is_converged(last)) || i == kMostIterations) return i;
      gather();
    }
  }

  /// Adds what elements reflect, luminance-weighted.
  void add_to(GroupRadiosity& result) const {
    const std::size_t groups = result.groups();
    const std::size_t count = std::min(kLanes, groups - first_);
    const float weight = solution_.scene().channel_weights[band_];
    for (std::size_t r = 0; r < system_.rows.size(); ++r) {
      if (!system_.rows[r].is_element) continue;
      const Line lux = irradiance(r);
      const float factor = weight * reflectance(r);
      const std::span<float> lines = result.lines(system_.rows[r].node).subspan(first_);
      for (std::size_t k = 0; k < count; ++k) {
        lines[k] += factor * lux.value.values[k];
        lines[groups + k] += factor * lux.u.values[k];
        lines[2 * groups + k] += factor * lux.v.values[k];
      }
    }
  }

 private:
  using Row = ChannelSystem::Row;

  struct Emitted {
    std::size_t row = 0;
    std::size_t lane = 0;
    float exitance = 0.0F;
  };

  [[nodiscard]] mesh::FaceSide side(std::size_t row) const {
    return solution_.tree().face_side(system_.rows[row].node);
  }
  [[nodiscard]] float reflectance(std::size_t row) const {
    return solution_.scene().side_reflectance(side(row))[band_];
  }
  [[nodiscard]] float area(std::size_t row) const {
    return static_cast<float>(solution_.tree().area(system_.rows[row].node));
  }

  /// Direct light at the nodes, and handed down.
  void give(std::span<const GroupDirect> direct) {
    for (const GroupDirect& given : direct) {
      const std::size_t k = given.group - first_;
      Line& line = straight_[system_.row_of(given.node)];
      line.value.values[k] += given.lux.value;
      line.u.values[k] += given.lux.slope_u;
      line.v.values[k] += given.lux.slope_v;
    }
    for (std::size_t r = 0; r < straight_.size(); ++r) {
      const Row& row = system_.rows[r];
      if (row.parent != ChannelSystem::kNone) add_shifted(straight_[r], row, straight_[row.parent]);
    }
  }

  void emit() {
    const Scene& scene = solution_.scene();
    for (std::size_t r = 0; r < system_.rows.size(); ++r) {
      const std::uint32_t group = scene.groups.column_of(scene.side_group[side(r).index()]);
      if (!system_.rows[r].is_element || group < first_ || group >= first_ + kLanes) continue;
      const float exitance = scene.side_exitance(side(r))[band_];
      if (exitance > 0.0F) emitted_.push_back({r, group - first_, exitance});
    }
  }

  /// Begins with light by links spread as that of all groups together is, as much of it as each group sends out: from the second bounce on
  /// light has all but forgotten where it came from.
  void guess(std::span<const GroupDirect> direct, double all) {
    Lanes share{};
    for (const GroupDirect& given : direct) {
      const std::uint32_t r = system_.row_of(given.node);
      share.values[given.group - first_] += area(r) * reflectance(r) * given.lux.value;
    }
    for (const Emitted& e : emitted_) share.values[e.lane] += area(e.row) * e.exitance;
    if (all <= 0.0) return;
    share.values *= static_cast<float>(1.0 / all);
    for (std::size_t r = 0; r < own_.size(); ++r) {
      const LinearValue& mix = solution_.gathered(system_.rows[r].node)[band_];
      own_[r].value.values = mix.value * share.values;
      own_[r].u.values = mix.slope_u * share.values;
      own_[r].v.values = mix.slope_v * share.values;
    }
  }

  [[nodiscard]] Line irradiance(std::size_t r) const {
    const Row& row = system_.rows[r];
    Line lux = row.is_closed ? scaled(row, linked_[r]) : linked_[r];
    add(lux, straight_[r]);
    return lux;
  }

  /// Hands light by links down to the elements.
  void push() {
    for (std::size_t r = 0; r < own_.size(); ++r) {
      linked_[r] = own_[r];
      const Row& row = system_.rows[r];
      if (row.parent != ChannelSystem::kNone) add_shifted(linked_[r], row, linked_[row.parent]);
    }
  }

  /// Hands radiosity up to the roots and clusters, and notes how it has changed.
  void pull() {
    std::fill(sent_.begin(), sent_.end(), Line{});
    changed_ = Lanes{};
    all_ = Lanes{};
    std::size_t emitted = emitted_.size();
    for (std::size_t r = system_.rows.size(); r-- > 0;) {
      const Row& row = system_.rows[r];
      if (row.is_element) {
        Line own = reflected(r);
        while (emitted > 0 && emitted_[emitted - 1].row == r) {
          --emitted;
          own.value.values[emitted_[emitted].lane] += emitted_[emitted].exitance;
        }
        note_change(r, own.value);
        sent_[r] = row.is_closed ? sent_by_closed(row, own) : own;
      }
      if (row.parent != ChannelSystem::kNone) hand_up(row, sent_[r], sent_[row.parent]);
    }
    pull_clusters();
  }

  /// An element's radiosity and first moments by what it receives.
  [[nodiscard]] Line reflected(std::size_t r) const {
    const float rho = reflectance(r);
    const mesh::SecondMoments& area = system_.rows[r].area;
    const auto uu = static_cast<float>(rho * area.uu);
    const auto uv = static_cast<float>(rho * area.uv);
    const auto vv = static_cast<float>(rho * area.vv);
    const Line lux = irradiance(r);
    Line own;
    own.value.values = rho * lux.value.values;
    own.u.values = uu * lux.u.values + uv * lux.v.values;
    own.v.values = uv * lux.u.values + vv * lux.v.values;
    return own;
  }

  /// In terms of the light of all groups there, each element alike: most flux and area may be outdoors, and deep in a building, where
  /// elements are small because they matter, little of it arrives.
  void note_change(std::size_t r, const Lanes& radiosity) {
    const float mix = solution_.radiosity(system_.rows[r].node)[band_];
    if (mix <= 0.0F) return;
    const float per_mix = 1.0F / mix;
    Lanes step;
    step.values = radiosity.values - radiosity_[r].values;
    step.values = step.values < 0.0F ? -step.values : step.values;
    add(changed_, per_mix, step);
    add(all_, per_mix, radiosity);
    radiosity_[r] = radiosity;
  }

  static void hand_up(const Row& row, const Line& sent, Line& parent) {
    add(parent.value, row.place.share, sent.value);
    parent.u.values += row.place.share * (sent.u.values + row.place.du * sent.value.values);
    parent.v.values += row.place.share * (sent.v.values + row.place.dv * sent.value.values);
  }

  void pull_clusters() {
    const std::size_t first = system_.rows.size();
    for (std::size_t c = system_.clusters.size(); c-- > 0;) {
      const ChannelSystem::Cluster& cluster = system_.clusters[c];
      Lanes& sum = sent_[first + c].value;
      add(sum, cluster.left_share, sent_[cluster.left].value);
      if (cluster.right != ChannelSystem::kNone) add(sum, 1.0F - cluster.left_share, sent_[cluster.right].value);
    }
  }

  /// Changes shrink by a factor q a step: what is still to come is the rest of the geometric series.
  bool is_converged(Lanes& last) const {
    bool all = true;
    for (std::size_t k = 0; k < kLanes; ++k) {
      if (all_.values[k] <= 0.0F) continue;
      const double change = changed_.values[k] / all_.values[k];
      const double before = last.values[k];
      const double q = before > 0.0 ? std::min(0.999, change / before) : 0.5;
      all = all && change * q / (1.0 - q) <= kConverged;
      last.values[k] = static_cast<float>(change);
    }
    return all;
  }

  void gather() {
    for (std::size_t i = 0; i < system_.receivers.size(); ++i) {
      Line sum;
      for (std::uint32_t k = system_.first_term[i]; k < system_.first_term[i + 1]; ++k) {
        const ChannelSystem::Term& term = system_.terms[k];
        const Line& sent = sent_[term.source];
        const float moment_u = term.factor * term.slopes.moment_u.value();
        const float moment_v = term.factor * term.slopes.moment_v.value();
        sum.value.values += term.factor * sent.value.values + moment_u * sent.u.values + moment_v * sent.v.values;
        add(sum.u, term.factor * term.slopes.slope_u.value(), sent.value);
        add(sum.v, term.factor * term.slopes.slope_v.value(), sent.value);
      }
      own_[system_.receivers[i]] = sum;
    }
  }

  const Solution& solution_;
  const ChannelSystem& system_;
  std::size_t first_;  ///< group
  std::size_t band_;
  std::vector<Line> straight_;  ///< direct light of rows, what is above them included
  std::vector<Line> own_;       ///< by links of the row itself
  std::vector<Line> linked_;    ///< by links, what is above the row included
  std::vector<Lanes> radiosity_;
  std::vector<Line> sent_;  ///< of rows and clusters
  std::vector<Emitted> emitted_;
  Lanes changed_;
  Lanes all_;
};

/// Flux that all groups send out first: their light reflected once, and what shines [lm].
double first_flux(const Solution& solution, std::span<const GroupDirect> direct, std::size_t band) {
  const Scene& scene = solution.scene();
  const mesh::ElementTree& tree = solution.tree();
  double flux = 0.0;
  for (const GroupDirect& given : direct)
    flux += tree.area(given.node) * scene.side_reflectance(tree.face_side(given.node))[band] * given.lux.value;
  for (const ElementId root : tree.roots()) flux += tree.area(root) * scene.side_exitance(tree.face_side(root))[band];
  return flux;
}

}  // namespace

GroupRadiosity::GroupRadiosity(std::size_t nodes, std::span<const ElementId> elements, std::size_t groups)
    : groups_(groups), row_(nodes, 0), lines_(3 * groups * elements.size(), 0.0F) {
  for (std::uint32_t i = 0; i < elements.size(); ++i) row_[elements[i].index()] = i;
}

GroupRadiosity solve_channels(const Solution& solution, const ChannelSystem& system,
                              std::span<const GroupDirect> direct) {
  const SourceGroups& columns = solution.scene().groups;
  const std::size_t groups = columns.column_count();
  GroupRadiosity result(solution.tree().size(), solution.elements(), groups);
  std::vector<GroupDirect> by_group(direct.begin(), direct.end());
  for (GroupDirect& given : by_group) given.group = columns.column_of(given.group);
  std::stable_sort(by_group.begin(), by_group.end(),
                   [](const GroupDirect& a, const GroupDirect& b) { return a.group < b.group; });
  std::vector<double> flux;
  for (std::size_t band = 0; band < solution.channels(); ++band) flux.push_back(first_flux(solution, direct, band));
  std::vector<std::size_t> iterations((groups + kLanes - 1) / kLanes, 0);
  parallel_for(iterations.size(), [&](std::size_t b) {
    const auto from = [&](std::size_t group) {
      return std::partition_point(by_group.begin(), by_group.end(),
                                  [&](const GroupDirect& given) { return given.group < group; });
    };
    const std::span own(from(b * kLanes), from((b + 1) * kLanes));
    for (std::size_t band = 0; band < solution.channels(); ++band) {
      Block block(solution, system, b * kLanes, band);
      iterations[b] = std::max(iterations[b], block.run(own, flux[band]));
      block.add_to(result);
    }
  });
  if (!iterations.empty()) result.iterations = *std::max_element(iterations.begin(), iterations.end());
  return result;
}

}  // namespace clerestory::lighting
