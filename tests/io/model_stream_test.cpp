// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/io/sample_model.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;

ModelAnswer sample_answer() {
  ModelAnswer answer;
  answer.model = test::sample_model_file();
  return answer;
}

TEST(ModelStream, EveryFieldComesBack) {
  const ModelAnswer sent = sample_answer();
  const auto back = unpack(pack(sent));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(pack(*back), pack(sent));
  const ModelFile& file = back->model;
  EXPECT_EQ(file.format, "IFC4");
  EXPECT_EQ(file.model.vertices, sent.model.model.vertices);
  EXPECT_EQ(file.model.loop_count(1), 2U);
  EXPECT_THAT(file.model.part_names, ElementsAre("slab", "wall"));
  ASSERT_EQ(file.materials.size(), 2U);
  EXPECT_THAT(*file.materials[0].diffuse, ElementsAre(0.1, 0.2, 0.3));
  EXPECT_EQ(file.materials[0].line, 7U);
  EXPECT_EQ(file.materials[1].transmittance_normal, 0.6);
  EXPECT_FALSE(file.materials[1].diffuse.has_value());
  EXPECT_TRUE(file.materials[1].shines);
  ASSERT_EQ(file.spaces.size(), 1U);
  EXPECT_EQ(file.spaces[0].floor_area_m2, 12.5);
  EXPECT_FALSE(file.spaces[0].volume_m3.has_value());
  EXPECT_EQ(file.site.latitude_deg, 48.1);
  EXPECT_EQ(file.unit, LengthUnit::kFoot);
  EXPECT_EQ(file.up, UpAxis::kY);
  EXPECT_THAT(file.files, ElementsAre("house.ifc", "wall \xc3\xa4.bin"));
}

TEST(ModelStream, AnErrorComesBackWithItsPlace) {
  ModelAnswer sent;
  sent.kind = ModelAnswer::Kind::kInputError;
  sent.file = "a.ifc";
  sent.line = 12;
  sent.problem = "no wall";
  sent.hint = "draw one";
  const auto back = unpack(pack(sent));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->kind, ModelAnswer::Kind::kInputError);
  EXPECT_EQ(back->file, "a.ifc");
  EXPECT_EQ(back->line, 12U);
  EXPECT_EQ(back->problem, "no wall");
  EXPECT_EQ(back->hint, "draw one");
}

TEST(ModelStream, BytesThatAreCutOffOrTooManyAreNoAnswer) {
  const std::string bytes = pack(sample_answer());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(unpack(bytes.substr(0, size)).has_value()) << size;
  EXPECT_FALSE(unpack(bytes + '\0').has_value());
}

TEST(ModelStream, AModelThatContradictsItselfIsNoAnswer) {
  const auto damaged = [](auto&& damage) {
    ModelAnswer answer = sample_answer();
    damage(answer.model);
    return !unpack(pack(answer)).has_value();
  };
  EXPECT_FALSE(damaged([](ModelFile&) {}));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.corners[0] = 99; }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.loop_starts[1] = 99; }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.loop_starts.clear(); }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.polygon_starts[1] = 3; }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.polygon_material[0] = mesh::MaterialId(2U); }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.polygon_part[0] = {}; }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.polygon_line.pop_back(); }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.model.vertices[0].x = std::nan(""); }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.materials.pop_back(); }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.spaces[0].boundary.corners[0] = 99; }));
  EXPECT_TRUE(damaged([](ModelFile& f) { f.unit = static_cast<LengthUnit>(77); }));
}

TEST(ModelStream, RandomDamageIsSeenOrHarmless) {
  const std::string bytes = pack(sample_answer());
  std::mt19937 random(1);
  for (int run = 0; run < 20'000; ++run) {
    std::string damaged = bytes;
    for (std::size_t hits = 1 + random() % 3; hits > 0; --hits)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    const auto answer = unpack(damaged);
    if (!answer) continue;
    for (const std::uint32_t corner : answer->model.model.corners)
      ASSERT_LT(corner, answer->model.model.vertices.size());
  }
}

TEST(ModelStream, ACountBeyondTheBytesTakesNoMemory) {
  std::string bytes = pack({});
  const std::uint64_t huge = std::numeric_limits<std::uint64_t>::max() / 2;
  bytes.replace(1, sizeof huge, reinterpret_cast<const char*>(&huge), sizeof huge);  // the length of the format's name
  EXPECT_FALSE(unpack(bytes).has_value());
}

}  // namespace
}  // namespace clerestory::io
