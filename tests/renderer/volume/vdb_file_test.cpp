#include "renderer/volume/vdb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "protocol/base/bytes.h"
#include "tests/renderer/volume/vdb_builder.h"

namespace gnomon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const VdbGrid kDensity{"density", {{{-3, 5, 100}, 1}, {{-2, 5, 101}, 2.5f}, {{-2, 6, 101}, 3}}, 0.25f};

Problem refusal(const std::string& file, const std::string& name = {}) {
  const auto grid = readVdb(asBytes(file), name);
  EXPECT_FALSE(grid);
  return grid ? Problem{} : grid.problems().front();
}

TEST(VdbFile, TheBoxOfActiveVoxelsIsReadWithTheBackgroundBetweenThem) {
  const auto grid = readVdb(asBytes(vdbFile({kDensity})));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->size, glm::ivec3(2, 2, 2));
  EXPECT_THAT(grid->values, ElementsAre(1, 0.25f, 0.25f, 0.25f, 0.25f, 2.5f, 0.25f, 3));
}

TEST(VdbFile, AGridIsChosenByItsNameAmongThoseOfFloats) {
  const std::string file = vdbFile({kDensity, {"heat", {{{0, 0, 0}, 7}}}, {"mass", {{{0, 0, 0}, 8}}, 0, false}});
  const auto heat = readVdb(asBytes(file), "heat");
  ASSERT_TRUE(heat);
  EXPECT_THAT(heat->values, ElementsAre(7));
  for (const char* name : {"", "mass", "Heat"}) {
    const Problem problem = refusal(file, name);
    EXPECT_EQ(problem.code, ProblemCode::invalidValue) << name;
    EXPECT_EQ(problem.limit, "density, heat");
  }
  EXPECT_EQ(refusal(vdbFile({{"mass", {{{0, 0, 0}, 8}}, 0, false}})).limit, "none");
}

TEST(VdbFile, WhatIsTooLargeEmptyOrNotFiniteIsNamed) {
  const Problem wide = refusal(vdbFile({{"wide", {{{0, 0, 0}, 1}, {{99999, 0, 0}, 1}}}}));
  EXPECT_EQ(wide.code, ProblemCode::tooLarge);
  EXPECT_EQ(wide.limit, "1..2048");
  EXPECT_EQ(wide.actual, "100000 x 1 x 1");
  EXPECT_EQ(refusal(vdbFile({{"far", {{{-2147483647, 0, 0}, 1}, {{2147483647, 0, 0}, 1}}}})).code,
            ProblemCode::tooLarge);
  EXPECT_THAT(refusal(vdbFile({{"nothing", {}}})).detail, HasSubstr("no active voxel"));
  const Problem nan =
      refusal(vdbFile({{"nan", {{{0, 0, 0}, 1}, {{1, 0, 0}, std::numeric_limits<float>::quiet_NaN()}}}}));
  EXPECT_THAT(nan.detail, HasSubstr("x 1, y 0, z 0"));
}

TEST(VdbFile, WhateverIsCutOrChangedIsReadOrRefused) {
  const std::string whole = vdbFile({kDensity});
  std::mt19937 random(1);
  const auto mustBeSound = [](const std::string& file) {
    const auto grid = readVdb(asBytes(file), {});
    if (grid) return;
    EXPECT_NE(grid.problems().front().code, ProblemCode::internal);
    EXPECT_FALSE(grid.problems().front().detail.empty());
  };
  for (int i = 0; i < 8; ++i) mustBeSound(whole.substr(0, random() % whole.size()));
  for (int i = 0; i < 24; ++i) {
    std::string changed = whole;
    // Most of what is structure comes first.
    changed[random() % (i < 18 ? 600 : changed.size())] = static_cast<char>(random());
    mustBeSound(changed);
  }
  EXPECT_EQ(refusal("").code, ProblemCode::malformed);
  EXPECT_EQ(refusal("this is no VDB file, but it is longer than its signature").code, ProblemCode::malformed);
}

TEST(VdbFile, AReaderThatIsMissingIsOurOwnMistakeAndNamesNoPath) {
  const auto paths = vdbProgramPaths("/opt/gnomon/bin/gnomon");
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0], "/opt/gnomon/bin/gnomon_vdb");
  EXPECT_EQ(paths[1], "/opt/gnomon/lib/gnomon/gnomon_vdb");
  const auto grid = readVdb({}, {}, vdbAsChild(paths));
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.problems().front().code, ProblemCode::internal);
  EXPECT_THAT(grid.problems().front().detail, testing::Not(HasSubstr("/opt")));
}

TEST(VdbFile, AReaderThatCrashesHangsOrSaysTooLittleIsAProblem) {
  const auto by = [](const char* program, const std::string& argument) {
    const auto grid = readVdb({}, argument, vdbAsChild({program}), std::chrono::milliseconds(300));
    EXPECT_FALSE(grid);
    return grid ? Problem{} : grid.problems().front();
  };
  const Problem late = by("/bin/sleep", "100");
  EXPECT_EQ(late.code, ProblemCode::tooLarge);
  EXPECT_EQ(late.limit, "300 ms");
  EXPECT_EQ(by("/bin/echo", "a few words").code, ProblemCode::malformed);
  EXPECT_EQ(by("/bin/false", "").code, ProblemCode::malformed);
  EXPECT_EQ(by("/proc/self/status", "").code, ProblemCode::internal);
}

} // namespace
} // namespace gnomon
