#include "server/bakes/bake_registry.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(BakeRegistry, IsFoundOnceItIsDone) {
  BakeRegistry book;
  FrameSpec spec;
  spec.scene = 3;
  book.begin({"a", "1"}, spec);
  EXPECT_FALSE(book.find({"a", "1"}));
  book.end({"a", "1"}, true);
  ASSERT_TRUE(book.find({"a", "1"}));
  EXPECT_EQ(book.find({"a", "1"})->scene, 3);
  EXPECT_FALSE(book.find({"b", "1"})) << "a key belongs to its scene";
  EXPECT_FALSE(book.find({"a", "2"}));
}

TEST(BakeRegistry, WhatFailsIsForgottenButNotWhatWasMadeBefore) {
  BakeRegistry book;
  book.begin({"a", "1"}, {});
  book.end({"a", "1"}, false);
  EXPECT_FALSE(book.remove({"a", "1"}));
  book.begin({"a", "1"}, {});
  book.end({"a", "1"}, true);
  book.begin({"a", "1"}, {});
  book.end({"a", "1"}, false);
  EXPECT_TRUE(book.find({"a", "1"}));
}

TEST(BakeRegistry, RemovingStopsAndForgets) {
  BakeRegistry book;
  const auto removed = book.begin({"a", "1"}, {});
  EXPECT_FALSE(*removed);
  EXPECT_TRUE(book.remove({"a", "1"}));
  EXPECT_TRUE(*removed);
  EXPECT_FALSE(book.remove({"a", "1"}));
  book.end({"a", "1"}, true);
  EXPECT_FALSE(book.find({"a", "1"}));
  EXPECT_FALSE(*book.begin({"a", "1"}, {})) << "a bake after it is another";
}

TEST(BakeRegistry, ForgetsTheOldest) {
  BakeRegistry book;
  for (std::size_t i = 0; i <= BakeRegistry::kMost; ++i) {
    book.begin({"a", std::to_string(i)}, {});
    book.end({"a", std::to_string(i)}, true);
  }
  EXPECT_FALSE(book.find({"a", "0"}));
  EXPECT_TRUE(book.find({"a", "1"}));
}

} // namespace
} // namespace gnomon
