#include "renderer/shadow/depth_range.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/renderer/shadow/random_plan.h"

namespace gnomon {
namespace {

ReceiverDepths receiversBetween(float nearest, float farthest) {
  ReceiverDepths receivers;
  receivers.range = {nearest, farthest};
  return receivers;
}

DepthRange manualRange(double min, double max) {
  DepthRange options;
  options.mode = DepthRangeMode::manual;
  options.min = min;
  options.max = max;
  return options;
}

TEST(DepthRange, X18_AutomaticIsTheSurveyedRangeAndBothEndsAreInside) {
  const auto range = depthRangeOf(CameraView{}, receiversBetween(3.5f, 80.25f), {});
  ASSERT_TRUE(range);
  EXPECT_LT(range->covered.near, 3.5);
  EXPECT_GT(range->covered.far, 80.25);
  EXPECT_NEAR(range->covered.near, 3.5, 1e-4);
  EXPECT_NEAR(range->covered.far, 80.25, 1e-3);
}

TEST(DepthRange, X18_NothingInViewGivesNoRange) {
  EXPECT_FALSE(depthRangeOf(CameraView{}, ReceiverDepths{}, {}));
  EXPECT_FALSE(depthRangeOf(CameraView{}, ReceiverDepths{}, manualRange(0, 10)));
}

TEST(DepthRange, X21_ManualIsMeasuredFromTheNearPlane) {
  CameraView view;
  view.near = 0.5;
  const auto range = depthRangeOf(view, receiversBetween(1, 2), manualRange(2, 30));
  ASSERT_TRUE(range);
  EXPECT_DOUBLE_EQ(range->covered.near, 2.5);
  EXPECT_DOUBLE_EQ(range->covered.far, 30.5);
}

TEST(DepthRange, X18_APlaneThatFacesTheCameraGetsARangeWithALength) {
  for (const float depth : {1e-3f, 1.0f, 7.0f, 1e6f}) {
    const auto range = depthRangeOf(CameraView{}, receiversBetween(depth, depth), {});
    ASSERT_TRUE(range);
    EXPECT_LT(range->covered.near, depth);
    EXPECT_GT(range->covered.far, depth);
    EXPECT_LT(range->covered.far - range->covered.near, 1e-4 * depth);
  }
  CameraView orthographic;
  orthographic.perspective = false;
  orthographic.near = -10;
  orthographic.far = 10;
  for (const float depth : {-3.0f, 0.0f}) {
    const auto range = depthRangeOf(orthographic, receiversBetween(depth, depth), {});
    EXPECT_LT(range->covered.near, depth);
    EXPECT_GT(range->covered.far, depth);
  }
}

TEST(DepthRange, X21_AManualRangeTooThinForFloatsIsWidened) {
  CameraView view;
  view.near = 1000;
  const auto range = depthRangeOf(view, receiversBetween(1, 2), manualRange(0, 1e-300));
  EXPECT_GT(range->covered.far, range->covered.near);
  EXPECT_LT(range->covered.far - range->covered.near, 0.1);
}

using ::testing::DoubleNear;
using ::testing::ElementsAre;

Partition logarithmic(double pssmFactor) {
  Partition partition;
  partition.mode = PartitionMode::logarithmic;
  partition.pssmFactor = pssmFactor;
  return partition;
}

Partition manual(std::vector<double> fractions) {
  Partition partition;
  partition.mode = PartitionMode::manual;
  partition.splits = std::move(fractions);
  return partition;
}

TEST(Splits, X16_ManualFractionsAreOfTheRangeFromItsMinimum) {
  EXPECT_THAT(splitDistances(manual({0.05, 0.15, 0.5, 1}), 4, {20, 50}),
              ElementsAre(20, DoubleNear(21.5, 1e-12), DoubleNear(24.5, 1e-12), DoubleNear(35, 1e-12), 50));
}

TEST(Splits, X16_OneManualCascadeCoversItsFraction) {
  EXPECT_THAT(splitDistances(manual({1}), 1, {20, 50}), ElementsAre(20, 50));
  EXPECT_THAT(splitDistances(manual({0.5}), 1, {20, 50}), ElementsAre(20, 35));
}

TEST(Splits, X17_LogarithmicSplitsAreHalfwayToUniform) {
  EXPECT_THAT(
      splitDistances(logarithmic(0.5), 4, {0.1, 50.1}),
      ElementsAre(0.1, DoubleNear(6.5366, 0.0001), DoubleNear(13.6692, 0.0001), DoubleNear(24.0948, 0.0001), 50.1));
}

TEST(Splits, X17_PssmFactorZeroIsLogarithmicAndOneIsUniform) {
  EXPECT_THAT(splitDistances(logarithmic(0), 3, {1, 1000}),
              ElementsAre(1, DoubleNear(10, 1e-12), DoubleNear(100, 1e-12), 1000));
  EXPECT_THAT(splitDistances(logarithmic(1), 3, {1, 4}), ElementsAre(1, DoubleNear(2, 1e-12), DoubleNear(3, 1e-12), 4));
  Partition uniform;
  uniform.mode = PartitionMode::uniform;
  EXPECT_THAT(splitDistances(uniform, 3, {1, 4}), ElementsAre(1, DoubleNear(2, 1e-12), DoubleNear(3, 1e-12), 4));
}

TEST(Splits, M11_LinearSplitsOfTheArticle) {
  EXPECT_THAT(splitDistances(manual({0.2, 0.5, 1}), 3, {0.5, 10}),
              ElementsAre(0.5, DoubleNear(2.4, 1e-12), DoubleNear(5.25, 1e-12), 10));
}

TEST(Splits, X15_X17_ARangeThatReachesBehindTheEyeStaysFiniteAndIncreasing) {
  for (const double near : {0.0, -1e-9, -5.0, -1000.0}) {
    for (const double length : {1e-3, 1.0, 5.0, 1e4}) {
      for (const double factor : {0.0, 0.5, 1.0}) {
        const auto splits = splitDistances(logarithmic(factor), 4, {near, near + length});
        ASSERT_EQ(splits.size(), 5u);
        EXPECT_EQ(splits.front(), near);
        EXPECT_EQ(splits.back(), near + length);
        for (std::size_t i = 1; i < 5; ++i) EXPECT_GT(splits[i], splits[i - 1]) << near << ' ' << length;
      }
    }
  }
}

TEST(Splits, X16_X17_IncreaseFromTheRangesStartToItsEnd) {
  EXPECT_TRUE(rc::check([](unsigned seed) {
    Dice dice(seed);
    const Shadow shadow = randomShadow(dice);
    const double near = dice.chance(0.3) ? dice.between(-100, 0) : std::pow(10, dice.between(-3, 4));
    const DepthInterval range{near, near + std::max(1e-5 * std::abs(near), std::pow(10, dice.between(-6, 6)))};
    const auto splits = splitDistances(shadow.partition, shadow.cascadeCount, range);
    RC_ASSERT(splits.size() == static_cast<std::size_t>(shadow.cascadeCount) + 1);
    RC_ASSERT(splits.front() == range.near);
    for (std::size_t i = 1; i < splits.size(); ++i) RC_ASSERT(splits[i] > splits[i - 1]);
    const bool whole = shadow.partition.mode != PartitionMode::manual || shadow.partition.splits.back() == 1.0;
    RC_ASSERT((whole ? splits.back() == range.far : splits.back() < range.far));
  }));
}

TEST(Intervals, X22_BlendZonesAreTheLastFifthOfEachCascadesOwnInterval) {
  const auto intervals = cascadeIntervals({20, 21.5, 24.5, 35, 50}, true, false);
  ASSERT_EQ(intervals.size(), 4u);
  EXPECT_DOUBLE_EQ(intervals[0].near, 20);
  EXPECT_DOUBLE_EQ(intervals[0].blendNear, 21.2); // not 21.06, as from an interval that began at 0
  EXPECT_DOUBLE_EQ(intervals[0].far, 21.5);
  EXPECT_DOUBLE_EQ(intervals[1].near, 21.2); // fitted from where the blend begins
  EXPECT_DOUBLE_EQ(intervals[1].blendNear, 23.9);
  EXPECT_DOUBLE_EQ(intervals[3].near, 32.9);
  EXPECT_DOUBLE_EQ(intervals[3].blendNear, 50); // nothing to fade into
}

TEST(Intervals, X22_WithoutBlendingCascadesMeetAtTheirSplits) {
  for (const CascadeInterval& interval : cascadeIntervals({1, 2, 4}, false, false)) {
    EXPECT_EQ(interval.blendNear, interval.far);
  }
  EXPECT_EQ(cascadeIntervals({1, 2, 4}, false, false)[1].near, 2);
}

TEST(Intervals, X23_TheLastCascadeFadesOverItsLastFifth) {
  EXPECT_DOUBLE_EQ(cascadeIntervals({1, 2, 12}, false, true)[1].blendNear, 10);
  EXPECT_DOUBLE_EQ(cascadeIntervals({0, 10}, true, true)[0].blendNear, 8);
}

} // namespace
} // namespace gnomon
