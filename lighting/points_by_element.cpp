// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/points_by_element.h"

#include <algorithm>

namespace clerestory::lighting {

namespace {

constexpr std::size_t kMostOfGroup = 64;

}  // namespace

PointsByElement::PointsByElement(std::span<const mesh::ElementId> elements) {
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    if (elements[i].valid()) points_.push_back(i);
  }
  std::stable_sort(points_.begin(), points_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return elements[a] < elements[b]; });
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const mesh::ElementId element = elements[points_[i]];
    const bool goes_on = !elements_.empty() && elements_.back() == element && i - starts_.back() < kMostOfGroup;
    if (!goes_on && i > 0) starts_.push_back(i);
    if (!goes_on) elements_.push_back(element);
  }
  if (!points_.empty()) starts_.push_back(points_.size());
}

}  // namespace clerestory::lighting
