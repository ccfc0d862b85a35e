// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include "io/map_layout.h"
#include "io/map_scale.h"
#include "mesh/error.h"
#include "tests/io/sample_results.h"

namespace clerestory::io {
namespace {

/// A picture as a viewer decodes it.
class Picture {
 public:
  explicit Picture(const std::filesystem::path& file) {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    image_ = reader->GetOutput();
  }
  [[nodiscard]] int width() const { return image_->GetDimensions()[0]; }
  [[nodiscard]] int height() const { return image_->GetDimensions()[1]; }
  [[nodiscard]] Rgb at(double x, double y) const {
    const auto* p = static_cast<unsigned char*>(
        image_->GetScalarPointer(static_cast<int>(x), height() - 1 - static_cast<int>(y), 0));
    return {p[0], p[1], p[2]};
  }
  [[nodiscard]] int count(Rgb colour) const {
    int n = 0;
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) n += at(x, y) == colour ? 1 : 0;
    }
    return n;
  }

 private:
  vtkSmartPointer<vtkImageData> image_;
};

class Map : public testing::Test {
 protected:
  Map() { std::filesystem::create_directories(folder_); }
  ~Map() override { std::filesystem::remove_all(folder_); }

  Picture draw(const lighting::GridResult& grid) {
    write_map_png(folder_ / "map.png", grid, test::make_results(grid), context_);
    return Picture(folder_ / "map.png");
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                  (std::string("map_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  ResultContext context_ = test::daylight_context();
};

int difference(Rgb a, Rgb b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

constexpr Rgb kPaper{255, 255, 255};

TEST_F(Map, HasTheSizeThatItsLayoutSays) {
  const auto grid = test::office_grid();
  const MapLayout layout = layout_map(lay_flat(grid.sensors, 0.0));
  const Picture picture = draw(grid);
  EXPECT_EQ(picture.width(), layout.width);
  EXPECT_EQ(picture.height(), layout.height);
  EXPECT_LE(picture.width(), 1400);
  EXPECT_EQ(picture.at(2, 2), kPaper);
}

TEST_F(Map, ShowsEachSensorInTheColourThatTheLegendGivesItsValue) {
  const auto grid = test::office_grid();
  const MapPlan plan = lay_flat(grid.sensors, 0.0);
  const MapLayout layout = layout_map(plan);
  const MapScale scale = choose_scale(grid.daylight_factor_percent, MapQuantity::kDaylightFactor);
  const Picture picture = draw(grid);
  int alike = 0;
  for (std::size_t i = 0; i < grid.sensors.count(); ++i) {
    const Pixel at = layout.pixel(plan.positions[i]);
    const double position = scale.position(static_cast<double>(grid.daylight_factor_percent[i]));
    const double row = std::floor(layout.legend.bottom() - position * layout.legend.height);
    const Rgb legend =
        picture.at(layout.legend.x + 0.5 * layout.legend.width, std::max(layout.legend.y + 2.0, row - 0.5));
    alike += difference(picture.at(at.x, at.y), legend) < 12 ? 1 : 0;
  }
  EXPECT_GT(alike, 560);  // of 768; the others lie under lines, labels and printed values
}

TEST_F(Map, ColoursOnlyWhereThereAreSensors) {
  const auto grid = test::make_grid({.columns = 20, .rows = 28, .margin_m = 0.5}, test::office_daylight_factor);
  const MapLayout layout = layout_map(lay_flat(grid.sensors, 0.0));
  const Picture picture = draw(grid);
  const double edge = 0.25 * layout.pixels_per_metre;
  const Rgb in_margin = picture.at(layout.map.x + edge, layout.map.y + edge);
  EXPECT_EQ(in_margin.r, in_margin.g);  // grey
  EXPECT_NE(in_margin, kPaper);
  EXPECT_EQ(picture.at(layout.map.x - 8.0, layout.map.y + edge), kPaper);
}

TEST_F(Map, DrawsAnIsolineWhereARampHasItsValue) {
  const auto grid = test::make_grid({}, [](double x, double) { return 0.2 + 2.0 * x; });
  const MapPlan plan = lay_flat(grid.sensors, 0.0);
  const MapLayout layout = layout_map(plan);
  const MapScale scale = choose_scale(grid.daylight_factor_percent, MapQuantity::kDaylightFactor);
  ASSERT_EQ(scale.isolines, (std::vector<double>{0.5, 1, 2, 3, 5, 10}));
  const Picture picture = draw(grid);
  for (const double level : scale.isolines) {
    const Pixel at = layout.pixel({0.5 * (level - 0.2), -0.03});  // near the upper wall, clear of labels
    EXPECT_LT(lightness(picture.at(at.x, at.y + 6.0)), 0.35) << level;
  }
}

TEST_F(Map, DrawsTheNoSkyLineAndItsName) {
  auto grid = test::office_grid();
  const Picture without = draw(grid);
  const double z = grid.sensors.positions[0].z;
  grid.no_sky = {{{{0.5, 4.0, z}, {5.5, 4.0, z}}}};
  const MapPlan plan = lay_flat(grid.sensors, 0.0, grid.no_sky);
  const MapLayout layout = layout_map(plan);
  const Picture with = draw(grid);
  constexpr Rgb kSkyLine{16, 52, 140};
  const Pixel from = layout.pixel(plan.no_sky[0][0]);
  const Pixel to = layout.pixel(plan.no_sky[0][1]);
  int on_line = 0;
  for (double x = from.x + 2.0; x < to.x - 2.0; x += 1.0) {
    on_line += difference(with.at(x, from.y), kSkyLine) < 12 ? 1 : 0;
  }
  EXPECT_GT(on_line, 0.9 * (to.x - from.x - 4.0));
  // The letters stand beside the line.
  EXPECT_GT(with.count(kSkyLine), without.count(kSkyLine) + on_line + 60);
}

TEST_F(Map, CopesWithGridsOfEveryKind) {
  const auto one = test::make_grid({.columns = 1, .rows = 1}, [](double, double) { return 1.2; });
  auto dot = one;
  dot.sensors.cells.clear();
  dot.sensors.outlines.clear();
  auto dots = test::office_grid();
  dots.sensors.cells.clear();
  auto rooms = test::office_grid();
  test::append(rooms, test::make_grid({.corner = {9, 3, 0.8}, .right = {0.8, 0.6, 0}, .up = {-0.6, 0.8, 0}},
                                      test::office_daylight_factor));
  test::append(rooms, test::make_grid({.corner = {0, 0, 4.0}}, test::office_daylight_factor));
  const auto dark = test::make_grid({}, [](double, double) { return 0.0; });
  const auto slit = test::make_grid({.columns = 2000, .rows = 1}, test::office_daylight_factor);
  const auto wall =
      test::make_grid({.corner = {6, 0, 0}, .right = {-1, 0, 0}, .up = {0, 0, 1}}, test::office_daylight_factor);
  for (const lighting::GridResult* grid :
       std::initializer_list<const lighting::GridResult*>{&one, &dot, &dots, &rooms, &dark, &slit, &wall}) {
    const Picture picture = draw(*grid);
    EXPECT_GE(picture.width(), 1000);
    EXPECT_GE(picture.height(), 500);
    EXPECT_LE(picture.height(), 1800);
  }
}

TEST_F(Map, OfZerosIsInTheDarkestColour) {
  const Picture picture = draw(test::make_grid({}, [](double, double) { return 0.0; }));
  EXPECT_GT(picture.count(map_colour(0.0)), 500'000);
}

TEST_F(Map, HasNoJointsBetweenCellsWithoutOutlines) {
  auto grid = test::make_grid({}, [](double, double) { return 0.0; });
  grid.sensors.outlines.clear();
  const auto map = layout_map(lay_flat(grid.sensors, 0.0)).map;
  const Picture picture = draw(grid);
  int other = 0;
  for (int x = static_cast<int>(map.x + 0.2 * map.width); x < map.x + 0.8 * map.width; ++x) {
    const auto at = picture.at(x, map.y + 0.5 * map.height);
    other += at == map_colour(0.0) || lightness(at) > 0.5 ? 0 : 1;  // light: a printed value
  }
  EXPECT_LT(other, 30);  // the soft edges of printed values
}

TEST_F(Map, OfAnIlluminanceStudyShowsLux) {
  auto grid = test::office_grid();
  const Picture factor = draw(grid);
  grid.daylight_factor_percent.clear();
  const Picture lux = draw(grid);
  const auto map = layout_map(lay_flat(grid.sensors, 0.0)).map;
  int different = 0;
  for (int x = static_cast<int>(map.x); x < map.right(); ++x) {
    different += factor.at(x, map.y + 0.8 * map.height) == lux.at(x, map.y + 0.8 * map.height) ? 0 : 1;
  }
  EXPECT_GT(different, 100);
}

TEST_F(Map, HasTheSameBytesEachTime) {
  const auto grid = test::office_grid();
  const auto bytes = [&] {
    draw(grid);
    std::ifstream in(folder_ / "map.png", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST_F(Map, OfNoSensorsIsAnErrorThatNamesTheGrid) {
  lighting::GridResult grid;
  grid.name = "desks";
  try {
    draw(grid);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("'desks'"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map.png"));
}

TEST_F(Map, ThatCannotBeWrittenIsAnErrorThatNamesIt) {
  const auto grid = test::office_grid();
  EXPECT_THROW(write_map_png(folder_ / "missing" / "map.png", grid, test::make_results(grid), context_), MachineError);
}

}  // namespace
}  // namespace clerestory::io
