#include "server/worker/scene_loader.h"

#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "server/system/file_descriptor.h"
#include "server/wire/bundle.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

/// The file and the id of a bundle.
struct Stored {
  explicit Stored(const SceneBundle& bundle) {
    MemoryFileWriter writer;
    Sha256 hash;
    writeBundle(bundle, [&](std::span<const std::uint8_t> piece) {
      writer.add(piece);
      hash.add(piece);
    });
    file = *writer.finish();
    id = hash.hex();
  }
  FileDescriptor file;
  std::string id;
};

/// A scene of its own for each number.
Stored cube(int number) {
  auto builder = testing::cube();
  builder.json["nodes"][0]["name"] = "cube " + std::to_string(number);
  return Stored(builder.bundle());
}

const LoadedScene* loaded(const std::variant<LoadedScene, LoadFailure>& result) {
  return std::get_if<LoadedScene>(&result);
}

TEST(SceneLoader, LoadsAndNamesScenes) {
  SceneLoader loader(1 << 30, kLimits);
  const Stored bundle = cube(1);
  const auto result = loader.get(bundle.id, {bundle.file, true});
  ASSERT_TRUE(loaded(result));
  EXPECT_EQ(loaded(result)->summary.id, bundle.id);
  EXPECT_EQ(loaded(result)->summary.triangles, 12u);
  EXPECT_EQ(loaded(loader.get(bundle.id, {bundle.file}))->scene, loaded(result)->scene) << "kept";
  EXPECT_EQ(loader.count(), 1u);
  loader.forget(bundle.id);
  EXPECT_EQ(loader.count(), 0u);
}

TEST(SceneLoader, LoadsABundleOfSeveralFiles) {
  auto builder = testing::cube();
  builder.json["buffers"] = {{{"uri", "a b.bin"}, {"byteLength", builder.binary.size()}}};
  const std::string json = builder.json.dump();
  const Stored bundle(SceneBundle{Bytes(json.begin(), json.end()), {{"a b.bin", builder.binary}}});
  EXPECT_TRUE(loaded(SceneLoader(1 << 30, kLimits).get(bundle.id, {bundle.file, true})));
}

TEST(SceneLoader, TellsDamagedBytesFromBadScenes) {
  SceneLoader loader(1 << 30, kLimits);
  const auto damaged = loader.get(cube(1).id, {cube(2).file, true});
  ASSERT_FALSE(loaded(damaged));
  EXPECT_TRUE(std::get<LoadFailure>(damaged).damaged);
  const Stored bad(SceneBundle{{'x'}, {}});
  const auto failure = loader.get(bad.id, {bad.file, true});
  ASSERT_FALSE(loaded(failure));
  EXPECT_FALSE(std::get<LoadFailure>(failure).damaged);
  EXPECT_FALSE(std::get<LoadFailure>(failure).problems.empty());
}

TEST(SceneLoader, RefusesWhatMemoryCannotHold) {
  const auto failure = SceneLoader(10, kLimits).get(cube(1).id, {cube(1).file});
  ASSERT_FALSE(loaded(failure));
  EXPECT_EQ(std::get<LoadFailure>(failure).problems[0].code, ProblemCode::tooLarge);
}

TEST(SceneLoader, ForgetsTheLeastUsed) {
  SceneLoader measuring(1 << 30, kLimits);
  const std::size_t one = loaded(measuring.get(cube(1).id, {cube(1).file}))->summary.memoryBytes;
  SceneLoader loader(one * 2 + one / 2, kLimits);
  for (const int number : {1, 2, 1, 3}) loader.get(cube(number).id, {cube(number).file});
  EXPECT_EQ(loader.count(), 2u);
  EXPECT_LE(loader.bytes(), one * 2 + one / 2);
  const FileDescriptor none;
  EXPECT_TRUE(loaded(loader.get(cube(1).id, {none}))) << "still in memory";
  EXPECT_FALSE(loaded(loader.get(cube(2).id, {none})));
}

TEST(SceneLoader, LoadsOnceForAll) {
  SceneLoader loader(1 << 30, kLimits);
  const Stored bundle = cube(1);
  std::vector<ScenePtr> scenes(8);
  std::vector<std::thread> threads;
  for (ScenePtr& scene : scenes) {
    threads.emplace_back([&] { scene = loaded(loader.get(bundle.id, {bundle.file}))->scene; });
  }
  for (std::thread& thread : threads) thread.join();
  for (const ScenePtr& scene : scenes) EXPECT_EQ(scene, scenes.front());
}

TEST(SingleFlight, RunsOnceForAllWhoAskMeanwhile) {
  SingleFlight<int> flights;
  std::atomic<int> runs = 0;
  std::promise<void> started, release;
  const auto work = [&] {
    ++runs;
    started.set_value();
    release.get_future().wait();
    return 7;
  };
  std::thread first([&] { EXPECT_EQ(flights.run("key", work), 7); });
  started.get_future().wait();
  std::vector<std::thread> others;
  for (int i = 0; i < 4; ++i) {
    others.emplace_back([&] { EXPECT_EQ(flights.run("key", [&] { return 7 + 0 * ++runs; }), 7); });
  }
  EXPECT_EQ(flights.run("other", [] { return 8; }), 8); // not held up
  release.set_value();
  first.join();
  for (std::thread& other : others) {
    other.join();
  }
}

TEST(SingleFlight, WhoWaitsForAnothersWorkMayGiveUp) {
  SingleFlight<int> flights;
  std::promise<void> started, release;
  std::thread first([&] {
    EXPECT_EQ(flights.run("key",
                          [&] {
                            started.set_value();
                            release.get_future().wait();
                            return 7;
                          }),
              7);
  });
  started.get_future().wait();
  bool ran = false;
  int asked = 0;
  const auto mine = [&] {
    ran = true;
    return 8;
  };
  EXPECT_EQ(flights.run("key", mine, [&] { return ++asked < 3; }), std::nullopt);
  EXPECT_EQ(asked, 3);
  EXPECT_FALSE(ran);
  release.set_value();
  first.join();
  EXPECT_EQ(flights.run("key", mine, [] { return false; }), 8) << "work of its own listens by itself";
}

TEST(SingleFlight, RemembersNothing) {
  SingleFlight<int> flights;
  EXPECT_EQ(flights.run("key", [] { return 1; }), 1);
  EXPECT_EQ(flights.run("key", [] { return 2; }), 2);
}

TEST(SingleFlight, LandsAfterAnException) {
  SingleFlight<int> flights;
  EXPECT_THROW(flights.run("key", []() -> int { throw std::runtime_error("x"); }), std::runtime_error);
  EXPECT_EQ(flights.run("key", [] { return 2; }), 2);
}

} // namespace
} // namespace gnomon
