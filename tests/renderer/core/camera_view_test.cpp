#include "renderer/core/camera_view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <tuple>

#include "tests/renderer/core/random_view.h"

namespace gnomon {
namespace {

CameraView perspectiveView(double fovYDegrees, double near, double far) {
  CameraView view;
  const double tangent = std::tan(glm::radians(fovYDegrees) / 2);
  view.halfSize = {tangent * 16 / 9, tangent};
  view.near = near;
  view.far = far;
  return view;
}

glm::dvec3 projected(const CameraView& view, const glm::dvec3& point) {
  const glm::dvec4 clip = clipFromView(view) * viewFromRelative(view) * glm::dvec4(point, 1.0);
  return glm::dvec3(clip) / clip.w;
}

using FovAndFar = std::tuple<double, double>;
class ReversedDepth : public testing::TestWithParam<FovAndFar> {};

TEST_P(ReversedDepth, G5_IsOneAtNearAndZeroAtFar) {
  const auto [fov, far] = GetParam();
  const CameraView view = perspectiveView(fov, 0.25, far);
  EXPECT_DOUBLE_EQ(projected(view, pointAt(view, {0.3, -0.8}, 0.25)).z, 1.0);
  if (std::isinf(far)) {
    EXPECT_EQ((clipFromView(view) * glm::dvec4(0, 0, -1, 0)).z, 0.0); // a direction is a point at infinity
    EXPECT_NEAR(projected(view, pointAt(view, {0.3, -0.8}, 1e12)).z, 0.0, 1e-12);
  } else {
    EXPECT_NEAR(projected(view, pointAt(view, {0.3, -0.8}, far)).z, 0.0, 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(Lenses, ReversedDepth,
                         testing::Combine(testing::Values(1.0, 45.0, 170.0),
                                          testing::Values(0.5, 1000.0, std::numeric_limits<double>::infinity())));

TEST(CameraView, G5_OrthographicNearMayBeNegative) {
  CameraView view;
  view.perspective = false;
  view.halfSize = {8, 4.5};
  view.near = -20;
  view.far = 30;
  EXPECT_DOUBLE_EQ(projected(view, pointAt(view, {1, 1}, -20)).z, 1.0);
  EXPECT_DOUBLE_EQ(projected(view, pointAt(view, {-1, 1}, 30)).z, 0.0);
  EXPECT_DOUBLE_EQ(projected(view, pointAt(view, {0, 0}, 5)).z, 0.5);
  EXPECT_EQ(pointAt(view, {1, -1}, -20), glm::dvec3(8, -4.5, 20));
}

TEST(CameraView, PointAtIsTheInverseOfTheMatrices) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& x, const RandomUnit& y, const RandomUnit& d) {
    const CameraView& view = random.view;
    const double far = std::min(view.far, view.near + 1000.0);
    const double depth = view.near + d.value * (far - view.near);
    const glm::dvec2 ndc(2 * x.value - 1, 2 * y.value - 1);
    const glm::dvec3 found = projected(view, pointAt(view, ndc, depth));
    RC_ASSERT(std::abs(found.x - ndc.x) < 1e-9);
    RC_ASSERT(std::abs(found.y - ndc.y) < 1e-9);
    RC_ASSERT(found.z > -1e-9 && found.z < 1 + 1e-9);
  }));
}

TEST(CameraView, NdcOfIsTheInverseOfPointAt) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& x, const RandomUnit& y, const RandomUnit& d) {
    const CameraView& view = random.view;
    const double far = std::min(view.far, view.near + 1000.0);
    const glm::dvec2 ndc(4 * x.value - 2, 4 * y.value - 2); // beside the picture, too
    const glm::dvec2 found = ndcOf(view, pointAt(view, ndc, view.near + d.value * (far - view.near)));
    RC_ASSERT(std::abs(found.x - ndc.x) < 1e-9);
    RC_ASSERT(std::abs(found.y - ndc.y) < 1e-9);
  }));
}

TEST(CameraView, AnOffCentreViewIsTheCropOfACentredOne) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& x, const RandomUnit& y) {
    CameraView whole = random.view;
    whole.perspective = true;
    whole.center = {0, 0};
    whole.near = 1;
    whole.far = 100;
    CameraView quarter = whole; // the upper left one
    quarter.halfSize = 0.5 * whole.halfSize;
    quarter.center = glm::dvec2(-0.5, 0.5) * whole.halfSize;
    const glm::dvec2 ndc(2 * x.value - 1, 2 * y.value - 1);
    const glm::dvec3 same = pointAt(whole, 0.5 * ndc + glm::dvec2(-0.5, 0.5), 7) - pointAt(quarter, ndc, 7);
    RC_ASSERT(glm::length(same) < 1e-12 * (1 + glm::length(whole.halfSize)));
  }));
}

/// True where the point lies on the inner side of each plane. `margin` is in metres.
bool isInside(const Frustum& frustum, const glm::dvec3& point, double margin) {
  return std::all_of(frustum.planes.begin(), frustum.planes.end(), [&](const glm::dvec4& plane) {
    const glm::dvec3 normal(plane);
    return glm::dot(normal, point) + plane.w >= -margin * glm::length(normal);
  });
}

TEST(Frustum, APointIsInsideWhereThePictureShowsIt) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& x, const RandomUnit& y, const RandomUnit& d) {
    const CameraView& view = random.view;
    const double far = std::min(view.far, view.near + 1000.0);
    const glm::dvec2 ndc(4 * x.value - 2, 4 * y.value - 2);
    const glm::dvec3 point = pointAt(view, ndc, view.near + (1.5 * d.value - 0.25) * (far - view.near));
    const glm::dvec3 clip = projected(view, point);
    const bool shown = glm::dot(point, view.forward) > 0 || !view.perspective
                           ? std::abs(clip.x) <= 1 && std::abs(clip.y) <= 1 && clip.z >= 0 && clip.z <= 1
                           : false;
    const double margin = 1e-9 * (1 + glm::length(point));
    const bool inside = isInside(frustumOf(view), point, shown ? margin : -margin);
    RC_ASSERT(inside == shown);
  }));
}

TEST(Frustum, KeepsABoxThatHoldsAnyPointOfTheView) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& x, const RandomUnit& y, const RandomUnit& size) {
    const CameraView& view = random.view;
    const glm::dvec3 inside = pointAt(view, {2 * x.value - 1, 2 * y.value - 1}, view.near + 1.0);
    Aabb box;
    box.add(inside);
    box.add(inside + glm::dvec3(-1e6 * size.value, 50 * x.value, 3 * y.value));
    box.add(inside - glm::dvec3(1e-6));
    box.add(inside + glm::dvec3(1e-6));
    RC_ASSERT(mayIntersect(frustumOf(view), box));
  }));
}

TEST(Frustum, RejectsWhatLiesBesideBeforeAndBeyond) {
  EXPECT_TRUE(rc::check([](const RandomView& random) {
    const CameraView& view = random.view;
    const Frustum frustum = frustumOf(view);
    const auto boxAt = [&](glm::dvec2 ndc, double depth) {
      Aabb box;
      box.add(pointAt(view, ndc, depth));
      return box;
    };
    const double depth = view.near + 1.0;
    RC_ASSERT(!mayIntersect(frustum, boxAt({1.01, 0}, depth)));
    RC_ASSERT(!mayIntersect(frustum, boxAt({-1.01, 0}, depth)));
    RC_ASSERT(!mayIntersect(frustum, boxAt({0, 1.01}, depth)));
    RC_ASSERT(!mayIntersect(frustum, boxAt({0, -1.01}, depth)));
    RC_ASSERT(!mayIntersect(frustum, boxAt({0, 0}, view.near - 0.01)));
    if (!std::isinf(view.far)) RC_ASSERT(!mayIntersect(frustum, boxAt({0, 0}, view.far + 0.01)));
  }));
}

TEST(Frustum, AnEmptyBoxIsOutside) {
  EXPECT_FALSE(mayIntersect(frustumOf(CameraView{}), Aabb{}));
}

TEST(Frustum, ABoxThatTouchesAPlaneIsKept) {
  CameraView view; // 90 degrees, square
  Aabb box;
  box.add(glm::dvec3(1, 0, -1));
  box.add(glm::dvec3(2, 1, -1));
  EXPECT_TRUE(mayIntersect(frustumOf(view), box));
}

} // namespace
} // namespace gnomon
