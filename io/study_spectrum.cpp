// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "io/study_tables.h"

namespace clerestory::io {

namespace {

constexpr std::size_t kMostBands = 400;  // visible light by nanometres
constexpr const char* kWeightsAre = "give each band's share of V(λ), in any unit";

}  // namespace

void read_spectrum_table(const StudyValue& root, lighting::Study& study) {
  const StudyValue* table = root.find("spectrum");
  const StudyValue* weights = table != nullptr ? table->find("weights") : nullptr;
  if (weights == nullptr) return;
  double sum = 0.0;
  for (const StudyValue& weight : weights->children) {
    if (!weight.is_number() || !(weight.number >= 0.0))
      throw weights->error("a weight is no number from 0", kWeightsAre);
    sum += weight.number;
  }
  if (!(sum > 0.0)) throw weights->error("all weights are zero", kWeightsAre);
  if (weights->children.size() > kMostBands)
    throw weights->error(fmt::format("there are {} bands", weights->children.size()),
                         fmt::format("give at most {}", kMostBands));
  for (const StudyValue& weight : weights->children)
    study.band_weights.push_back(static_cast<float>(weight.number / sum));
}

}  // namespace clerestory::io
