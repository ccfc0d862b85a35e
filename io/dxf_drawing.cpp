// SPDX-License-Identifier: GPL-3.0-or-later
// The parser is our own: dxflib hands over neither the faces of polyface meshes nor MESH, turns a number that is none into 0, and
// knows no line numbers.
#include "io/dxf_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <span>

#include "io/dxf_groups.h"
#include "io/shared_vertices.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

// Codes of groups.
constexpr int kName = 2;
constexpr int kLayer = 8;
constexpr int kVariable = 9;
constexpr int kPoint = 10;
constexpr int kInvisible = 60;
constexpr int kColour = 62;
constexpr int kPaperSpace = 67;
constexpr int kFlags = 70;
constexpr int kExtrusion = 210;

// Flags of POLYLINE.
constexpr std::int64_t kClosedInM = 1;
constexpr std::int64_t kPolygonMesh = 16;
constexpr std::int64_t kClosedInN = 32;
constexpr std::int64_t kPolyface = 64;

// Flags of VERTEX.
constexpr std::int64_t kSplinePoint = 8;
constexpr std::int64_t kControlPoint = 16;
constexpr std::int64_t kMeshVertex = 64;
constexpr std::int64_t kPolyfaceVertex = 128;

constexpr std::int64_t kFrozen = 1;

/// A part of a polygon mesh, or of MESH, has at most so many vertices in one direction; the format says 16 bits.
constexpr std::int64_t kMostMeshVertices = 32767;

using Corners = std::vector<std::uint32_t>;

/// Puts faces into the model space or a block; equal points become one.
class ContentWriter {
 public:
  ContentWriter(DxfContent& content, DxfDrawing& drawing) : content_(content), drawing_(drawing) {}

  DxfContent& content() { return content_; }

  std::uint32_t point(const mesh::Point& p) {
    return points_.index(p, [&] {
      content_.points.push_back(p);
      return static_cast<std::uint32_t>(content_.points.size() - 1);
    });
  }

  /// A face whose corners are points; neighbours that are one are merged.
  void face(std::span<const std::uint32_t> corners, std::uint32_t layer, std::uint64_t line) {
    const std::size_t start = content_.corners.size();
    for (const std::uint32_t corner : corners)
      if (content_.corners.size() == start || content_.corners.back() != corner) content_.corners.push_back(corner);
    while (content_.corners.size() > start + 1 && content_.corners.back() == content_.corners[start])
      content_.corners.pop_back();
    if (content_.corners.size() < start + 3) {
      content_.corners.resize(start);
      ++drawing_.faces_without_area;
      return;
    }
    content_.starts.push_back(static_cast<std::uint32_t>(content_.corners.size()));
    content_.layers.push_back(layer);
    content_.lines.push_back(line <= std::numeric_limits<std::uint32_t>::max() ? static_cast<std::uint32_t>(line) : 0);
  }

 private:
  DxfContent& content_;
  DxfDrawing& drawing_;
  SharedVertices points_;
};

/// A face of a polyface mesh.
struct PolyfaceFace {
  std::array<std::int64_t, 4> vertices{};  // from 1; below 0 where the edge behind is not drawn, 0 for none
  std::uint32_t layer = 0;
  std::uint64_t line = 0;
};

/// A POLYLINE and the vertices that follow it.
struct Polyline {
  DxfRecord head;
  std::vector<PolyfaceFace> faces;
  Corners points;
  Corners spline_points;
};

class DrawingReader {
 public:
  explicit DrawingReader(const std::filesystem::path& path) : records_(path) { layer_id("0"); }

  DxfDrawing read();

 private:
  [[nodiscard]] const DxfRecord& record() const { return records_.record(); }
  void next(bool keep_groups = true);
  void read_section();
  void read_header();
  void read_tables();
  void read_blocks();
  void read_entities(ContentWriter& writer);
  void read_entity(ContentWriter& writer);
  void read_face(ContentWriter& writer);
  void read_polyline(ContentWriter& writer);
  void read_vertex(Polyline& polyline, ContentWriter& writer);
  PolyfaceFace polyface_face(const DxfRecord& head);
  void add_polyface(const Polyline& polyline, ContentWriter& writer);
  void add_polygon_mesh(const Polyline& polyline, ContentWriter& writer);
  void read_mesh(ContentWriter& writer);
  void read_insert(DxfContent& content);
  std::uint32_t layer_id(const std::string& name);
  std::uint32_t layer_of(const DxfRecord& record);

  DxfRecords records_;
  DxfDrawing drawing_;
  std::unordered_map<std::string, std::uint32_t> layers_;  // by name in lower case
};

DxfDrawing DrawingReader::read() {
  ContentWriter model_space(drawing_.model_space, drawing_);
  next();
  while (record().type != "EOF") {
    if (record().type != "SECTION")
      record().fail(record().line, fmt::format("{} stands where a section should begin", in_quotes(record().type)),
                    "export it again");
    const std::string name = record().text(kName);
    if (name == "HEADER") {
      read_header();
    } else if (name == "TABLES") {
      read_tables();
    } else if (name == "BLOCKS") {
      read_blocks();
    } else if (name == "ENTITIES") {
      next();
      read_entities(model_space);
    }
    while (record().type != "ENDSEC") {
      if (record().type == "EOF") record().fail(record().line, "a section does not end", "was the file cut off?");
      next(false);
    }
    next();
  }
  return std::move(drawing_);
}

void DrawingReader::next(bool keep_groups) {
  if (!records_.next(keep_groups)) record().fail(records_.line(), "the file ends without EOF", "was it cut off?");
}

/// All variables stand in the groups of the record SECTION itself.
void DrawingReader::read_header() {
  const std::vector<DxfGroup>& groups = record().groups;
  for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
    if (groups[i].code != kVariable || groups[i].text != "$INSUNITS" || groups[i + 1].code != kFlags) continue;
    drawing_.unit_code = record().whole(groups[i + 1]);
    drawing_.unit_line = groups[i + 1].line;
  }
}

void DrawingReader::read_tables() {
  while (record().type != "ENDSEC" && record().type != "EOF") {
    if (record().type == "LAYER" && record().find(kName) != nullptr) {
      DxfLayer& layer = drawing_.layers[layer_id(record().text(kName))];
      layer.frozen = (record().whole(kFlags, 0) & kFrozen) != 0;
      layer.off = record().whole(kColour, 0) < 0;
    }
    next();
  }
}

void DrawingReader::read_blocks() {
  next();
  while (record().type == "BLOCK") {
    const std::string name = record().text(kName);
    DxfContent& block = drawing_.blocks[lower(name)];
    block = DxfContent{};
    block.name = name;
    if (record().find(kPoint) != nullptr) block.base = record().point(kPoint);
    ContentWriter writer(block, drawing_);
    next();
    read_entities(writer);
    if (record().type == "ENDBLK") next();
  }
}

/// Up to the end of the section or block.
void DrawingReader::read_entities(ContentWriter& writer) {
  while (record().type != "ENDSEC" && record().type != "ENDBLK" && record().type != "EOF" && record().type != "BLOCK") {
    if (record().whole(kPaperSpace, 0) != 0 || record().whole(kInvisible, 0) == 1) {
      ++drawing_.left_out[record().whole(kInvisible, 0) == 1 ? "invisible entities" : "entities of the paper space"];
      next();
    } else {
      read_entity(writer);
    }
  }
}

void DrawingReader::read_entity(ContentWriter& writer) {
  const std::string& type = record().type;
  if (type == "POLYLINE") return read_polyline(writer);
  if (type == "3DFACE") {
    read_face(writer);
  } else if (type == "MESH") {
    read_mesh(writer);
  } else if (type == "INSERT") {
    read_insert(writer.content());
  } else if (type != "VERTEX" && type != "SEQEND" && type != "ATTRIB" && type != "ATTDEF") {
    ++drawing_.left_out[printable(type)];
  }
  next();
}

void DrawingReader::read_face(ContentWriter& writer) {
  constexpr int kFourthCorner = 13;
  Corners corners;
  for (int code = kPoint; code <= kFourthCorner; ++code)
    if (code < kFourthCorner || record().find(code) != nullptr) corners.push_back(writer.point(record().point(code)));
  writer.face(corners, layer_of(record()), record().line);
}

void DrawingReader::read_polyline(ContentWriter& writer) {
  Polyline polyline;
  polyline.head = record();
  const std::int64_t flags = record().whole(kFlags, 0);
  const bool is_surface = (flags & (kPolygonMesh | kPolyface)) != 0;
  next();
  while (record().type == "VERTEX") {
    if (is_surface) read_vertex(polyline, writer);
    next();
  }
  if (record().type == "SEQEND") next();
  if ((flags & kPolyface) != 0) {
    add_polyface(polyline, writer);
  } else if (is_surface) {
    add_polygon_mesh(polyline, writer);
  } else {
    ++drawing_.left_out["POLYLINE"];
  }
}

void DrawingReader::read_vertex(Polyline& polyline, ContentWriter& writer) {
  const std::int64_t flags = record().whole(kFlags, 0);
  const bool is_face = (flags & kPolyfaceVertex) != 0 && (flags & kMeshVertex) == 0;
  if (is_face) {
    polyline.faces.push_back(polyface_face(polyline.head));
  } else if ((flags & kSplinePoint) != 0) {
    polyline.spline_points.push_back(writer.point(record().point(kPoint)));
  } else {
    polyline.points.push_back(writer.point(record().point(kPoint)));
  }
}

PolyfaceFace DrawingReader::polyface_face(const DxfRecord& head) {
  constexpr int kFirstCorner = 71;
  PolyfaceFace face;
  for (std::size_t i = 0; i < face.vertices.size(); ++i)
    face.vertices[i] = record().whole(kFirstCorner + static_cast<int>(i), 0);
  face.layer = layer_of(record().find(kLayer) != nullptr ? record() : head);
  face.line = record().line;
  return face;
}

void DrawingReader::add_polyface(const Polyline& polyline, ContentWriter& writer) {
  Corners corners;
  for (const PolyfaceFace& face : polyline.faces) {
    corners.clear();
    for (const std::int64_t number : face.vertices) {
      if (number == 0) continue;
      const auto count = static_cast<std::int64_t>(polyline.points.size());
      if (number > count || number < -count)
        polyline.head.fail(face.line, fmt::format("vertex {} does not exist: the polyface mesh has {}", number, count),
                           "export it again");
      corners.push_back(polyline.points[static_cast<std::size_t>(std::abs(number) - 1)]);
    }
    writer.face(corners, face.layer, face.line);
  }
}

void DrawingReader::add_polygon_mesh(const Polyline& polyline, ContentWriter& writer) {
  const DxfRecord& head = polyline.head;
  const bool smooth = !polyline.spline_points.empty();
  const Corners& points = smooth ? polyline.spline_points : polyline.points;
  const std::int64_t m = head.whole(smooth ? 73 : 71, 0);
  const std::int64_t n = head.whole(smooth ? 74 : 72, 0);
  const bool possible = m >= 2 && n >= 2 && m <= kMostMeshVertices && n <= kMostMeshVertices;
  if (!possible || static_cast<std::size_t>(m * n) != points.size())
    head.fail(head.line, fmt::format("this polygon mesh promises {} x {} vertices and has {}", m, n, points.size()),
              "export it again; was the file cut off?");
  const std::int64_t flags = head.whole(kFlags, 0);
  const std::int64_t m_cells = (flags & kClosedInM) != 0 ? m : m - 1;
  const std::int64_t n_cells = (flags & kClosedInN) != 0 ? n : n - 1;
  const std::uint32_t layer = layer_of(head);
  const auto at = [&](std::int64_t i, std::int64_t j) { return points[static_cast<std::size_t>((i % m) * n + j % n)]; };
  for (std::int64_t i = 0; i < m_cells; ++i)
    for (std::int64_t j = 0; j < n_cells; ++j)
      writer.face(std::array{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, layer, head.line);
}

/// The lists of a MESH: 92 vertices (10, 20, 30), 93 numbers (90) that are a count of corners and the corners, for each face.
void DrawingReader::read_mesh(ContentWriter& writer) {
  constexpr int kLevel = 91;
  constexpr int kFaceList = 93;
  constexpr int kEdgeList = 94;
  constexpr int kListItem = 90;
  Corners points;
  std::vector<const DxfGroup*> items;
  bool in_faces = false;
  const std::vector<DxfGroup>& groups = record().groups;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const DxfGroup& group = groups[i];
    if (group.code == kFaceList) in_faces = true;
    if (group.code == kEdgeList) in_faces = false;
    if (group.code == kListItem && in_faces) items.push_back(&group);
    if (group.code != kPoint) continue;
    if (i + 2 >= groups.size() || groups[i + 1].code != kPoint + 10 || groups[i + 2].code != kPoint + 20)
      record().fail(group.line, "a vertex of this MESH has no y or no z", "export it again");
    points.push_back(
        writer.point({record().number(group), record().number(groups[i + 1]), record().number(groups[i + 2])}));
  }

  Corners corners;
  const std::uint32_t layer = layer_of(record());
  for (std::size_t at = 0; at < items.size();) {
    const std::int64_t count = record().whole(*items[at]);
    const std::uint64_t line = items[at]->line;
    if (count < 0 || static_cast<std::uint64_t>(count) > items.size() - at - 1)
      record().fail(line,
                    fmt::format("a face of this MESH promises {} corners and has {}", count, items.size() - at - 1),
                    "export it again");
    corners.clear();
    for (++at; corners.size() < static_cast<std::size_t>(count); ++at) {
      const std::int64_t vertex = record().whole(*items[at]);
      if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= points.size())
        record().fail(items[at]->line,
                      fmt::format("vertex {} does not exist: the MESH has {}, counted from 0", vertex, points.size()),
                      "export it again");
      corners.push_back(points[static_cast<std::size_t>(vertex)]);
    }
    writer.face(corners, layer, line);
  }
  if (record().whole(kLevel, 0) > 0) ++drawing_.smooth_meshes;
}

void DrawingReader::read_insert(DxfContent& content) {
  constexpr std::int64_t kMostRepeats = 32767;  // the format says 16 bits
  const DxfRecord& r = record();
  DxfInsert insert;
  insert.block = lower(r.text(kName));
  insert.layer = layer_of(r);
  insert.at = r.point(kPoint);
  insert.scale = {r.number(41, 1.0), r.number(42, 1.0), r.number(43, 1.0)};
  insert.rotation_deg = r.number(50, 0.0);
  insert.columns = std::clamp<std::int64_t>(r.whole(kFlags, 1), 1, kMostRepeats);
  insert.rows = std::clamp<std::int64_t>(r.whole(71, 1), 1, kMostRepeats);
  insert.column_spacing = r.number(44, 0.0);
  insert.row_spacing = r.number(45, 0.0);
  if (r.find(kExtrusion) != nullptr) {
    const mesh::Point tip = r.point(kExtrusion);
    insert.extrusion = {tip.x, tip.y, tip.z};
  }
  insert.line = r.line;
  content.inserts.push_back(std::move(insert));
}

std::uint32_t DrawingReader::layer_id(const std::string& name) {
  const auto [at, is_new] = layers_.emplace(lower(name), static_cast<std::uint32_t>(drawing_.layers.size()));
  if (is_new) drawing_.layers.push_back({name, false, false});
  return at->second;
}

std::uint32_t DrawingReader::layer_of(const DxfRecord& record) {
  const std::string name = record.text(kLayer);
  return layer_id(name.empty() ? "0" : name);
}

}  // namespace

DxfDrawing read_dxf_drawing(const std::filesystem::path& path) {
  if (read_head(path, 22).starts_with("AutoCAD Binary DXF"))
    throw InputError(path.string(), 0, "this DXF is binary", "save it as a text (ASCII) DXF");
  return DrawingReader(path).read();
}

}  // namespace clerestory::io
