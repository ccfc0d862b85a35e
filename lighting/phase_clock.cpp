// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/phase_clock.h"

#include <chrono>
#include <ctime>
#include <utility>

namespace clerestory::lighting {

namespace {

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

void PhaseClock::begin(std::string name, Progress& progress) {
  end();
  progress.phase(name);
  const mesh::Rays::Use use = used();
  phases_.push_back({std::move(name), cpu_s(), wall_s(), use.rays, use.seconds});
  running_ = true;
}

void PhaseClock::end() {
  if (!running_) return;
  PhaseTime& phase = phases_.back();
  const mesh::Rays::Use use = used();
  phase.cpu_s = cpu_s() - phase.cpu_s;
  phase.wall_s = wall_s() - phase.wall_s;
  phase.rays = use.rays - phase.rays;
  phase.ray_s = use.seconds - phase.ray_s;
  running_ = false;
}

}  // namespace clerestory::lighting
