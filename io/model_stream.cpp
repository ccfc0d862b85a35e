// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_stream.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstring>
#include <functional>
#include <type_traits>

namespace clerestory::io {

namespace {

/// What goes as its bytes, since any bytes make one: not bool, not an enumeration.
template <class T>
concept Plain = (std::is_arithmetic_v<T> && !std::same_as<T, bool>) || std::same_as<T, mesh::Point> ||
                std::same_as<T, mesh::MaterialId> || std::same_as<T, mesh::PartId> || std::same_as<T, mesh::Affine> ||
                std::same_as<T, std::array<double, 3>>;

template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

// The fields of each struct, for writing and reading alike, in this order. A field that is added to a struct makes its binding here
// a compile error, so that none can be forgotten.

template <Is<mesh::Model> T, class Each>
void each_field(T& model, const Each& each) {
  // None of the formats that are read in another process has subdivision tags, and curvature comes later.
  [[maybe_unused]] auto& [vertices, corners, loop_starts, polygon_starts, polygon_material, polygon_part, polygon_line,
                          material_names, part_names, tags, curvature] = model;
  each(vertices, corners, loop_starts, polygon_starts, polygon_material, polygon_part, polygon_line, material_names,
       part_names);
}

template <Is<SourceMaterial> T, class Each>
void each_field(T& material, const Each& each) {
  auto& [name, file, line, told_by, photometric, diffuse, specular, opacity, transmittance_normal, translucent,
         luminance, gamma_removed, textured, shines] = material;
  each(name, file, line, told_by, photometric, diffuse, specular, opacity, transmittance_normal, translucent, luminance,
       gamma_removed, textured, shines);
}

template <Is<ModelSpace> T, class Each>
void each_field(T& space, const Each& each) {
  auto& [name, boundary, floor_area, volume] = space;
  each(name, boundary, floor_area, volume);
}

template <Is<ModelFixture> T, class Each>
void each_field(T& fixture, const Each& each) {
  auto& [type, name, placement] = fixture;
  each(type, name, placement);
}

template <Is<ModelSite> T, class Each>
void each_field(T& site, const Each& each) {
  auto& [latitude, longitude, north] = site;
  each(latitude, longitude, north);
}

template <Is<ModelFile> T, class Each>
void each_field(T& file, const Each& each) {
  auto& [format, model, materials, unused_materials, spaces, fixtures, site, unit, unit_source, up, notices, files] =
      file;
  each(format, model, materials, unused_materials, spaces, fixtures, site, unit, unit_source, up, notices, files);
}

template <Is<ModelAnswer> T, class Each>
void each_field(T& answer, const Each& each) {
  auto& [kind, model, file, line, problem, hint] = answer;
  each(kind, model, file, line, problem, hint);
}

class Writer {
 public:
  std::string take() { return std::move(bytes_); }

  template <Plain T>
  void put(const T& value) {
    append(&value, sizeof value);
  }
  void put(bool value) { bytes_.push_back(value ? '\1' : '\0'); }
  template <class T>
  requires std::is_enum_v<T>
  void put(T value) { bytes_.push_back(static_cast<char>(value)); }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    bytes_ += text;
  }
  void put(const std::filesystem::path& path) { put(path.native()); }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(std::uint64_t{values.size()});
    if constexpr (Plain<T>) {
      append(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <class T>
  requires(std::is_class_v<T> && !Plain<T>) void put(const T& value) {
    each_field(value, [this](const auto&... fields) { (put(fields), ...); });
  }

 private:
  void append(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

/// The opposite of Writer; every get() is false where the bytes end too early or mean nothing.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  template <Plain T>
  bool get(T& value) {
    return take(&value, sizeof value);
  }
  bool get(bool& value) {
    std::uint8_t byte = 0;
    if (!get(byte) || byte > 1) return false;
    value = byte == 1;
    return true;
  }
  bool get(LengthUnit& unit) { return get_enum(unit, LengthUnit::kFoot); }
  bool get(UpAxis& up) { return get_enum(up, UpAxis::kY); }
  bool get(ModelAnswer::Kind& kind) { return get_enum(kind, ModelAnswer::Kind::kFailure); }
  bool get(std::string& text) {
    std::uint64_t size = 0;
    if (!get(size) || size > rest_.size()) return false;
    text = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }
  bool get(std::filesystem::path& path) {
    std::string text;
    if (!get(text)) return false;
    path = std::move(text);
    return true;
  }
  template <class T>
  bool get(std::optional<T>& value) {
    bool given = false;
    if (!get(given)) return false;
    return !given || get(value.emplace());
  }
  template <class T>
  bool get(std::vector<T>& values) {
    values.clear();
    std::uint64_t count = 0;
    if (!get(count) || count > rest_.size()) return false;
    if constexpr (Plain<T>) {
      if (count > rest_.size() / sizeof(T)) return false;
      values.resize(count);
      return take(values.data(), count * sizeof(T));
    } else {
      for (; count > 0; --count)
        if (!get(values.emplace_back())) return false;  // grows only as the bytes really give elements
      return true;
    }
  }
  template <class T>
  requires(std::is_class_v<T> && !Plain<T>) bool get(T& value) {
    bool whole = true;
    each_field(value, [&](auto&... fields) { whole = (get(fields) && ...); });
    return whole;
  }

 private:
  template <class T>
  bool get_enum(T& value, T last) {
    std::uint8_t byte = 0;
    if (!get(byte) || byte > static_cast<std::uint8_t>(last)) return false;
    value = static_cast<T>(byte);
    return true;
  }
  bool take(void* data, std::size_t size) {
    if (size > rest_.size()) return false;
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
    return true;
  }

  std::string_view rest_;
};

/// Whether the starts begin with 0, always rise and end with the total.
bool are_starts(const std::vector<std::uint32_t>& starts, std::size_t total) {
  return !starts.empty() && starts.front() == 0 && starts.back() == total &&
         std::adjacent_find(starts.begin(), starts.end(), std::greater_equal<>()) == starts.end();
}

template <class Id>
bool all_below(const std::vector<Id>& ids, std::size_t count) {
  return std::all_of(ids.begin(), ids.end(), [=](Id id) { return id.index() < count; });
}

bool has_sound_polygons(const mesh::Model& model) {
  if (!are_starts(model.loop_starts, model.corners.size())) return false;
  if (!are_starts(model.polygon_starts, model.loop_starts.size() - 1)) return false;
  const std::size_t polygons = model.polygon_count();
  return model.polygon_material.size() == polygons && model.polygon_part.size() == polygons &&
         model.polygon_line.size() == polygons &&
         std::all_of(model.corners.begin(), model.corners.end(),
                     [&](std::uint32_t corner) { return corner < model.vertices.size(); }) &&
         std::all_of(model.vertices.begin(), model.vertices.end(), [](const mesh::Point& p) {
           return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
         });
}

bool is_finite(const mesh::Affine& map) {
  const mesh::Vector sum = map.x + map.y + map.z + (map.origin - mesh::Point{});
  return std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z);
}

bool is_consistent(const ModelFile& file) {
  const mesh::Model& model = file.model;
  return has_sound_polygons(model) && all_below(model.polygon_material, model.material_names.size()) &&
         all_below(model.polygon_part, model.part_names.size()) &&
         file.materials.size() == model.material_names.size() &&
         std::all_of(file.spaces.begin(), file.spaces.end(),
                     [](const ModelSpace& space) { return has_sound_polygons(space.boundary); }) &&
         std::all_of(file.fixtures.begin(), file.fixtures.end(),
                     [](const ModelFixture& fixture) { return is_finite(fixture.placement); });
}

}  // namespace

std::string pack(const ModelAnswer& answer) {
  Writer writer;
  writer.put(answer);
  return writer.take();
}

std::optional<ModelAnswer> unpack(std::string_view bytes) {
  Reader reader(bytes);
  ModelAnswer answer;
  if (!reader.get(answer) || !reader.at_end() || !is_consistent(answer.model)) return std::nullopt;
  return answer;
}

}  // namespace clerestory::io
