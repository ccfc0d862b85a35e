// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/en12464.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace clerestory::lighting {

namespace {

using Verdict = Criterion::Verdict;

/// Uniformities of all but the task area. Source: EN 12464-1:2021, 4.3.4, 4.3.5, 4.5, 5.3.
constexpr double kSurroundingUniformity = 0.40;
constexpr double kOtherUniformity = 0.10;
constexpr double kBackgroundShare = 1.0 / 3.0;
/// What modelling should be. Source: EN 12464-1:2021, 4.5.3.
constexpr double kLeastModelling = 0.30;
constexpr double kMostModelling = 0.60;

/// Of the immediate surrounding, by that of the task. Source: EN 12464-1:2021, table 1.
double surrounding_lux(double task_lux) {
  if (task_lux >= 750.0) return 500.0;
  if (task_lux >= 500.0) return 300.0;
  if (task_lux >= 300.0) return 200.0;
  return std::min(task_lux, 150.0);
}

/// Mean and uniformity of values, with their errors.
struct Figures {
  double mean = 0.0;
  double mean_error = 0.0;
  double uniformity = 0.0;
  double uniformity_error = 0.0;
};

Figures figures_of(const std::vector<float>& lux, const std::vector<float>& error_lux) {
  Figures f;
  std::size_t darkest = 0;
  for (std::size_t i = 0; i < lux.size(); ++i) {
    f.mean += lux[i] / static_cast<double>(lux.size());
    f.mean_error += error_lux[i] / static_cast<double>(lux.size());
    if (lux[i] < lux[darkest]) darkest = i;
  }
  if (f.mean <= 0.0) return f;
  f.uniformity = lux[darkest] / f.mean;
  f.uniformity_error = std::hypot(error_lux[darkest], f.uniformity * f.mean_error) / f.mean;
  return f;
}

class Judge {
 public:
  Judge(const TaskRequirements& required, const TaskFindings& findings) : required_(required), findings_(findings) {}

  TaskResult judge() {
    result_.task = required_.task;
    add(TaskArea::kTask, "task area", required_.illuminance_lux, required_.uniformity);
    const double surrounding = surrounding_lux(required_.illuminance_lux);
    add(TaskArea::kSurrounding, "immediate surrounding", surrounding, kSurroundingUniformity);
    add(TaskArea::kBackground, "background", kBackgroundShare * surrounding, kOtherUniformity);
    add_cylindrical();
    if (required_.walls_lux > 0.0) add(TaskArea::kWalls, "walls", required_.walls_lux, kOtherUniformity);
    if (required_.ceiling_lux > 0.0) add(TaskArea::kCeiling, "ceiling", required_.ceiling_lux, kOtherUniformity);
    add_glare();
    add_remarks();
    result_.verdict = unjudged_ ? Verdict::kUndecided : Verdict::kPass;
    for (const Criterion& c : result_.criteria) {
      if (c.verdict == Verdict::kFail) result_.verdict = Verdict::kFail;
      if (c.verdict == Verdict::kUndecided && result_.verdict == Verdict::kPass) result_.verdict = Verdict::kUndecided;
    }
    return std::move(result_);
  }

 private:
  void add(Criterion criterion) {
    criterion.verdict = verdict_of(criterion);
    result_.criteria.push_back(std::move(criterion));
  }

  void add(const std::string& what, const Figures& f, double lux, double uniformity) {
    add({.what = "mean, " + what, .unit = "lx", .required = lux, .found = f.mean, .error = f.mean_error});
    add({.what = "uniformity, " + what,
         .unit = "",
         .required = uniformity,
         .found = f.uniformity,
         .error = f.uniformity_error});
  }

  void add(TaskArea area, const std::string& what, double lux, double uniformity) {
    const GridResult* grid = findings_.area(area);
    if (grid != nullptr) {
      add(what, figures_of(grid->illuminance_lux, grid->error_lux), lux, uniformity);
    } else if (area == TaskArea::kWalls || area == TaskArea::kCeiling || area == TaskArea::kTask) {
      missing("the " + what + " has no place for a sensor");
    }
  }

  /// What cannot be looked at is not decided.
  void missing(const std::string& what) {
    result_.remarks.push_back(what + ": not judged.");
    unjudged_ = true;
  }

  void add_cylindrical() {
    const GridResult* grid = findings_.area(TaskArea::kActivity);
    if (grid == nullptr) return;
    if (required_.cylindrical_lux > 0.0)
      add("cylindrical", figures_of(grid->cylindrical_lux, grid->cylindrical_error_lux), required_.cylindrical_lux,
          kOtherUniformity);
    const double modelling = grid->metrics.mean_modelling;
    const bool good = modelling >= kLeastModelling && modelling <= kMostModelling;
    result_.remarks.push_back(
        fmt::format("Modelling is {:.2f} on average, {} 0.30 to 0.60 that the standard recommends.", modelling,
                    good ? "within the" : "outside the"));
  }

  void add_glare() {
    if (required_.ugr <= 0.0) return;
    if (findings_.observers.empty()) return missing("nobody's glare is known");
    const ObserverResult* worst =
        *std::ranges::max_element(findings_.observers, {}, [](const ObserverResult* o) { return o->ugr; });
    std::size_t odd = 0;
    std::size_t without_area = 0;
    for (const ObserverResult* o : findings_.observers) {
      odd += o->small + o->large;
      without_area += o->without_area;
    }
    if (without_area > 0)
      return missing("luminaires without a luminous area have no luminance, and UGR cannot be told");
    if (!std::isfinite(worst->ugr)) {
      result_.remarks.emplace_back("Nothing glares towards any observer.");
      return;
    }
    add({.what = fmt::format("UGR, observer '{}'", worst->observer.name),
         .unit = "",
         .required = required_.ugr,
         .at_most = true,
         .found = worst->ugr,
         .error = worst->ugr_error});
    if (odd > 0)
      result_.remarks.push_back(fmt::format(
          "{} of the luminaires seen are smaller than 0.0003 sr or larger than 0.1 sr, which UGR is not made for.",
          odd));
  }

  void add_remarks() {
    if (findings_.whole_room)
      result_.remarks.emplace_back(
          "The task area is the whole room but for a strip along its walls; surrounding and background are not "
          "judged.");
    if (findings_.with_daylight)
      result_.remarks.emplace_back(
          "Daylight is part of these figures; for the electric light alone run with sky.type = \"none\".");
  }

  const TaskRequirements& required_;
  const TaskFindings& findings_;
  TaskResult result_;
  bool unjudged_ = false;
};

}  // namespace

Verdict verdict_of(const Criterion& criterion) {
  const double margin = (criterion.found - criterion.required) * (criterion.at_most ? -1.0 : 1.0);
  if (std::abs(margin) < 2.0 * criterion.error) return Verdict::kUndecided;
  return margin >= 0.0 ? Verdict::kPass : Verdict::kFail;
}

TaskResult judge(const TaskRequirements& required, const TaskFindings& findings) {
  return Judge(required, findings).judge();
}

}  // namespace clerestory::lighting
