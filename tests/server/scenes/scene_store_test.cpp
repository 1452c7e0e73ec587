#include "server/scenes/scene_store.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/json/json_codec.h"
#include "server/scenes/bundle.h"
#include "tests/support/files.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

/// A scene of its own for each number.
SceneBundle scene(int number) {
  auto builder = testing::cube();
  builder.json["nodes"][0]["name"] = "cube " + std::to_string(number);
  return builder.bundle();
}

class SceneStoreTest : public ::testing::Test {
 protected:
  SceneStoreTest() {
    std::string pattern = (fs::temp_directory_path() / "gnomon-store-XXXXXX").string();
    directory_ = ::mkdtemp(pattern.data());
  }
  ~SceneStoreTest() override { fs::remove_all(directory_); }

  std::unique_ptr<SceneStore> open(const std::string& directory, std::size_t memoryBytes = 1 << 30) {
    auto store = SceneStore::open({directory, memoryBytes, kLimits});
    EXPECT_TRUE(store);
    return store ? *std::move(store) : nullptr;
  }

  fs::path bundlePath(const std::string& id) const { return directory_ / (id + ".bundle"); }

  fs::path summaryPath(const std::string& id) const { return directory_ / (id + ".json"); }
  static std::string textOf(const fs::path& path) {
    const auto bytes = testing::readFile(path);
    return {bytes.begin(), bytes.end()};
  }

  fs::path directory_;
};

TEST_F(SceneStoreTest, NamesScenesByTheirBytes) {
  const auto store = open("");
  const auto put = store->put(scene(1));
  ASSERT_TRUE(put);
  EXPECT_TRUE(put->isNew);
  EXPECT_EQ(put->loaded.summary.id, bundleId(scene(1)));
  EXPECT_EQ(put->loaded.summary.bytes, scene(1).model.size());
  EXPECT_EQ(put->loaded.summary.triangles, 12u);
  EXPECT_FALSE(store->put(scene(1))->isNew);
  EXPECT_EQ(store->get(bundleId(scene(1)))->scene, put->loaded.scene);
}

TEST_F(SceneStoreTest, HoldsTheBytesAgainstTheName) {
  const auto store = open(directory_);
  const auto put = store->put(scene(1), bundleId(scene(2)));
  ASSERT_FALSE(put);
  EXPECT_EQ(put.problems().front().code, ProblemCode::hashMismatch);
  EXPECT_FALSE(store->contains(bundleId(scene(1))));
  EXPECT_TRUE(store->put(scene(1), bundleId(scene(1))));
}

TEST_F(SceneStoreTest, KeepsNothingThatCannotBeLoaded) {
  const auto store = open(directory_);
  const auto put = store->put({{'x'}, {}});
  ASSERT_FALSE(put);
  EXPECT_TRUE(store->summaries().scenes.empty());
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(SceneStoreTest, FindsItsScenesAgain) {
  const std::string id = bundleId(scene(1));
  const Json summary = toJson(open(directory_)->put(scene(1))->loaded.summary);
  const auto reopened = open(directory_);
  EXPECT_TRUE(reopened->contains(id));
  ASSERT_EQ(reopened->summaries().scenes.size(), 1u);
  EXPECT_EQ(toJson(reopened->summaries().scenes[0]), summary);
  EXPECT_EQ(toJson(*reopened->summary(id)), summary);
  const auto loaded = reopened->get(id);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(toJson(loaded->summary), summary);
  EXPECT_FALSE(reopened->put(scene(1))->isNew);
}

TEST_F(SceneStoreTest, KeepsABundleOfSeveralFiles) {
  auto builder = testing::cube();
  builder.json["buffers"] = {{{"uri", "a b.bin"}, {"byteLength", builder.binary.size()}}};
  const std::string json = builder.json.dump();
  const SceneBundle bundle{Bytes(json.begin(), json.end()), {{"a b.bin", builder.binary}}};
  const auto put = open(directory_)->put(bundle);
  ASSERT_TRUE(put) << put.problems().front().detail;
  EXPECT_TRUE(open(directory_)->get(bundleId(bundle)));
}

TEST_F(SceneStoreTest, SetsDamagedBytesAside) {
  const std::string id = bundleId(scene(1));
  ASSERT_TRUE(open(directory_)->put(scene(1)));
  auto bytes = testing::readFile(bundlePath(id));
  bytes.back() ^= 1;
  testing::writeFile(bundlePath(id), bytes);

  const auto store = open(directory_);
  const auto loaded = store->get(id);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.problems().front().code, ProblemCode::notFound);
  EXPECT_FALSE(store->contains(id));
  EXPECT_TRUE(fs::exists(directory_ / (id + ".damaged")));
  EXPECT_TRUE(store->put(scene(1))->isNew);
  EXPECT_TRUE(open(directory_)->get(id));
}

TEST_F(SceneStoreTest, MakesAMissingOrDamagedSummaryAnew) {
  const std::string id = bundleId(scene(1));
  const Json summary = toJson(open(directory_)->put(scene(1))->loaded.summary);
  const std::string stored = textOf(summaryPath(id));
  for (const std::string& text : {std::string(), std::string("{"), std::string("[]"), std::string(R"({"id": "other"})"),
                                  R"({"id": ")" + id + R"("})"}) {
    std::ofstream(summaryPath(id)) << text;
    EXPECT_EQ(toJson(*open(directory_)->summary(id)), summary) << text;
    EXPECT_EQ(textOf(summaryPath(id)), stored) << "and keeps it";
  }
  fs::remove(summaryPath(id));
  EXPECT_EQ(toJson(*open(directory_)->summary(id)), summary);
}

TEST_F(SceneStoreTest, ReadsASummaryWithoutItsScene) {
  const std::string id = bundleId(scene(1));
  const Json summary = toJson(open(directory_)->put(scene(1))->loaded.summary);
  std::ofstream(bundlePath(id)) << "not a scene";
  EXPECT_EQ(toJson(*open(directory_)->summary(id)), summary);
}

TEST_F(SceneStoreTest, CleansUpAfterAnInterruptedWrite) {
  std::ofstream(directory_ / ".writing-1-1") << "half";
  std::ofstream(directory_ / "not a scene.bundle") << "x";
  const auto store = open(directory_);
  EXPECT_FALSE(fs::exists(directory_ / ".writing-1-1"));
  EXPECT_TRUE(store->summaries().scenes.empty());
}

TEST_F(SceneStoreTest, Removes) {
  const std::string id = bundleId(scene(1));
  const auto store = open(directory_);
  ASSERT_TRUE(store->put(scene(1)));
  EXPECT_TRUE(store->remove(id));
  EXPECT_FALSE(store->remove(id));
  EXPECT_FALSE(store->remove("../" + id));
  EXPECT_FALSE(store->get(id));
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(SceneStoreTest, ForgetsTheLeastUsed) {
  const std::size_t one = open("")->put(scene(1))->loaded.summary.memoryBytes;
  const auto store = open("", one * 2 + one / 2);
  ASSERT_TRUE(store->put(scene(1)));
  ASSERT_TRUE(store->put(scene(2)));
  ASSERT_TRUE(store->get(bundleId(scene(1))));
  ASSERT_TRUE(store->put(scene(3)));
  EXPECT_TRUE(store->contains(bundleId(scene(1))));
  EXPECT_FALSE(store->contains(bundleId(scene(2))));
  EXPECT_TRUE(store->contains(bundleId(scene(3))));
}

TEST_F(SceneStoreTest, RefusesWhatMemoryCannotHold) {
  const auto put = open("", 10)->put(scene(1));
  ASSERT_FALSE(put);
  EXPECT_EQ(put.problems().front().code, ProblemCode::tooLarge);
}

TEST_F(SceneStoreTest, UsesAOneShotSceneWithoutStoringIt) {
  const auto store = open(directory_);
  EXPECT_TRUE(store->use(bundleId(scene(1)), scene(1)));
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(SceneStoreTest, LoadsOnceForAll) {
  const std::string id = bundleId(scene(1));
  ASSERT_TRUE(open(directory_)->put(scene(1)));
  const auto store = open(directory_);
  std::vector<ScenePtr> scenes(8);
  std::vector<std::thread> threads;
  for (ScenePtr& loaded : scenes) {
    threads.emplace_back([&] { loaded = store->get(id)->scene; });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const ScenePtr& loaded : scenes) {
    EXPECT_EQ(loaded, scenes.front());
  }
}

TEST_F(SceneStoreTest, RefusesAPlaceThatIsNoDirectory) {
  std::ofstream(directory_ / "file") << "x";
  EXPECT_FALSE(SceneStore::open({(directory_ / "file").string(), 1 << 20, kLimits}));
}

} // namespace
} // namespace gnomon
