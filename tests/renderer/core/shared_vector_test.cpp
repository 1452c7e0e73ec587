#include <gtest/gtest.h>

#include "renderer/core/vectors.h"

namespace gnomon {
namespace {

TEST(SharedVector, CopiesShareUntilOneIsEdited) {
  SharedVector<int> first{1, 2, 3};
  const SharedVector<int> second = first;
  EXPECT_TRUE(second.sharesWith(first));
  EXPECT_EQ(second.data(), first.data());
  first.edit()[1] = 5;
  EXPECT_FALSE(second.sharesWith(first));
  EXPECT_EQ(*second, (std::vector{1, 2, 3}));
  EXPECT_EQ(*first, (std::vector{1, 5, 3}));
}

TEST(SharedVector, WhatNobodySharesIsEditedInPlace) {
  SharedVector<int> only{1, 2, 3};
  const int* before = only.data();
  only.edit()[0] = 9;
  EXPECT_EQ(only.data(), before);
}

TEST(SharedVector, EqualElementsAreEqualSharedOrNot) {
  EXPECT_TRUE((SharedVector<int>{1, 2} == SharedVector<int>{1, 2}));
  EXPECT_FALSE((SharedVector<int>{1, 2} == SharedVector<int>{1, 3}));
  EXPECT_TRUE(SharedVector<int>().empty());
}

} // namespace
} // namespace gnomon
