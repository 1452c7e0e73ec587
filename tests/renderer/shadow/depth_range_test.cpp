#include "renderer/shadow/depth_range.h"

#include <cmath>
#include <gtest/gtest.h>

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
  DepthRange defaults;
  defaults.mode = DepthRangeMode::manual;
  EXPECT_DOUBLE_EQ(depthRangeOf(view, receiversBetween(1, 2), defaults)->covered.near, 0.5);
  EXPECT_DOUBLE_EQ(depthRangeOf(view, receiversBetween(1, 2), defaults)->covered.far, 50.5);
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

} // namespace
} // namespace gnomon
