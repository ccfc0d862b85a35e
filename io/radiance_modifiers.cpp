// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_modifiers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "io/model_builder.h"
#include "io/radiance_materials.h"
#include "io/words.h"

namespace clerestory::io {

namespace {

constexpr std::string_view kVoid = "void";
constexpr std::size_t kMostMeanings = 1000;  // of one name that copies of files bring again and again

bool is_left_out(std::string_view type) { return type == "antimatter" || type == "mist"; }

/// Words of a primitive that name modifiers.
std::vector<std::string> target_words(const RadiancePrimitive& primitive) {
  const std::vector<std::string>& words = primitive.strings;
  std::size_t count = 0;
  if (primitive.kind == RadianceKind::kMixture) count = 2;
  if (primitive.kind == RadianceKind::kAlias || primitive.type == "illum") count = 1;
  return {words.begin(), words.begin() + static_cast<std::ptrdiff_t>(std::min(count, words.size()))};
}

void add_list(std::vector<std::string>& notices, std::string_view what, const std::vector<std::string>& names) {
  if (!names.empty()) notices.push_back(fmt::format("{}: {}.", what, list_names(names)));
}

}  // namespace

std::optional<std::size_t> RadianceModifiers::latest(const std::string& name) const {
  const auto at = by_identifier_.find(name);
  return at == by_identifier_.end() ? std::nullopt : std::optional(at->second.back());
}

std::string RadianceModifiers::free_name(const std::string& name, const std::string& file, std::size_t others) const {
  if (!names_.contains(name)) return name;
  const std::string stem = std::filesystem::path(file).stem().string();
  std::string other = fmt::format("{} ({})", name, stem);
  for (std::size_t i = others + 1; names_.contains(other); ++i) other = fmt::format("{} ({} {})", name, stem, i);
  return other;
}

std::vector<std::size_t> RadianceModifiers::targets_of(const RadiancePrimitive& primitive) const {
  std::vector<std::size_t> targets;
  for (const std::string& word : target_words(primitive))
    if (const auto target = latest(word)) targets.push_back(*target);
  return targets;
}

void RadianceModifiers::define(const RadiancePrimitive& primitive, const std::string& file) {
  const std::optional<std::size_t> modifier = latest(primitive.modifier);
  std::vector<std::size_t> targets = targets_of(primitive);
  for (const std::string& word : target_words(primitive))
    if (word != kVoid && !latest(word)) undefined_.insert(word);
  std::vector<std::size_t>& same = by_identifier_[primitive.identifier];
  const auto is_equal = [&](std::size_t i) {
    const Definition& other = definitions_[i];
    return other.primitive.type == primitive.type && other.primitive.strings == primitive.strings &&
           other.primitive.reals == primitive.reals && other.modifier == modifier && other.targets == targets;
  };
  const auto recent = same.end() - static_cast<std::ptrdiff_t>(std::min(same.size(), kMostMeanings));
  const auto known = std::find_if(recent, same.end(), is_equal);
  if (known != same.end()) {
    std::rotate(known, known + 1, same.end());
    return;
  }
  const bool is_behind = primitive.kind == RadianceKind::kPattern || primitive.kind == RadianceKind::kTexture;
  const std::string name = is_behind ? primitive.identifier : free_name(primitive.identifier, file, same.size());
  if (!is_behind) names_.insert(name);
  same.push_back(definitions_.size());
  Definition definition{primitive, file, name, modifier, std::move(targets), {}};
  definition.meaning = meaning_of(definition, definitions_.size());
  definitions_.push_back(std::move(definition));
}

/// Definitions refer to earlier ones only, whose meanings are known.
RadianceModifiers::Meaning RadianceModifiers::meaning_of(const Definition& definition, std::size_t index) const {
  const RadianceKind kind = definition.primitive.kind;
  const bool is_material = kind == RadianceKind::kMaterial && definition.targets.empty();
  const bool is_behind = kind == RadianceKind::kPattern || kind == RadianceKind::kTexture;
  std::optional<std::size_t> next = definition.modifier;
  if (!is_material && !is_behind)
    next = definition.targets.empty() ? std::nullopt : std::optional(definition.targets[0]);
  Meaning meaning = next ? definitions_[*next].meaning : Meaning{};
  if (!is_behind || meaning.name.empty()) meaning.name = definition.name;
  meaning.patterned |= kind == RadianceKind::kPattern;
  meaning.pictured |= definition.primitive.type == "colorpict";
  meaning.mixed |= kind == RadianceKind::kMixture;
  meaning.behind_illum |= kind == RadianceKind::kMaterial && !is_material;
  if (is_material) {
    // Of what lies in front of a material only patterns count.
    meaning.material = index;
    meaning.mixed = meaning.behind_illum = false;
  }
  return meaning;
}

std::optional<std::string> RadianceModifiers::material_for(const std::string& modifier) {
  if (modifier == kVoid) return kUnnamed;
  const auto definition = latest(modifier);
  if (!definition) {
    undefined_.insert(modifier);
    return modifier;
  }
  const Meaning& meaning = definitions_[*definition].meaning;
  if (meaning.material && is_left_out(definitions_[*meaning.material].primitive.type)) return std::nullopt;
  Meaning& used = used_.try_emplace(meaning.name, meaning).first->second;
  used.patterned |= meaning.patterned;
  used.pictured |= meaning.pictured;
  return meaning.name;
}

SourceMaterial RadianceModifiers::tell(const Meaning& meaning) const {
  SourceMaterial told;
  if (meaning.material) {
    const Definition& material = definitions_[*meaning.material];
    told = tell_radiance_material(material.primitive).value_or(SourceMaterial{});
    told.file = material.file;
    told.line = material.primitive.line;
    if (meaning.name != material.primitive.identifier && !told.told_by.empty())
      told.told_by += " " + in_quotes(material.primitive.identifier);
  }
  told.name = meaning.name;
  told.textured = meaning.pictured;
  if (meaning.patterned && told.luminance_cd_m2) {
    told.luminance_cd_m2.reset();
    told.shines = true;
  }
  return told;
}

std::vector<SourceMaterial> RadianceModifiers::told() const {
  std::vector<SourceMaterial> result;
  for (const auto& [name, meaning] : used_) result.push_back(tell(meaning));
  for (std::size_t i = 0; i < definitions_.size(); ++i) {
    const RadianceKind kind = definitions_[i].primitive.kind;
    if (kind == RadianceKind::kPattern || kind == RadianceKind::kTexture) continue;
    const Meaning& meaning = definitions_[i].meaning;
    if (!used_.contains(meaning.name)) result.push_back(tell(meaning));
  }
  return result;
}

std::vector<std::string> RadianceModifiers::undefined() const {
  std::vector<std::string> names;
  for (const std::string& name : undefined_)
    if (!latest(name)) names.push_back(name);
  return names;
}

std::vector<std::string> RadianceModifiers::notices() const {
  std::vector<std::string> patterned;
  std::vector<std::string> mixed;
  std::vector<std::string> behind_illum;
  std::vector<std::string> thickness;
  std::vector<std::string> open;
  for (const auto& [name, meaning] : used_) {
    if (meaning.patterned) patterned.push_back(name);
    if (meaning.mixed) mixed.push_back(name);
    if (meaning.behind_illum) behind_illum.push_back(name);
    if (!meaning.material) continue;
    const RadiancePrimitive& material = definitions_[*meaning.material].primitive;
    const auto told = tell_radiance_material(material);
    if (!told || !told->photometric) open.push_back(fmt::format("{} ({})", name, material.type));
    if (material.type == "dielectric" || material.type == "interface") thickness.push_back(name);
  }
  std::vector<std::string> result;
  add_list(result,
           "No file of the scene defines these materials; include their file with !cat in front of the surfaces, or "
           "give them in the study",
           undefined());
  add_list(result, "Patterns are not read, and what lies behind them counts", patterned);
  add_list(result, "A mixture counts as its first part", mixed);
  add_list(result, "An illum repeats the light of what lies behind it, and counts as that", behind_illum);
  add_list(result, "Dielectrics count as clear panes that absorb nothing", thickness);
  add_list(result, "These types of material are not read, or miss numbers, and say nothing", open);
  return result;
}

}  // namespace clerestory::io
