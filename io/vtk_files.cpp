// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <unordered_map>

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "io/csv.h"
#include "io/whole_file.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// Corners of cells that are closer than this are one point [m].
constexpr double kSamePoint = 1e-6;

template <class Array, class Values>
vtkNew<Array> numbers(const char* name, const Values& values) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  vtkIdType i = 0;
  for (const auto value : values) array->SetValue(i++, value);
  return array;
}

vtkNew<vtkStringArray> words(const char* name, const std::vector<std::string>& values) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& value : values) array->InsertNextValue(value);
  return array;
}

vtkNew<vtkFloatArray> vectors(const char* name, const std::vector<mesh::Vector>& values) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  vtkIdType i = 0;
  for (const mesh::Vector& v : values) array->SetTuple3(i++, v.x, v.y, v.z);
  return array;
}

/// Gives each place one point of the mesh, however often it is asked for.
class PointPool {
 public:
  explicit PointPool(vtkPoints* points) : points_(points) { points_->SetDataTypeToDouble(); }

  vtkIdType add(const mesh::Point& p) {
    const Key key{std::llround(p.x / kSamePoint), std::llround(p.y / kSamePoint), std::llround(p.z / kSamePoint)};
    const auto [entry, is_new] = ids_.try_emplace(key, points_->GetNumberOfPoints());
    if (is_new) points_->InsertNextPoint(p.x, p.y, p.z);
    return entry->second;
  }

 private:
  using Key = std::array<long long, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (const long long k : key) {
        h = (h ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15ULL;  // Fibonacci hashing: spreads runs of integers
        h ^= h >> 32;
      }
      return static_cast<std::size_t>(h);
    }
  };

  vtkPoints* points_;
  std::unordered_map<Key, vtkIdType, Hash> ids_;
};

/// The numbers of the sensors, as in the table of the grid.
std::vector<std::uint32_t> ids_of(const lighting::Sensors& sensors) {
  if (!sensors.ids.empty()) return sensors.ids;
  std::vector<std::uint32_t> ids(sensors.count());
  std::iota(ids.begin(), ids.end(), 0U);
  return ids;
}

void add_sensor_cells(vtkPolyData* data, const lighting::Sensors& sensors) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  if (sensors.cells.empty()) {
    points->SetDataTypeToDouble();
    for (const mesh::Point& p : sensors.positions) {
      const vtkIdType id = points->InsertNextPoint(p.x, p.y, p.z);
      cells->InsertNextCell(1, &id);
    }
    data->SetVerts(cells);
  } else {
    PointPool pool(points);
    for (const auto& corners : sensors.cells) {
      cells->InsertNextCell(4);
      for (const mesh::Point& corner : corners) cells->InsertCellPoint(pool.add(corner));
    }
    data->SetPolys(cells);
  }
  data->SetPoints(points);
}

void add_triangles(vtkPolyData* data, const std::vector<mesh::Point>& corners_of_all,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(corners_of_all.size()));
  vtkIdType i = 0;
  for (const mesh::Point& p : corners_of_all) points->SetPoint(i++, p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (const auto& corners : triangles) {
    cells->InsertNextCell(3);
    for (const std::uint32_t corner : corners) cells->InsertCellPoint(static_cast<vtkIdType>(corner));
  }
  data->SetPoints(points);
  data->SetPolys(cells);
}

/// @param when  behind the names of the arrays
template <class Light>
void add_surface_light(vtkPolyData* data, const Light& light, const std::string& when) {
  const auto add = [&](vtkDataSetAttributes* to, const char* name, const std::vector<float>& values) {
    to->AddArray(numbers<vtkFloatArray>((name + when).c_str(), values));
  };
  vtkCellData* const cells = data->GetCellData();
  add(cells, "illuminance_lux", light.illuminance_lux);
  add(cells, "error_lux", light.error_lux);
  add(cells, "radiosity_lm_m2", light.radiosity_lm_m2);
  add(cells, "luminance_cd_m2", light.luminance_cd_m2);
  if (cells->GetScalars() == nullptr) cells->SetActiveScalars(("illuminance_lux" + when).c_str());
  add(data->GetPointData(), "illuminance_lux", light.point_illuminance_lux);
}

void add_surface_values(vtkPolyData* data, const lighting::SurfaceResult& surfaces) {
  vtkCellData* const cells = data->GetCellData();
  if (surfaces.moments.empty()) add_surface_light(data, surfaces, "");
  for (const lighting::SurfaceLight& light : surfaces.moments) add_surface_light(data, light, "_" + light.moment);
  cells->AddArray(numbers<vtkFloatArray>("reflectance", surfaces.reflectance));
  cells->AddArray(numbers<vtkUnsignedCharArray>("side", surfaces.side));
  cells->AddArray(numbers<vtkIntArray>("level", surfaces.level));
  cells->AddArray(numbers<vtkIntArray>("part", surfaces.part));
  cells->AddArray(numbers<vtkIntArray>("material", surfaces.material));
  cells->AddArray(numbers<vtkIntArray>("room", surfaces.room));
  data->GetPointData()->SetNormals(vectors("normal", surfaces.point_normals));
}

void add_study(vtkPolyData* data, const std::vector<std::string>& units, const ResultContext& context) {
  vtkFieldData* const field = data->GetFieldData();
  field->AddArray(words("units", units));
  field->AddArray(words("sky", {context.sky}));
  field->AddArray(words("study", {context.study_name}));
  field->AddArray(words("version", {context.version}));
}

void add_origin(vtkPolyData* data, const std::vector<std::string>& units, const lighting::Results& results,
                const ResultContext& context) {
  add_study(data, units, context);
  data->GetFieldData()->AddArray(
      numbers<vtkDoubleArray>("horizontal_illuminance_lux", std::array{results.horizontal_illuminance_lux}));
}

template <class Id>
std::vector<int> indices_of(const std::vector<Id>& ids) {
  std::vector<int> indices;
  for (const Id id : ids) indices.push_back(static_cast<int>(id.index()));
  return indices;
}

/// Keeps what VTK complains of, which it would print on stderr otherwise.
void keep_message(vtkObject*, unsigned long, void* message, void* text) {
  if (text != nullptr) static_cast<std::string*>(message)->append(static_cast<const char*>(text));
}

/// The file's bytes. They are made in memory so that one place alone writes files and checks for a full disk: VTK's own
/// stream does not report every error, and deletes the file's name, whatever that is, where the disk is full.
std::string vtp_bytes(vtkPolyData* data) {
  std::string message;
  vtkNew<vtkCallbackCommand> on_error;
  on_error->SetCallback(keep_message);
  on_error->SetClientData(&message);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, on_error);
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();  // 32 bits would end at 4 GB an array
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError || !message.empty()) {
    throw MachineError("VTK cannot write its file: " +
                       (message.empty() ? vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()) : message));
  }
  return writer->GetOutputString();
}

std::string xml_attribute(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      default:
        escaped += c;
    }
  }
  return '"' + escaped + '"';
}

}  // namespace

void write_grid_vtp(const std::filesystem::path& file, const lighting::Results& results,
                    std::span<const lighting::GridResult> moments, const ResultContext& context) {
  const lighting::GridResult& grid = moments.front();
  vtkNew<vtkPolyData> data;
  add_sensor_cells(data, grid.sensors);
  std::vector<std::string> units{"illuminance_lux: lx", "error_lux: lx, standard uncertainty (k = 1)"};
  vtkCellData* const cells = data->GetCellData();
  cells->AddArray(numbers<vtkUnsignedIntArray>("id", ids_of(grid.sensors)));
  cells->AddArray(vectors("normal", grid.sensors.normals));
  const std::vector<LightColumn> columns = light_columns(moments);
  for (const LightColumn& column : columns) cells->AddArray(numbers<vtkFloatArray>(column.name.c_str(), column.values));
  cells->SetActiveScalars(columns.front().name.c_str());
  if (!grid.daylight_factor_percent.empty()) {
    cells->SetActiveScalars("daylight_factor_percent");
    units.emplace_back("daylight_factor_percent: % of the unobstructed horizontal illuminance");
  }
  add_origin(data, units, results, context);
  data->GetFieldData()->AddArray(words("grid", {grid.name}));
  write_whole_file(file, vtp_bytes(data));
}

void write_surfaces_vtp(const std::filesystem::path& file, const lighting::Results& results,
                        const ResultContext& context) {
  vtkNew<vtkPolyData> data;
  add_triangles(data, results.surfaces.points, results.surfaces.cells);
  add_surface_values(data, results.surfaces);
  add_origin(data,
             {"illuminance_lux: lx", "error_lux: lx, standard uncertainty (k = 1)", "radiosity_lm_m2: lm/m²",
              "luminance_cd_m2: cd/m²", "reflectance: 1"},
             results, context);
  data->GetFieldData()->AddArray(words("part_names", results.surfaces.part_names));
  data->GetFieldData()->AddArray(words("material_names", results.surfaces.material_names));
  data->GetFieldData()->AddArray(words("room_names", results.surfaces.room_names));
  write_whole_file(file, vtp_bytes(data));
}

void write_elements_vtp(const std::filesystem::path& file, const lighting::ElementMesh& elements,
                        const ResultContext& context) {
  vtkNew<vtkPolyData> data;
  add_triangles(data, elements.points, elements.cells);
  vtkCellData* const cells = data->GetCellData();
  cells->AddArray(numbers<vtkUnsignedCharArray>("side", elements.side));
  cells->AddArray(numbers<vtkIntArray>("level", elements.level));
  cells->AddArray(numbers<vtkFloatArray>("size_m", elements.size_m));
  cells->AddArray(numbers<vtkFloatArray>("min_angle_deg", elements.min_angle_deg));
  cells->AddArray(numbers<vtkIntArray>("face", elements.face));
  cells->AddArray(numbers<vtkIntArray>("region", elements.region));
  cells->AddArray(numbers<vtkIntArray>("patch", elements.patch));
  cells->AddArray(numbers<vtkUnsignedCharArray>("shade", elements.shade));
  cells->AddArray(numbers<vtkIntArray>("part", elements.part));
  cells->AddArray(numbers<vtkIntArray>("material", elements.material));
  add_study(data, {"size_m: m", "min_angle_deg: degrees"}, context);
  data->GetFieldData()->AddArray(words("part_names", elements.part_names));
  data->GetFieldData()->AddArray(words("material_names", elements.material_names));
  write_whole_file(file, vtp_bytes(data));
}

void write_discontinuities_vtp(const std::filesystem::path& file, const lighting::ElementLines& lines,
                               const ResultContext& context) {
  vtkNew<vtkPoints> points;
  PointPool pool(points);
  vtkNew<vtkCellArray> cells;
  for (const auto& ends : lines.ends) {
    cells->InsertNextCell(2);
    for (const mesh::Point& p : ends) cells->InsertCellPoint(pool.add(p));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkCellData* const values = data->GetCellData();
  values->AddArray(numbers<vtkUnsignedCharArray>("order", lines.order));
  values->AddArray(numbers<vtkUnsignedCharArray>("no_sky", lines.no_sky));
  values->AddArray(numbers<vtkUnsignedCharArray>("side", lines.side));
  values->AddArray(numbers<vtkIntArray>("source", lines.source));
  values->AddArray(numbers<vtkIntArray>("occluder", lines.occluder));
  values->AddArray(numbers<vtkIntArray>("part", lines.part));
  add_study(data, {"metres, z up"}, context);
  data->GetFieldData()->AddArray(words("source_names", lines.source_names));
  data->GetFieldData()->AddArray(words("part_names", lines.part_names));
  write_whole_file(file, vtp_bytes(data));
}

void write_model_vtp(const std::filesystem::path& file, const mesh::Model& model) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const mesh::Point& p : model.vertices) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (std::size_t polygon = 0; polygon < model.polygon_count(); ++polygon) {
    const auto loop = model.loop(polygon);
    cells->InsertNextCell(static_cast<int>(loop.size()));
    for (const std::uint32_t corner : loop) cells->InsertCellPoint(static_cast<vtkIdType>(corner));
  }
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetCellData()->AddArray(numbers<vtkIntArray>("part", indices_of(model.polygon_part)));
  data->GetCellData()->AddArray(numbers<vtkIntArray>("material", indices_of(model.polygon_material)));
  data->GetFieldData()->AddArray(words("part_names", model.part_names));
  data->GetFieldData()->AddArray(words("material_names", model.material_names));
  data->GetFieldData()->AddArray(words("units", {"metres, z up"}));
  write_whole_file(file, vtp_bytes(data));
}

void write_leaks_vtp(const std::filesystem::path& file, const lighting::Results& results,
                     const ResultContext& context) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  std::vector<int> room;
  std::vector<float> area;
  std::vector<std::string> names;
  for (std::size_t r = 0; r < results.rooms.size(); ++r) {
    names.push_back(results.rooms[r].name);
    for (const mesh::RoomOpening& o : results.rooms[r].openings) {
      if (!o.is_leak()) continue;
      const vtkIdType id = points->InsertNextPoint(o.at.x, o.at.y, o.at.z);
      cells->InsertNextCell(1, &id);
      room.push_back(static_cast<int>(r));
      area.push_back(static_cast<float>(o.area_m2));
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  data->GetCellData()->AddArray(numbers<vtkIntArray>("room", room));
  data->GetCellData()->AddArray(numbers<vtkFloatArray>("area_m2", area));
  add_origin(data, {"area_m2: m²"}, results, context);
  data->GetFieldData()->AddArray(words("room_names", names));
  write_whole_file(file, vtp_bytes(data));
}

void write_defects_vtp(const std::filesystem::path& file, const mesh::CleanReport& report) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  std::vector<int> kind;
  std::vector<unsigned char> mended;
  std::vector<unsigned int> polygon;
  std::vector<double> size;
  std::vector<std::string> notes;
  std::vector<std::string> kinds;
  for (const mesh::Defect& defect : report.defects) {
    for (const mesh::Defect::Place& place : defect.places) {
      const vtkIdType id = points->InsertNextPoint(place.at.x, place.at.y, place.at.z);
      cells->InsertNextCell(1, &id);
      kind.push_back(static_cast<int>(kinds.size()));
      mended.push_back(place.mended ? 1 : 0);
      polygon.push_back(place.polygon);
      size.push_back(place.size_m);
      notes.push_back(place.note);
    }
    kinds.push_back(defect.kind);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  data->GetCellData()->AddArray(numbers<vtkIntArray>("kind", kind));
  data->GetCellData()->AddArray(numbers<vtkUnsignedCharArray>("mended", mended));
  data->GetCellData()->AddArray(numbers<vtkUnsignedIntArray>("polygon", polygon));
  data->GetCellData()->AddArray(numbers<vtkDoubleArray>("size_m", size));
  data->GetCellData()->AddArray(words("note", notes));
  data->GetFieldData()->AddArray(words("kind_names", kinds));
  write_whole_file(file, vtp_bytes(data));
}

bool has_leaks(const lighting::Results& results) {
  return std::ranges::any_of(results.rooms, [](const mesh::Room& room) { return !room.closed(); });
}

void write_result_vtm(const std::filesystem::path& file, const std::vector<VtmEntry>& entries) {
  // By hand: VTK's own writer would write the blocks a second time, into a folder of its choice.
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n"
      "  <vtkMultiBlockDataSet>\n";
  for (std::size_t i = 0; i < entries.size(); ++i) {
    text += "    <DataSet index=\"" + std::to_string(i) + "\" name=" + xml_attribute(entries[i].block) +
            " file=" + xml_attribute(entries[i].file) + "/>\n";
  }
  text += "  </vtkMultiBlockDataSet>\n</VTKFile>\n";
  write_whole_file(file, text);
}

}  // namespace clerestory::io
