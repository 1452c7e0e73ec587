// What any store of scenes does, whatever keeps them.

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocol/json/json_codec.h"
#include "server/scenes/scene_store.h"
#include "server/scenes/upload.h"
#include "server/system/file_descriptor.h"
#include "tests/support/redis_server.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using testing::RedisServer;

/// A bundle of its own for each number. Nothing in a store reads it.
PackedBundle numbered(int number, std::size_t bytes = 10) {
  Bytes model(bytes, static_cast<std::uint8_t>(number));
  model[0] = static_cast<std::uint8_t>(number >> 8);
  return *packed({std::move(model), {}});
}

std::string summaryFor(const PackedBundle& bundle) {
  SceneSummary summary;
  summary.id = bundle.id;
  return jsonText(toJson(summary));
}

bool put(SceneStore& store, const PackedBundle& bundle) {
  const auto kept = store.put(bundle.id, bundle.file, bundle.bytes, summaryFor(bundle));
  EXPECT_TRUE(kept) << (kept ? "" : kept.problems().front().detail);
  return kept && *kept;
}

ProblemCode codeOf(const Problems& problems) {
  return problems.front().code;
}

enum class Kind { memory, directory, redis };

/// A place for scenes, which each store that is opened shares, unless it is memory.
class AnyStore : public ::testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    if (GetParam() == Kind::directory) {
      std::string pattern = (fs::temp_directory_path() / "gnomon-store-XXXXXX").string();
      directory_ = ::mkdtemp(pattern.data());
    }
    if (GetParam() == Kind::redis) {
      if (!RedisServer::isInstalled()) GTEST_SKIP() << "redis-server is not installed.";
      server_ = std::make_unique<RedisServer>();
    }
  }
  ~AnyStore() override {
    if (!directory_.empty()) fs::remove_all(directory_);
  }

  std::unique_ptr<SceneStore> open(SceneStoreOptions options = {}) const {
    options.memoryBytes = 64 << 20;
    options.directory = directory_;
    if (server_) {
      options.redis = std::make_shared<redis::Redis>(redis::Options{.address = *redis::parseAddress(server_->url())});
    }
    auto store = SceneStore::open(options);
    EXPECT_TRUE(store);
    return *std::move(store);
  }

  bool isShared() const { return GetParam() != Kind::memory; }

  std::string directory_;
  std::unique_ptr<RedisServer> server_;
};

TEST_P(AnyStore, KeepsBundlesAndSummaries) {
  const auto store = open();
  const PackedBundle first = numbered(1);
  const std::string other = numbered(2).id;
  EXPECT_TRUE(put(*store, first));
  EXPECT_FALSE(put(*store, first)) << "it is there already";
  EXPECT_TRUE(store->contains(first.id));
  EXPECT_TRUE(store->use(first.id));
  const auto bundle = store->bundle(first.id);
  ASSERT_TRUE(bundle);
  EXPECT_EQ(readFile(*bundle->file, 100), readFile(*first.file, 100));
  if (GetParam() != Kind::redis) {
    EXPECT_EQ(bundle->isStored, isShared());
  }
  EXPECT_EQ(store->summary(first.id), summaryFor(first));
  EXPECT_EQ(store->size().scenes, 1u);
  EXPECT_GE(store->size().bytes, 10u);
  for (const std::string& none : {other, std::string("../") + other, std::string()}) {
    EXPECT_EQ(codeOf(store->contains(none).problems()), ProblemCode::notFound);
    EXPECT_EQ(codeOf(store->use(none).problems()), ProblemCode::notFound);
    EXPECT_EQ(codeOf(store->bundle(none).problems()), ProblemCode::notFound);
    EXPECT_EQ(codeOf(store->remove(none).problems()), ProblemCode::notFound);
  }
  EXPECT_FALSE(store->summary(other));
}

TEST_P(AnyStore, KeepsBundlesOfManyParts) {
  const auto store = open();
  Bytes model(5'000'001);
  for (std::size_t i = 0; i < model.size(); ++i) model[i] = static_cast<std::uint8_t>(i * 2654435761u >> 24);
  const PackedBundle large = *packed({std::move(model), {}});
  EXPECT_TRUE(put(*store, large));
  const auto again = isShared() ? open() : nullptr;
  const auto bundle = (again ? *again : *store).bundle(large.id);
  ASSERT_TRUE(bundle);
  EXPECT_EQ(readFile(*bundle->file, 10 << 20), readFile(*large.file, 10 << 20));
}

TEST_P(AnyStore, RemovesAllOfAScene) {
  auto store = open();
  const PackedBundle first = numbered(1);
  put(*store, first);
  EXPECT_TRUE(store->remove(first.id));
  EXPECT_EQ(codeOf(store->remove(first.id).problems()), ProblemCode::notFound);
  EXPECT_FALSE(store->bundle(first.id));
  EXPECT_FALSE(store->summary(first.id));
  EXPECT_EQ(store->size().scenes, 0u);
  EXPECT_EQ(store->size().bytes, 0u);
  EXPECT_TRUE(put(*store, first)) << "it may come again";
  EXPECT_TRUE(store->remove(first.id));
  store.reset();
  EXPECT_TRUE(directory_.empty() || fs::is_empty(directory_));
}

TEST_P(AnyStore, PagesFollowEachOther) {
  const auto store = open();
  std::vector<std::string> all;
  for (int i = 0; i < 7; ++i) {
    put(*store, numbered(i));
    all.push_back(numbered(i).id);
  }
  std::sort(all.begin(), all.end());
  for (const std::size_t limit : {1u, 3u, 6u, 7u, 8u}) {
    std::vector<std::string> found;
    ScenePage page{{}, true};
    while (page.hasMore) {
      page = *store->page(found.empty() ? "" : found.back(), limit);
      ASSERT_LE(page.ids.size(), limit);
      ASSERT_TRUE(!page.hasMore || page.ids.size() == limit);
      found.insert(found.end(), page.ids.begin(), page.ids.end());
    }
    EXPECT_EQ(found, all) << limit;
  }
  EXPECT_EQ(store->page(all[2] + "0", 2)->ids, (std::vector{all[3], all[4]}));
}

TEST_P(AnyStore, ASummaryThatCouldNotBeReadBackIsRefused) {
  const auto store = open();
  const PackedBundle first = numbered(1);
  const auto refused = store->put(first.id, first.file, 10, std::string(SceneBackend::kMaxSummaryBytes + 1, ' '));
  ASSERT_FALSE(refused);
  EXPECT_EQ(codeOf(refused.problems()), ProblemCode::tooLarge);
  EXPECT_FALSE(store->contains(first.id));
}

TEST_P(AnyStore, OthersSeeWhatOneDoes) {
  if (!isShared()) GTEST_SKIP() << "memory is nobody else's";
  const auto one = open();
  const auto other = open();
  const PackedBundle first = numbered(1);
  put(*one, first);
  EXPECT_FALSE(put(*other, first));
  EXPECT_TRUE(other->bundle(first.id));
  EXPECT_TRUE(other->counts(first.id));
  std::atomic<int> told = 0;
  other->onRemoved([&](const std::string& id) { told += id == first.id ? 1 : 0; });
  EXPECT_TRUE(one->remove(first.id));
  const auto begun = Clock::now();
  while (other->use(first.id) && Clock::now() < begun + std::chrono::seconds(10)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(other->use(first.id));
  EXPECT_LT(Clock::now() - begun, std::chrono::seconds(1)) << "also where it was in memory";
  EXPECT_FALSE(other->bundle(first.id));
  while (told == 0 && Clock::now() < begun + std::chrono::seconds(10)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GE(told, 1);
  other->onRemoved(nullptr);
}

TEST_P(AnyStore, AQuotaCountsWhatIsThereAndWhatGoes) {
  if (!isShared()) GTEST_SKIP() << "memory drops what does not fit";
  const auto store = open({.storedBytes = 25});
  EXPECT_TRUE(put(*store, numbered(1)));
  EXPECT_TRUE(store->checkRoom(15));
  EXPECT_FALSE(store->checkRoom(16));
  EXPECT_TRUE(put(*store, numbered(2)));
  const auto refused = store->put(numbered(3).id, numbered(3).file, 10, summaryFor(numbered(3)));
  ASSERT_FALSE(refused);
  EXPECT_EQ(codeOf(refused.problems()), ProblemCode::insufficientStorage);
  EXPECT_EQ(refused.problems().front().limit, "25 bytes");
  EXPECT_FALSE(store->contains(numbered(3).id));
  EXPECT_FALSE(put(*store, numbered(1))) << "what is there needs no room";
  EXPECT_TRUE(store->remove(numbered(2).id));
  EXPECT_TRUE(put(*store, numbered(3)));
}

TEST_P(AnyStore, UploadsAtOnceDoNotPassTheQuotaTogether) {
  if (!isShared()) GTEST_SKIP() << "memory has none";
  const auto store = open({.storedBytes = 350'000});
  std::atomic<int> kept = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      const PackedBundle bundle = numbered(i, 100'000);
      kept += store->put(bundle.id, bundle.file, bundle.bytes, summaryFor(bundle)) ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(kept, 3);
  EXPECT_EQ(store->size().bytes, 300'000u);
}

TEST_P(AnyStore, TheSameSceneFromManyIsKeptOnce) {
  const auto store = open();
  const PackedBundle bundle = numbered(1, 3'000'000);
  std::atomic<int> isNew = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&] {
      const auto kept = store->put(bundle.id, bundle.file, bundle.bytes, summaryFor(bundle));
      EXPECT_TRUE(kept);
      isNew += kept && *kept ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_GE(isNew, 1);
  EXPECT_EQ(store->size().scenes, 1u);
  EXPECT_TRUE(store->bundle(bundle.id));
}

TEST_P(AnyStore, ASummaryCanBeMadeAgain) {
  const auto store = open();
  const PackedBundle first = numbered(1);
  ASSERT_TRUE(store->put(first.id, first.file, 10, isShared() ? "{" : summaryFor(first)));
  EXPECT_EQ(store->summary(first.id).has_value(), !isShared()) << "a damaged one is none";
  store->keepSummary(first.id, summaryFor(first));
  EXPECT_EQ(store->summary(first.id), summaryFor(first));
}

std::string kindName(const ::testing::TestParamInfo<Kind>& kind) {
  return kind.param == Kind::memory ? "Memory" : kind.param == Kind::directory ? "Directory" : "Redis";
}

INSTANTIATE_TEST_SUITE_P(All, AnyStore, ::testing::Values(Kind::memory, Kind::directory, Kind::redis), kindName);

} // namespace
} // namespace gnomon
