// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "lighting/results.h"
#include "mesh/progress.h"
#include "mesh/rays.h"

namespace clerestory::lighting {

/// Notes the time of each phase, and its rays.
class PhaseClock {
 public:
  explicit PhaseClock(std::vector<PhaseTime>& phases) : phases_(phases) {}

  void begin(std::string name, Progress& progress);
  /// Whose rays are noted from here on, those of the running phase too.
  void watch(const mesh::Rays& rays) { rays_ = &rays; }
  void end();

 private:
  [[nodiscard]] mesh::Rays::Use used() const { return rays_ != nullptr ? rays_->use() : mesh::Rays::Use{}; }

  std::vector<PhaseTime>& phases_;
  const mesh::Rays* rays_ = nullptr;
  bool running_ = false;
};

}  // namespace clerestory::lighting
