// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace clerestory::lighting {

/// Places darker than this share of a grid's mean need not be better than one of that illuminance [docs/theory/accuracy.md].
inline constexpr double kDarkShare = 0.05;

}  // namespace clerestory::lighting
