// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/model_builder.h"
#include "io/radiance_modifiers.h"
#include "io/radiance_scene.h"
#include "io/radiance_shapes.h"
#include "io/radiance_xform.h"
#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDeepestIncludes = 64;
constexpr std::size_t kLongestPart = 1000;         // characters: each of the most copies has a name of its own
constexpr std::size_t kMostPolygons = 5000000;     // of any building, and of what the memory of a common machine holds
constexpr std::size_t kMostStatements = 10000000;  // copies of files included
constexpr std::uint64_t kLargestArguments = std::uint64_t{1} << 20;  // bytes

/// How a file is included.
struct Place {
  RadianceTransform transform;
  bool inverted = false;
  std::optional<std::string> modifier;  ///< in place of that of its surfaces
  std::string part;                     ///< of its surfaces; empty in the first file
};

class SceneReader {
 public:
  explicit SceneReader(const fs::path& path) : path_(path), builder_(path.string()) {}

  ModelFile read(const ModelFormat& format);

 private:
  const RadianceFile& file(const fs::path& path);
  const RadianceFile& included(const std::string& name, const RadianceFile& from, std::uint64_t line);
  void add_file(const RadianceFile& file, const Place& place);
  void add_command(const RadianceFile& file, const RadianceStatement& statement, const Place& place);
  void add_copy(const RadianceFile& from, std::uint64_t line, const RadianceCopy& copy, const Place& place);
  void add_primitive(const RadianceFile& file, const RadiancePrimitive& primitive, const Place& place);
  void add_surface(const RadianceFile& file, const RadiancePrimitive& primitive, const Place& place);
  void add_shape(Shape& shape, const RadiancePrimitive& primitive, const Place& place, const std::string& material);
  fs::path find(const std::string& name, const RadianceFile& from, std::uint64_t line) const;
  std::vector<std::string> argument_lines(const std::string& name, const RadianceFile& from, std::uint64_t line);
  std::string part_of(const RadiancePrimitive& primitive, const Place& place) const;

  fs::path path_;
  ModelBuilder builder_;
  RadianceModifiers modifiers_;
  RadianceNotices notices_;
  std::map<fs::path, RadianceFile> files_;  // by canonical path
  /// By the including file and the name in it: arrays ask for the same one very often.
  std::map<std::pair<const RadianceFile*, std::string>, const RadianceFile*> included_;
  std::vector<fs::path> files_read_;       // in order
  std::vector<const RadianceFile*> open_;  // the first file, one that it includes, …
  std::size_t copies_ = 0;
  std::size_t statements_ = 0;
};

ModelFile SceneReader::read(const ModelFormat& format) {
  add_file(file(path_), {});
  ModelFile result;
  result.files = files_read_;
  result.notices = notices_.sentences();
  for (std::string& notice : modifiers_.notices()) result.notices.push_back(std::move(notice));
  builder_.finish(result, format, std::nullopt);
  attach_materials(modifiers_.told(), result);
  return result;
}

const RadianceFile& SceneReader::file(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  const auto known = files_.find(canonical);
  if (known != files_.end()) return known->second;
  RadianceFile read = read_radiance_file(path, notices_);
  files_read_.push_back(path);
  return files_.emplace(canonical, std::move(read)).first->second;
}

const RadianceFile& SceneReader::included(const std::string& name, const RadianceFile& from, std::uint64_t line) {
  const RadianceFile*& known = included_[{&from, name}];
  if (known == nullptr) known = &file(find(name, from, line));
  return *known;
}

void SceneReader::add_file(const RadianceFile& file, const Place& place) {
  open_.push_back(&file);
  statements_ += file.statements.size();
  if (statements_ > kMostStatements)
    throw InputError(file.name, 0, fmt::format("the scene has over {} primitives", kMostStatements),
                     "make its arrays smaller");
  for (const RadianceStatement& statement : file.statements) {
    if (statement.command) {
      add_command(file, statement, place);
    } else {
      add_primitive(file, statement.primitive, place);
    }
  }
  open_.pop_back();
}

void SceneReader::add_command(const RadianceFile& file, const RadianceStatement& statement, const Place& place) {
  const RadianceInclude include =
      parse_radiance_command(*statement.command, {file.name, statement.line},
                             [&](const std::string& name) { return argument_lines(name, file, statement.line); });
  if (include.makes_sky)
    notices_.add("Commands that make a sky were left out, since the study gives the sky", "!" + *statement.command,
                 file.name, statement.line);
  for (const RadianceCopy& copy : include.copies) add_copy(file, statement.line, copy, place);
}

void SceneReader::add_copy(const RadianceFile& from, std::uint64_t line, const RadianceCopy& copy, const Place& place) {
  for (const std::string& name : copy.files) {
    const RadianceFile& inside = included(name, from, line);
    if (std::find(open_.begin(), open_.end(), &inside) != open_.end())
      throw InputError(from.name, line, fmt::format("the scene {} includes itself", in_quotes(name)),
                       "remove one of the commands that close the circle");
    if (open_.size() >= kDeepestIncludes)
      throw InputError(from.name, line, fmt::format("over {} files include each other", kDeepestIncludes),
                       "make the scene flatter");
    if (++copies_ > kMostRadianceCopies)
      throw InputError(from.name, line, fmt::format("the scene includes over {} files", kMostRadianceCopies),
                       "make the arrays smaller");
    Place inner;
    inner.transform = copy.transform.then(place.transform);
    inner.inverted = place.inverted != copy.inverted;
    inner.modifier = place.modifier ? place.modifier : copy.modifier;
    const std::string own = copy.name.empty() ? inside.path.stem().string() + copy.numbers : copy.name;
    inner.part = place.part.empty() ? own : place.part + "." + own;
    if (inner.part.size() > kLongestPart)
      throw InputError(from.name, line, fmt::format("the name of this copy has over {} characters", kLongestPart),
                       "give shorter names by -n");
    add_file(inside, inner);
  }
}

fs::path SceneReader::find(const std::string& name, const RadianceFile& from, std::uint64_t line) const {
  std::error_code error;
  for (const fs::path& folder : {from.path.parent_path(), path_.parent_path()})
    if (fs::exists(folder / name, error)) return folder / name;
  throw InputError(from.name, line, fmt::format("there is no file {}", in_quotes(name)),
                   "paths are relative to the file that includes, or to the first file; RAYPATH is not searched");
}

std::vector<std::string> SceneReader::argument_lines(const std::string& name, const RadianceFile& from,
                                                     std::uint64_t line) {
  const fs::path path = find(name, from, line);
  if (std::find(files_read_.begin(), files_read_.end(), path) == files_read_.end()) files_read_.push_back(path);
  const std::string text = read_text_file(path, "file of arguments", kLargestArguments);
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

void SceneReader::add_primitive(const RadianceFile& file, const RadiancePrimitive& primitive, const Place& place) {
  switch (primitive.kind) {
    case RadianceKind::kSurface:
      return add_surface(file, primitive, place);
    case RadianceKind::kInstance:
      return notices_.add("Instances of octrees and meshes were left out", primitive.identifier, file.name,
                          primitive.line);
    case RadianceKind::kSource:
      return notices_.add("Distant sources were left out, since the study gives sun and sky", primitive.identifier,
                          file.name, primitive.line);
    default:
      return modifiers_.define(primitive, file.name);
  }
}

void SceneReader::add_surface(const RadianceFile& file, const RadiancePrimitive& primitive, const Place& place) {
  const auto material = modifiers_.material_for(place.modifier.value_or(primitive.modifier));
  if (!material)
    return notices_.add("Surfaces of antimatter and mist were left out", primitive.identifier, file.name,
                        primitive.line);
  Shape shape = radiance_shape(primitive, place.transform.scale);
  if (shape.polygons.empty())
    return notices_.add("Primitives whose numbers make no surface were left out", primitive.identifier, file.name,
                        primitive.line);
  if (builder_.polygon_count() + shape.polygons.size() > kMostPolygons)
    throw InputError(file.name, primitive.line, fmt::format("the scene has over {} polygons", kMostPolygons),
                     "make its arrays smaller");
  add_shape(shape, primitive, place, *material);
}

void SceneReader::add_shape(Shape& shape, const RadiancePrimitive& primitive, const Place& place,
                            const std::string& material) {
  const std::uint64_t line = open_.size() == 1 ? primitive.line : 0;
  std::vector<std::uint32_t> vertices;
  for (const mesh::Point& p : shape.points) vertices.push_back(builder_.vertex(place.transform(p), line));
  const bool reversed = (place.transform.scale < 0.0) != place.inverted;
  const auto corners = [&](std::vector<std::uint32_t>& loop) {
    for (std::uint32_t& corner : loop) corner = vertices[corner];
    if (reversed) std::reverse(loop.begin(), loop.end());
    return std::span<const std::uint32_t>(loop);
  };
  const mesh::MaterialId material_id = builder_.material(material);
  const mesh::PartId part = builder_.part(part_of(primitive, place));
  for (ShapePolygon& polygon : shape.polygons) {
    builder_.polygon(corners(polygon.outer), material_id, part, line);
    if (!polygon.hole.empty()) builder_.hole(corners(polygon.hole));
  }
}

std::string SceneReader::part_of(const RadiancePrimitive& primitive, const Place& place) const {
  if (!place.part.empty()) return place.part;
  const std::size_t dot = primitive.identifier.rfind('.');
  if (dot == std::string::npos || dot == 0) return path_.stem().string();
  return primitive.identifier.substr(0, dot);
}

}  // namespace

ModelFile read_radiance(const fs::path& path, const ModelFormat& format) { return SceneReader(path).read(format); }

}  // namespace clerestory::io
