#include "server/scenes/light_map_directory.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

class LightMapDirectoryTest : public ::testing::Test {
 protected:
  LightMapDirectoryTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gnomon-maps-XXXXXX").string();
    path_ = std::string(::mkdtemp(pattern.data())) + "/maps";
  }
  ~LightMapDirectoryTest() override { std::filesystem::remove_all(std::filesystem::path(path_).parent_path()); }

  std::shared_ptr<LightMapDirectory> open(std::size_t budgetBytes) const {
    return std::make_shared<LightMapDirectory>(path_, budgetBytes);
  }

  /// Makes a map look as if it had last been used so many seconds ago.
  void age(const std::string& key, int seconds) const {
    const std::string file = path_ + "/" + key + ".map";
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) - std::chrono::seconds(seconds));
  }

  std::string path_;
};

TEST_F(LightMapDirectoryTest, KeepsMapsOverARestart) {
  open(1000)->write("a-1", {1, 2, 3});
  EXPECT_EQ(open(1000)->read("a-1"), (Bytes{1, 2, 3}));
  EXPECT_FALSE(open(1000)->read("a-2"));
}

TEST_F(LightMapDirectoryTest, DropsWhatWasNotUsedForLongest) {
  const auto maps = open(250);
  for (const char* key : {"a-1", "a-2"}) maps->write(key, Bytes(100));
  age("a-1", 60);
  age("a-2", 30);
  EXPECT_TRUE(maps->read("a-1"));
  maps->write("a-3", Bytes(100));
  EXPECT_TRUE(maps->read("a-1"));
  EXPECT_FALSE(maps->read("a-2"));
  EXPECT_TRUE(maps->read("a-3"));
  maps->write("a-4", Bytes(251));
  EXPECT_FALSE(maps->read("a-4")) << "larger than the budget";
  EXPECT_TRUE(maps->read("a-3"));
  age("a-1", 10);
  EXPECT_FALSE(open(150)->read("a-1")) << "a smaller budget than before";
}

TEST_F(LightMapDirectoryTest, RemovesTheMapsOfAScene) {
  const auto maps = open(1000);
  for (const char* key : {"a-1", "a-2", "ab-1"}) maps->write(key, Bytes(10));
  maps->removeScene("a");
  EXPECT_FALSE(maps->read("a-1"));
  EXPECT_FALSE(maps->read("a-2"));
  EXPECT_TRUE(maps->read("ab-1"));
}

TEST_F(LightMapDirectoryTest, WhatTheDiskRefusesIsPassedOver) {
  const auto maps = open(1000);
  maps->write("a-1", Bytes(10));
  std::filesystem::remove_all(path_);
  EXPECT_FALSE(maps->read("a-1"));
  std::filesystem::copy_file("/proc/self/exe", path_); // no directory can be made in its place
  maps->write("a-1", Bytes(10));
  EXPECT_FALSE(maps->read("a-1"));
  maps->removeScene("a");
}

} // namespace
} // namespace gnomon
