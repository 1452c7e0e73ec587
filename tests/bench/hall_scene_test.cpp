#include <gtest/gtest.h>

#include "renderer/render.h"
#include "tests/bench/bench_scenes.h"
#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

TEST(HallScene, IsTheTexturedHallThatFiguresAreQuotedFor) {
  const BenchScene hall = hallScene(::testing::TempDir());
  const auto scene = loadScene({testing::readFile(hall.file), {}});
  std::filesystem::remove(hall.file);
  ASSERT_TRUE(scene);
  EXPECT_EQ((*scene)->images.size(), 69u);
  for (const auto& image : (*scene)->images) EXPECT_EQ(image->width(), 1024);
  EXPECT_NEAR(static_cast<double>((*scene)->indices.size()) / 3, 270'000, 3'000);
  EXPECT_EQ(hall.path.size(), 20u);
  EXPECT_NE(hall.path.front(), hall.path.back());
}

} // namespace
} // namespace gnomon::bench
