#include "server/scenes/scene_store.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "server/scenes/upload.h"
#include "server/system/file_descriptor.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

/// A bundle of its own for each number. Nothing in a store reads it.
PackedBundle scene(int number) {
  return *packed({Bytes(10, static_cast<std::uint8_t>(number)), {}});
}

std::string summaryOf(const PackedBundle& bundle) {
  SceneSummary summary;
  summary.id = bundle.id;
  return jsonText(toJson(summary));
}

class SceneStoreTest : public ::testing::Test {
 protected:
  SceneStoreTest() {
    std::string pattern = (fs::temp_directory_path() / "gnomon-store-XXXXXX").string();
    directory_ = ::mkdtemp(pattern.data());
  }
  ~SceneStoreTest() override { fs::remove_all(directory_); }

  std::unique_ptr<SceneStore> open(const std::string& directory) {
    auto store = SceneStore::open({directory, 1 << 20});
    EXPECT_TRUE(store);
    return store ? *std::move(store) : nullptr;
  }

  static bool put(SceneStore& store, const PackedBundle& bundle) {
    return *store.put(bundle.id, bundle.file, bundle.bytes, summaryOf(bundle));
  }

  fs::path path(const std::string& id, const char* ending) const { return directory_ / (id + ending); }

  fs::path directory_;
};

TEST_F(SceneStoreTest, FindsItsScenesAgain) {
  put(*open(directory_), scene(1));
  const auto store = open(directory_);
  EXPECT_EQ(store->page("", 10)->ids, std::vector{scene(1).id});
  EXPECT_EQ(store->summary(scene(1).id), summaryOf(scene(1)));
  EXPECT_FALSE(put(*store, scene(1)));
}

TEST_F(SceneStoreTest, DamagedBytesAreSetAsideUntilTheSceneComesAgain) {
  const auto store = open(directory_);
  put(*store, scene(1));
  store->setAside(scene(1).id);
  EXPECT_FALSE(store->contains(scene(1).id));
  EXPECT_TRUE(fs::exists(path(scene(1).id, ".damaged")));
  EXPECT_TRUE(put(*store, scene(1)));
  EXPECT_TRUE(store->bundle(scene(1).id));
}

TEST_F(SceneStoreTest, ASummaryThatCannotBeUsedIsNone) {
  const auto store = open(directory_);
  put(*store, scene(1));
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string(R"({"id": "other"})"), summaryOf(scene(2))}) {
    std::ofstream(path(scene(1).id, ".json")) << text;
    EXPECT_FALSE(store->summary(scene(1).id)) << text;
  }
  store->keepSummary(scene(1).id, summaryOf(scene(1)));
  EXPECT_TRUE(store->summary(scene(1).id));
  fs::remove(path(scene(1).id, ".json"));
  EXPECT_FALSE(store->summary(scene(1).id));
}

TEST_F(SceneStoreTest, CleansUpAfterAnInterruptedWrite) {
  std::ofstream(directory_ / ".writing-1-1") << "half";
  fs::last_write_time(directory_ / ".writing-1-1", fs::file_time_type::clock::now() - std::chrono::minutes(61));
  std::ofstream(directory_ / ".writing-2-1") << "another server is writing this";
  std::ofstream(directory_ / (std::string(64, 'a') + ".json")) << "the summary of a scene that is gone";
  std::ofstream(directory_ / "not a scene.bundle") << "x";
  const auto store = open(directory_);
  EXPECT_FALSE(fs::exists(directory_ / ".writing-1-1"));
  EXPECT_TRUE(store->page("", 10)->ids.empty());
  EXPECT_TRUE(fs::exists(directory_ / ".writing-2-1"));
  EXPECT_FALSE(fs::exists(directory_ / (std::string(64, 'a') + ".json")));
}

TEST_F(SceneStoreTest, ForgetsTheLeastUsedOfThoseInMemory) {
  const auto whole = open("");
  put(*whole, scene(1));
  const std::size_t one = whole->size().bytes;
  EXPECT_GE(one, 4'096u) << "the smallest scene takes a page of memory";
  const auto byBytes = *SceneStore::open({.memoryBytes = one * 2 + one / 2});
  const auto byNumber = *SceneStore::open({.memoryScenes = 2});
  for (SceneStore* store : {byBytes.get(), byNumber.get()}) {
    put(*store, scene(1));
    put(*store, scene(2));
    ASSERT_TRUE(store->bundle(scene(1).id));
    put(*store, scene(3));
    EXPECT_TRUE(store->contains(scene(1).id));
    EXPECT_FALSE(store->contains(scene(2).id));
    EXPECT_TRUE(store->contains(scene(3).id));
  }
}

TEST_F(SceneStoreTest, WhatIsDamagedTakesItsRoom) {
  auto store = *SceneStore::open({.directory = directory_, .storedBytes = 25});
  EXPECT_TRUE(put(*store, scene(1)));
  EXPECT_TRUE(put(*store, scene(2)));
  store->setAside(scene(1).id);
  EXPECT_FALSE(store->checkRoom(6));
  EXPECT_TRUE(store->remove(scene(2).id));
  EXPECT_TRUE(put(*store, scene(3)));
}

TEST_F(SceneStoreTest, WhatNobodyUsesGoesAndNothingElse) {
  using std::chrono::hours;
  auto store = *SceneStore::open({.directory = directory_, .age = hours(1)});
  for (int i = 1; i <= 4; ++i) put(*store, scene(i));
  const auto makeOld = [&](int number, const char* ending) {
    fs::last_write_time(path(scene(number).id, ending), fs::file_time_type::clock::now() - hours(2));
  };
  for (int i = 1; i <= 3; ++i) makeOld(i, ".bundle");
  EXPECT_TRUE(store->use(scene(2).id));
  const auto held = store->bundle(scene(3).id);
  makeOld(3, ".bundle");
  store->setAside(scene(4).id);
  makeOld(4, ".damaged");
  std::ofstream(directory_ / "notes.bundle") << "not ours";
  fs::last_write_time(directory_ / "notes.bundle", fs::file_time_type::clock::now() - hours(2));
  std::vector<std::string> removed;
  store->keepClean([&](const std::string& id) { removed.push_back(id); });
  EXPECT_EQ(removed, std::vector{scene(1).id});
  EXPECT_FALSE(fs::exists(path(scene(1).id, ".json")));
  EXPECT_TRUE(store->contains(scene(2).id));
  EXPECT_TRUE(store->contains(scene(3).id)) << "somebody reads it";
  EXPECT_FALSE(fs::exists(path(scene(4).id, ".damaged")));
  EXPECT_TRUE(fs::exists(directory_ / "notes.bundle"));
}

TEST_F(SceneStoreTest, RefusesAPlaceThatIsNoDirectory) {
  std::ofstream(directory_ / "file") << "x";
  EXPECT_FALSE(SceneStore::open({(directory_ / "file").string()}));
}

} // namespace
} // namespace gnomon
