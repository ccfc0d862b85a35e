// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cleaned_model.h"

#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/summary.h"
#include "io/vtk_files.h"
#include "io/whole_file.h"
#include "io/words.h"
#include "io/write_model.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

namespace fs = std::filesystem;

constexpr double kShareOfTheModel = 0.8;  // of the time of writing

fs::path with_ending(const fs::path& file, const char* ending) {
  fs::path path = file;
  path += ending;
  return path;
}

fs::path json_of(const fs::path& file) { return with_ending(file, ".report.json"); }

/// All files that are written for a model, the model first and the report that lists them last.
std::vector<fs::path> all_files(const fs::path& file) {
  std::vector<fs::path> files = model_files(file);
  for (const char* ending : {".defects.vtp", ".report.txt"}) files.push_back(with_ending(file, ending));
  files.push_back(json_of(file));
  return files;
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() != fs::file_type::not_found;
}

[[noreturn]] void fail(const fs::path& folder, const std::string& reason) {
  throw MachineError(folder.string() + ": nothing can be written there: " + reason + "; choose another place with -o");
}

void expect_nothing_in_the_way(const fs::path& file) {
  if (fs::is_directory(file)) throw InputError(file.string(), 0, "is a folder", "name a file in it with -o");
  const auto earlier = read_earlier_summary(json_of(file));
  const std::vector<std::string> ours = earlier ? earlier->files : std::vector<std::string>();
  for (const fs::path& path : all_files(file)) {
    const bool replaceable =
        path == file || std::find(ours.begin(), ours.end(), path.filename().string()) != ours.end();
    if (!replaceable && is_there(path))
      throw InputError(path.string(), 0, "is not of this program's making and would be overwritten",
                       "move it away, or choose another name with -o");
  }
}

/// A hidden folder beside the place of the files, removed with all that is left in it.
class Staging {
 public:
  explicit Staging(const fs::path& folder) : folder_(folder) {
    std::string name = (folder / ".clerestory-writing-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) fail(folder, std::generic_category().message(errno));
    path_ = name;
  }
  ~Staging() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

  void move_out(const std::vector<fs::path>& files) const {
    for (const fs::path& file : files) {
      std::error_code error;
      fs::rename(path_ / file.filename(), file, error);
      if (error) fail(folder_, error.message());
    }
  }

 private:
  fs::path folder_;
  fs::path path_;
};

void to_model_coordinates(mesh::CleanSurface& surface) {
  for (mesh::Point& p : surface.polygons.vertices) p = p + surface.origin;
}

/// The surface with a polygon for each material: a polygon with another one on its back is followed by that, the other way round.
mesh::Model with_backs(const mesh::CleanSurface& surface) {
  const mesh::Model& clean = surface.polygons;
  mesh::Model model;
  model.vertices = clean.vertices;
  model.material_names = clean.material_names;
  model.part_names = clean.part_names;
  std::vector<std::uint32_t> corners;
  for (std::size_t p = 0; p < clean.polygon_count(); ++p) {
    const auto add = [&](mesh::MaterialId material, bool reversed) {
      model.begin_polygon(material, clean.polygon_part[p], clean.polygon_line[p]);
      for (std::size_t loop = 0; loop < clean.loop_count(p); ++loop) {
        corners.assign(clean.loop(p, loop).begin(), clean.loop(p, loop).end());
        if (reversed) std::reverse(corners.begin(), corners.end());
        model.add_loop(corners);
      }
    };
    const bool flipped = surface.flipped[p] != 0;
    const mesh::MaterialId back = surface.back_material[p];
    add(clean.polygon_material[p], back.valid() && flipped);
    if (back.valid()) add(back, !flipped);
  }
  return model;
}

void write_reports(const fs::path& staged, const ModelReport& report) {
  write_defects_vtp(with_ending(staged, ".defects.vtp"), report.clean);
  write_whole_file(with_ending(staged, ".report.txt"), report_text(report));
  write_whole_file(json_of(staged), report_json_text(report));
}

}  // namespace

void check_cleaned_model(const fs::path& file, const StudyInput& input) {
  const std::vector<fs::path> files = all_files(file);
  const fs::path folder = folder_of(file);
  if (!is_there(folder))
    throw InputError(file.string(), 0, "there is no folder " + in_quotes(folder.string()), "make it first");
  if (!fs::is_directory(folder)) fail(folder, "it is no folder");
  for (const fs::path& read : input.input_files) {
    for (const fs::path& written : files) {
      std::error_code error;
      if (fs::equivalent(read, written, error))
        throw InputError(written.string(), 0, "is read and would be overwritten", "choose another name with -o");
    }
  }
  expect_nothing_in_the_way(file);
  const Staging probe(folder);
}

void write_cleaned_model(const fs::path& file, mesh::CleanSurface surface, ModelReport& report, Progress& progress) {
  progress.phase("writing");
  const Staging staging(folder_of(file));
  const fs::path staged = staging.path() / file.filename();
  to_model_coordinates(surface);
  const std::vector<fs::path> files = all_files(file);
  for (const fs::path& path : files) report.files.push_back(path.filename().string());
  try {
    write_model(staged, {with_backs(surface), report.input.model.materials});
    progress.advance(kShareOfTheModel);
    write_reports(staged, report);
    progress.advance(1.0);
  } catch (const WriteError& error) {
    fail(folder_of(file), error.reason());
  }
  expect_nothing_in_the_way(file);
  staging.move_out(files);
}

}  // namespace clerestory::io
