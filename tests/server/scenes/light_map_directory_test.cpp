#include "server/scenes/light_map_directory.h"

#include <filesystem>
#include <gtest/gtest.h>

#include "server/system/memory_file.h"

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

  /// A key of a scene, and of what was baked.
  static std::string key(char scene, char baked) { return std::string(64, scene) + "-" + std::string(64, baked); }

  static void write(LightMapDirectory& maps, const std::string& key, const Bytes& bytes) {
    maps.write(key, *memoryFile(bytes));
  }
  static std::optional<Bytes> read(LightMapDirectory& maps, const std::string& key) {
    const FileDescriptor file = maps.open(key);
    return file ? readFile(file, 1 << 20) : std::nullopt;
  }

  std::string path_;
};

TEST_F(LightMapDirectoryTest, KeepsMapsOverARestart) {
  write(*open(1000), key('a', '1'), {1, 2, 3});
  EXPECT_EQ(read(*open(1000), key('a', '1')), (Bytes{1, 2, 3}));
  EXPECT_FALSE(read(*open(1000), key('a', '2')));
}

TEST_F(LightMapDirectoryTest, DropsWhatWasNotUsedForLongest) {
  const auto maps = open(250);
  for (const std::string& each : {key('a', '1'), key('a', '2')}) write(*maps, each, Bytes(100));
  age(key('a', '1'), 60);
  age(key('a', '2'), 30);
  EXPECT_TRUE(read(*maps, key('a', '1')));
  write(*maps, key('a', '3'), Bytes(100));
  EXPECT_TRUE(read(*maps, key('a', '1')));
  EXPECT_FALSE(read(*maps, key('a', '2')));
  EXPECT_TRUE(read(*maps, key('a', '3')));
  write(*maps, key('a', '4'), Bytes(251));
  EXPECT_FALSE(read(*maps, key('a', '4'))) << "larger than the budget";
  EXPECT_TRUE(read(*maps, key('a', '3')));
  age(key('a', '1'), 10);
  EXPECT_FALSE(read(*open(150), key('a', '1'))) << "a smaller budget than before";
}

TEST_F(LightMapDirectoryTest, RemovesTheMapsOfAScene) {
  const auto maps = open(1000);
  for (const std::string& each : {key('a', '1'), key('a', '2'), key('b', '1')}) write(*maps, each, Bytes(10));
  maps->removeScene(std::string(64, 'a'));
  EXPECT_FALSE(read(*maps, key('a', '1')));
  EXPECT_FALSE(read(*maps, key('a', '2')));
  EXPECT_TRUE(read(*maps, key('b', '1')));
}

TEST_F(LightMapDirectoryTest, WhatTheDiskRefusesIsPassedOver) {
  const auto maps = open(1000);
  write(*maps, key('a', '1'), Bytes(10));
  std::filesystem::remove_all(path_);
  EXPECT_FALSE(read(*maps, key('a', '1')));
  std::filesystem::copy_file("/proc/self/exe", path_); // no directory can be made in its place
  write(*maps, key('a', '1'), Bytes(10));
  EXPECT_FALSE(read(*maps, key('a', '1')));
  maps->removeScene(std::string(64, 'a'));
}

TEST_F(LightMapDirectoryTest, TakesNoKeyThatLeadsElsewhere) {
  const auto maps = open(1000);
  for (const std::string& each : {std::string("../escaped"), std::string("a-1"), key('a', 'G'), key('a', '1') + "/"}) {
    write(*maps, each, {1});
    EXPECT_FALSE(maps->open(each)) << each;
  }
  EXPECT_FALSE(std::filesystem::exists(path_ + "/../escaped.map"));
}

} // namespace
} // namespace gnomon
