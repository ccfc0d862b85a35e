// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/sdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "io/model_builder.h"
#include "io/words.h"
#include "io/xml_tree.h"
#include "mesh/affine.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;
using mesh::Affine;

constexpr std::uint64_t kLargestDocument = std::uint64_t{4} << 20;  // bytes; a furnished house has 30 000
constexpr std::size_t kDeepestIncludes = 16;
constexpr std::size_t kMostVisuals = 100000;    // and includes
constexpr std::size_t kMostPolygons = 5000000;  // of any building, and of what the memory of a common machine holds
constexpr std::size_t kLongestPart = 1000;      // characters
constexpr int kFoldersUp = 3;                   // from a world to the folder that has its models, at the most
constexpr std::string_view kModelScheme = "model://";
constexpr std::string_view kFileScheme = "file://";

/// Turns by roll, pitch and yaw about the fixed axes x, y, z, in this order [rad].
Affine turned(double roll, double pitch, double yaw) {
  const double cr = std::cos(roll), sr = std::sin(roll);
  const double cp = std::cos(pitch), sp = std::sin(pitch);
  const double cy = std::cos(yaw), sy = std::sin(yaw);
  return {{cy * cp, sy * cp, -sp},
          {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},
          {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr},
          {}};
}

/// A document, and where it stands.
struct Document {
  fs::path path;
  XmlElement root;
};

class SdfReader {
 public:
  explicit SdfReader(fs::path path) : path_(std::move(path)), builder_(path_.string()) {}

  ModelFile read(const ModelFormat& format);

 private:
  const Document& document(const fs::path& path);
  void add_all(const XmlElement& parent, const Document& from, const Affine& at, const std::string& part);
  void add_model(const XmlElement& model, const Document& from, const Affine& at, const std::string& part);
  void add_include(const XmlElement& include, const Document& from, const Affine& at, const std::string& part);
  void add_link(const XmlElement& link, const Document& from, const Affine& at, const std::string& part);
  void add_visual(const XmlElement& visual, const Document& from, const Affine& at, const std::string& part);
  void count_visual(const XmlElement& visual, const Document& from);
  void add_mesh(const ModelFile& mesh, const fs::path& file, const Affine& at, const std::string& part);
  const ModelFile& mesh_of(const XmlElement& uri, const Document& from);
  std::string material_name(const SourceMaterial& material, const fs::path& file);

  Affine pose_of(const XmlElement& element, const Document& from) const;
  Affine pose(const XmlElement& pose, const Document& from) const;
  template <std::size_t N>
  std::array<double, N> numbers(const XmlElement& element, const Document& from) const;
  std::optional<fs::path> folder_of_model(const std::string& name, const Document& from);
  std::optional<fs::path> place_of(const XmlElement& uri, const Document& from);
  std::vector<std::string> notices() const;
  [[noreturn]] static void fail(const Document& from, const XmlElement& at, const std::string& what,
                                const std::string& hint) {
    throw InputError(from.path.string(), at.line, what, hint);
  }

  fs::path path_;
  ModelBuilder builder_;
  std::map<fs::path, Document> documents_;
  std::map<fs::path, ModelFile> meshes_;
  std::map<std::string, fs::path> material_of_;  ///< name → mesh that told it
  std::vector<SourceMaterial> told_;
  std::vector<fs::path> files_;
  std::vector<std::string> mesh_notices_;
  std::set<std::string> missing_;
  std::set<std::string> renamed_;
  std::size_t depth_ = 0;
  std::size_t visuals_ = 0;
  std::size_t other_shapes_ = 0;
  std::size_t lights_ = 0;
  std::size_t left_out_ = 0;
};

ModelFile SdfReader::read(const ModelFormat& format) {
  const Document& world = document(path_);
  if (world.root.name != "sdf")
    fail(world, world.root, fmt::format("the root is {} and not <sdf>", in_quotes(world.root.name)),
         "give a world or a model in SDF");
  for (const XmlElement& child : world.root.children)
    if (child.name == "world") add_all(child, world, {}, "");
  add_all(world.root, world, {}, "");
  if (builder_.polygon_count() == 0)
    throw InputError(path_.string(), 0,
                     missing_.empty() ? "there is no mesh in this world"
                                      : fmt::format("none of its {} models is there", missing_.size()),
                     "put the folders of the models beside the world, or into a folder `models` beside or over it");
  ModelFile result;
  result.format = "SDF";
  result.files = files_;
  result.notices = notices();
  builder_.finish(result, format, ToldUnit{LengthUnit::kMetre, "as SDF prescribes"});
  attach_materials(std::move(told_), result);
  return result;
}

const Document& SdfReader::document(const fs::path& path) {
  const auto known = documents_.find(path);
  if (known != documents_.end()) return known->second;
  files_.push_back(path);
  return documents_.emplace(path, Document{path, read_xml(path, "model", kLargestDocument)}).first->second;
}

/// All that may stand in a world as in a model.
void SdfReader::add_all(const XmlElement& parent, const Document& from, const Affine& at, const std::string& part) {
  for (const XmlElement& child : parent.children) {
    if (child.name == "model") add_model(child, from, at, part);
    if (child.name == "include") add_include(child, from, at, part);
    if (child.name == "link") add_link(child, from, at, part);
    if (child.name == "light") ++lights_;
  }
}

void SdfReader::add_model(const XmlElement& model, const Document& from, const Affine& at, const std::string& part) {
  const std::string name(model.attribute("name"));
  if (part.size() + name.size() > kLongestPart)
    fail(from, model, fmt::format("the name of this model has over {} characters", kLongestPart), "shorten it");
  add_all(model, from, at * pose_of(model, from), part.empty() ? name : part + "." + name);
}

/// The pose of an include stands in place of that of the model in the file.
void SdfReader::add_include(const XmlElement& include, const Document& from, const Affine& at,
                            const std::string& part) {
  const XmlElement* uri = include.find("uri");
  if (uri == nullptr) fail(from, include, "this <include> has no <uri>", "name the model: model://NAME");
  count_visual(include, from);
  const auto folder = place_of(*uri, from);
  std::error_code ignored;
  if (!folder || !fs::is_regular_file(*folder / "model.sdf", ignored)) {
    ++left_out_;
    missing_.insert(std::string(trim(uri->text)));
    return;
  }
  if (++depth_ > kDeepestIncludes)
    fail(from, include, fmt::format("over {} models include each other", kDeepestIncludes),
         "remove the one that closes the circle");
  const Document& inside = document(*folder / "model.sdf");
  const XmlElement* own_name = include.find("name");
  const XmlElement* own_pose = include.find("pose");
  for (const XmlElement& model : inside.root.children) {
    if (model.name != "model") continue;
    std::string name = own_name != nullptr ? std::string(trim(own_name->text)) : std::string(model.attribute("name"));
    if (!part.empty()) name = part;
    add_all(model, inside, at * (own_pose != nullptr ? pose(*own_pose, from) : pose_of(model, inside)), name);
  }
  --depth_;
}

void SdfReader::add_link(const XmlElement& link, const Document& from, const Affine& at, const std::string& part) {
  const Affine here = at * pose_of(link, from);
  for (const XmlElement& child : link.children) {
    if (child.name == "visual") add_visual(child, from, here, part);
    if (child.name == "light") ++lights_;
  }
}

void SdfReader::count_visual(const XmlElement& visual, const Document& from) {
  if (++visuals_ <= kMostVisuals) return;
  fail(from, visual, fmt::format("the world has over {} visuals and includes", kMostVisuals), "cut it into several");
}

void SdfReader::add_visual(const XmlElement& visual, const Document& from, const Affine& at, const std::string& part) {
  count_visual(visual, from);
  const XmlElement* geometry = visual.find("geometry");
  const XmlElement* mesh = geometry != nullptr ? geometry->find("mesh") : nullptr;
  const XmlElement* uri = mesh != nullptr ? mesh->find("uri") : nullptr;
  if (uri == nullptr) {
    ++other_shapes_;
    return;
  }
  Affine scale;
  if (const XmlElement* factors = mesh->find("scale")) {
    const auto s = numbers<3>(*factors, from);
    scale = {{s[0], 0.0, 0.0}, {0.0, s[1], 0.0}, {0.0, 0.0, s[2]}, {}};
  }
  const Affine here = at * pose_of(visual, from) * scale;
  const ModelFile& read = mesh_of(*uri, from);
  add_mesh(read, read.files.front(), here, part.empty() ? path_.stem().string() : part);
}

const ModelFile& SdfReader::mesh_of(const XmlElement& uri, const Document& from) {
  const auto place = place_of(uri, from);
  std::error_code ignored;
  if (!place || !fs::is_regular_file(*place, ignored))
    fail(from, uri, fmt::format("there is no mesh {}", in_quotes(trim(uri.text))), "put it where the model names it");
  const auto known = meshes_.find(*place);
  if (known != meshes_.end()) return known->second;
  // Of the formats in use COLLADA alone names its unit and axis; the others are in metres with z up.
  ModelFormat format;
  if (lower(place->extension().string()) != ".dae") format = {LengthUnit::kMetre, UpAxis::kZ};
  ModelFile mesh = read_model(*place, format);
  files_.insert(files_.end(), mesh.files.begin(), mesh.files.end());
  for (const std::string& notice : mesh.notices)
    if (!notice.starts_with("The unit of length")) mesh_notices_.push_back(notice);
  return meshes_.emplace(*place, std::move(mesh)).first->second;
}

void SdfReader::add_mesh(const ModelFile& mesh, const fs::path& file, const Affine& at, const std::string& part) {
  const mesh::Model& model = mesh.model;
  if (builder_.polygon_count() + model.polygon_count() > kMostPolygons)
    throw InputError(path_.string(), 0, fmt::format("the world has over {} polygons", kMostPolygons),
                     "cut it into several");
  std::vector<std::uint32_t> vertices;
  vertices.reserve(model.vertices.size());
  for (const mesh::Point& p : model.vertices) vertices.push_back(builder_.vertex(at(p)));
  std::vector<mesh::MaterialId> materials;
  for (const SourceMaterial& material : mesh.materials)
    materials.push_back(builder_.material(material_name(material, file)));
  const mesh::PartId part_id = builder_.part(part);
  std::vector<std::uint32_t> corners;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    for (std::size_t loop = 0; loop < model.loop_count(p); ++loop) {
      corners.clear();
      for (const std::uint32_t corner : model.loop(p, loop)) corners.push_back(vertices[corner]);
      if (at.determinant() < 0.0) std::reverse(corners.begin(), corners.end());
      if (loop > 0) {
        builder_.hole(corners);
      } else {
        builder_.polygon(corners, materials[model.polygon_material[p].index()], part_id);
      }
    }
  }
}

/// Meshes of different files may call different materials alike.
std::string SdfReader::material_name(const SourceMaterial& material, const fs::path& file) {
  for (const std::string& name : {material.name, fmt::format("{} of {}", material.name, file.stem().string())}) {
    const auto [known, fresh] = material_of_.emplace(name, file);
    if (!fresh && known->second != file) continue;
    if (fresh) {
      told_.push_back(material);
      told_.back().name = name;
    }
    return name;
  }
  return material.name;
}

Affine SdfReader::pose_of(const XmlElement& element, const Document& from) const {
  const XmlElement* own = element.find("pose");
  return own != nullptr ? pose(*own, from) : Affine{};
}

Affine SdfReader::pose(const XmlElement& pose, const Document& from) const {
  for (const char* key : {"frame", "relative_to"})
    if (!trim(pose.attribute(key)).empty())
      fail(from, pose, fmt::format("this pose is relative to {}", in_quotes(pose.attribute(key))),
           "give it relative to what it stands in");
  if (trim(pose.text).empty()) return {};
  const auto n = numbers<6>(pose, from);
  const double unit = pose.attribute("degrees") == "true" ? std::numbers::pi / 180.0 : 1.0;
  Affine result = turned(unit * n[3], unit * n[4], unit * n[5]);
  result.origin = {n[0], n[1], n[2]};
  return result;
}

template <std::size_t N>
std::array<double, N> SdfReader::numbers(const XmlElement& element, const Document& from) const {
  std::array<double, N> values{};
  std::string text = element.text;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  const auto words = split_words(text);
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = words.size() == N ? parse_number(words[i]) : std::nullopt;
    if (!value)
      fail(from, element, fmt::format("<{}> is {}, expected {} numbers", element.name, in_quotes(trim(text)), N),
           "correct it");
    values[i] = *value;
  }
  return values;
}

/// Beside the document and over it. Collections are often copied with shorter names of their folders.
std::optional<fs::path> SdfReader::folder_of_model(const std::string& name, const Document& from) {
  std::error_code ignored;
  std::vector<fs::path> roots;
  fs::path folder = from.path.has_parent_path() ? from.path.parent_path() : fs::path(".");
  for (int up = 0; up <= kFoldersUp; ++up, folder = (folder / "..").lexically_normal())
    for (const fs::path& root : {folder, folder / "models"}) roots.push_back(root);
  for (std::string end = name; !end.empty(); end = end.substr(std::min(end.find('_'), end.size() - 1) + 1)) {
    for (const fs::path& root : roots) {
      if (!fs::is_directory(root / end, ignored)) continue;
      if (end != name) renamed_.insert(end);
      return root / end;
    }
  }
  return std::nullopt;
}

/// Where a URI leads; nothing where its model is not there.
std::optional<fs::path> SdfReader::place_of(const XmlElement& uri, const Document& from) {
  const std::string text(trim(uri.text));
  if (text.find("..") != std::string::npos || text.empty())
    fail(from, uri, fmt::format("{} is no place of a model", in_quotes(text)), "write model://NAME");
  if (text.starts_with(kFileScheme)) return from.path.parent_path() / text.substr(kFileScheme.size());
  if (!text.starts_with(kModelScheme)) return from.path.parent_path() / text;
  const std::string path = text.substr(kModelScheme.size());
  const std::size_t slash = std::min(path.find('/'), path.size());
  const auto folder = folder_of_model(path.substr(0, slash), from);
  if (!folder || slash + 1 >= path.size()) return folder;
  return *folder / path.substr(slash + 1);
}

std::vector<std::string> SdfReader::notices() const {
  std::vector<std::string> text;
  if (left_out_ > 0)
    text.push_back(fmt::format("Models that are not there were left out, in {} places: {}.", left_out_,
                               list_names(std::vector<std::string>(missing_.begin(), missing_.end()))));
  if (!renamed_.empty())
    text.push_back(fmt::format("Folders that are named like the end of a model's name were taken for it: {}.",
                               list_names(std::vector<std::string>(renamed_.begin(), renamed_.end()))));
  if (other_shapes_ > 0) text.push_back(fmt::format("Visuals that are no meshes were left out: {}.", other_shapes_));
  if (lights_ > 0) text.push_back(fmt::format("The world's lights have no photometry and were left out: {}.", lights_));
  text.insert(text.end(), mesh_notices_.begin(), mesh_notices_.end());
  return text;
}

}  // namespace

bool is_sdf(std::string_view head) { return head.find("<sdf") != std::string_view::npos; }

ModelFile read_sdf(const fs::path& path, const ModelFormat& format) { return SdfReader(path).read(format); }

}  // namespace clerestory::io
