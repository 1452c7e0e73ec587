#include "renderer/cpu/tile_store.h"

#include <gtest/gtest.h>

namespace gnomon::cpu {
namespace {

constexpr std::size_t kTile = 64 * 64 * sizeof(float);

std::shared_ptr<RasteredTile> tile() {
  auto made = std::make_shared<RasteredTile>();
  made->depths = unfilledBuffer(64, 64, 1, false, {});
  EXPECT_EQ(made->bytes(), kTile);
  return made;
}

/// A frame with these tiles: looks for all, then makes and keeps the others. How many were found.
int frame(TileStore& store, const std::vector<TileKey>& keys) {
  std::vector<TileKey> missing;
  for (const TileKey& key : keys) {
    if (!store.find(key)) missing.push_back(key);
  }
  std::vector<std::shared_ptr<RasteredTile>> held;
  for (const TileKey& key : missing) {
    store.room(kTile);
    held.push_back(tile());
    store.keep(key, held.back());
  }
  return static_cast<int>(keys.size() - missing.size());
}

TEST(TileStore, TilesThatAreFoundAgainMayFillTheBudgetAndOthersAQuarter) {
  TileStore store(8 * kTile);
  EXPECT_EQ(frame(store, {"a", "b"}), 0);
  EXPECT_EQ(frame(store, {"a", "b"}), 2);
  EXPECT_EQ(frame(store, {"c", "d"}), 0);
  EXPECT_EQ(frame(store, {"e"}), 0);
  EXPECT_FALSE(store.find("c")) << "only two that are new are kept";
  EXPECT_EQ(frame(store, {"a", "b", "d", "e"}), 4);
}

TEST(TileStore, AFrameOfMoreTilesThanAQuarterFindsThemAllAgain) {
  TileStore store(8 * kTile);
  const std::vector<TileKey> six{"a", "b", "c", "d", "e", "f"};
  EXPECT_EQ(frame(store, six), 0);
  EXPECT_EQ(frame(store, six), 6);
  EXPECT_EQ(frame(store, {"g", "h", "i"}), 0);
  EXPECT_EQ(frame(store, six), 5) << "the budget is full";
}

TEST(TileStore, TheLeastRecentlyUsedGoFirstOnceTheBudgetIsFull) {
  TileStore store(4 * kTile);
  for (const char* key : {"a", "b", "c", "d"}) {
    store.keep(key, tile());
    EXPECT_TRUE(store.find(key));
  }
  store.keep("e", tile());
  EXPECT_FALSE(store.find("a"));
  for (const char* key : {"b", "c", "d", "e"}) EXPECT_TRUE(store.find(key)) << key;
}

TEST(TileStore, MomentsThatAFrameMadeAreCountedOnceItIsOver) {
  const auto blurred = [] {
    auto made = tile();
    made->moments.resize(64 * 64);
    made->blurred = TexelMarks(64, 64);
    return made;
  };
  constexpr std::size_t kMoments = 64 * 64 * sizeof(glm::vec4);
  TileStore store(2 * kTile + kMoments);
  for (const char* key : {"a", "b"}) {
    store.keep(key, blurred());
    EXPECT_TRUE(store.find(key));
  }
  store.find("a")->blurred.markAll();
  store.room(0);
  EXPECT_TRUE(store.find("a") && store.find("b")) << "just as much as it may hold";
  store.find("b")->blurred.markAll();
  store.room(0);
  EXPECT_FALSE(store.find("a"));
  EXPECT_TRUE(store.find("b"));
}

TEST(TileStore, MemoryOfWhatGoesIsUsedAgainUnlessSomebodyHoldsIt) {
  TileStore store(4 * kTile);
  const auto held = tile();
  store.keep("held", held);
  EXPECT_EQ(store.room(kTile).depths.places(), 0u);
  store.keep("free", tile());
  EXPECT_EQ(store.room(kTile).depths.places(), 64u * 64u);
}

TEST(TileStore, ALargeTileIsKeptAloneAndOneBeyondTheBudgetNotAtAll) {
  TileStore large(kTile);
  large.keep("a", tile());
  EXPECT_TRUE(large.find("a"));
  TileStore small(kTile - 1);
  small.keep("a", tile());
  EXPECT_FALSE(small.find("a"));
  TileStore none(0);
  none.keep("a", tile());
  EXPECT_FALSE(none.find("a"));
}

} // namespace
} // namespace gnomon::cpu
