#include "server/scenes/scene_store.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <thread>

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

TEST_F(SceneStoreTest, APipeOrALinkWithTheNameOfASceneIsNone) {
  const auto store = open(directory_);
  put(*store, scene(1));
  ASSERT_EQ(::mkfifo(path(scene(2).id, ".bundle").c_str(), 0600), 0);
  fs::create_symlink(path(scene(1).id, ".bundle"), path(scene(3).id, ".bundle"));
  for (const PackedBundle& none : {scene(2), scene(3)}) {
    const auto bundle = store->bundle(none.id); // waits for no writer
    ASSERT_FALSE(bundle);
    EXPECT_EQ(bundle.problems()[0].code, ProblemCode::notFound);
    EXPECT_FALSE(store->contains(none.id));
    EXPECT_FALSE(store->use(none.id));
  }
  fs::remove(path(scene(1).id, ".json"));
  ASSERT_EQ(::mkfifo(path(scene(1).id, ".json").c_str(), 0600), 0);
  EXPECT_FALSE(store->summary(scene(1).id));
  EXPECT_TRUE(put(*store, scene(2))) << "an upload takes its place";
  EXPECT_TRUE(store->bundle(scene(2).id));
}

TEST_F(SceneStoreTest, APipeWithTheNameOfALightMapIsNone) {
  LightMapDirectory maps(directory_, 1 << 20);
  const std::string key = scene(1).id + "-" + scene(2).id;
  ASSERT_EQ(::mkfifo(path(key, ".map").c_str(), 0600), 0);
  EXPECT_FALSE(maps.open(key));
  maps.write(key, *memoryFile(Bytes(100, 'x')));
  EXPECT_EQ(readFile(maps.open(key), 100), Bytes(100, 'x'));
}

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

ProblemCode codeOf(const Status& status) {
  return status ? ProblemCode::internal : status.problems().front().code;
}

TEST_F(SceneStoreTest, ARemovalThatTheDiskRefusesIsNotOneOfAnUnknownScene) {
  const auto store = open(directory_);
  put(*store, scene(1));
  fs::remove(path(scene(1).id, ".bundle"));
  fs::create_directory(path(scene(1).id, ".bundle")); // which unlink(2) refuses, also for root
  EXPECT_EQ(codeOf(store->remove(scene(1).id)), ProblemCode::unavailable);
  EXPECT_TRUE(fs::exists(path(scene(1).id, ".json"))) << "nothing of it is gone";
  EXPECT_EQ(codeOf(store->remove(scene(2).id)), ProblemCode::notFound);
}

TEST_F(SceneStoreTest, ADirectoryThatIsAwayIsNoEmptyStore) {
  const auto store = open(directory_);
  put(*store, scene(1));
  const StoreSize before = store->size();
  EXPECT_TRUE(store->state().isReachable);
  const fs::path away = directory_.string() + "-away";
  fs::rename(directory_, away);
  for (const bool isFile : {false, true}) {
    if (isFile) std::ofstream(directory_) << "in its place";
    EXPECT_FALSE(store->state().isReachable);
    const auto page = store->page("", 10);
    ASSERT_FALSE(page) << "an empty list";
    EXPECT_EQ(page.problems().front().code, ProblemCode::unavailable);
    EXPECT_EQ(codeOf(store->remove(scene(1).id)), ProblemCode::unavailable);
    EXPECT_EQ(codeOf(store->use(scene(1).id)), ProblemCode::unavailable);
    EXPECT_EQ(codeOf(store->contains(scene(2).id)), ProblemCode::unavailable);
    EXPECT_EQ(store->size().bytes, before.bytes) << "as it was last known";
  }
  fs::remove(directory_);
  fs::rename(away, directory_);
  EXPECT_TRUE(store->state().isReachable);
  EXPECT_EQ(store->page("", 10)->ids, std::vector{scene(1).id});
  EXPECT_TRUE(store->remove(scene(1).id));
}

TEST_F(SceneStoreTest, ScenesThatAreOldAllAtOnceStayForATenthOfTheirAgeMore) {
  using std::chrono::seconds;
  constexpr seconds kAge(4);
  auto store = *SceneStore::open({.directory = directory_, .age = kAge});
  for (int i = 1; i <= 4; ++i) put(*store, scene(i));
  const auto setForward = [&] { // as the files look after the clock was set forward
    for (int i = 1; i <= 4; ++i) {
      fs::last_write_time(path(scene(i).id, ".bundle"), fs::file_time_type::clock::now() - std::chrono::hours(48));
    }
  };
  std::vector<std::string> removed;
  const auto pass = [&] { store->keepClean([&](const std::string& id) { removed.push_back(id); }); };
  setForward();
  pass();
  pass();
  EXPECT_TRUE(removed.empty());
  EXPECT_TRUE(store->use(scene(1).id));
  std::this_thread::sleep_for(std::chrono::milliseconds(kAge) / 10);
  pass();
  EXPECT_EQ(removed.size(), 3u);
  EXPECT_TRUE(store->contains(scene(1).id));
}

TEST_F(SceneStoreTest, WhatNobodyUsesGoesAndNothingElse) {
  using std::chrono::hours;
  auto store = *SceneStore::open({.directory = directory_, .age = std::chrono::seconds(10)});
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
  const auto pass = [&] { store->keepClean([&](const std::string& id) { removed.push_back(id); }); };
  pass();
  std::this_thread::sleep_for(std::chrono::milliseconds(1'000));
  pass();
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
