#include "renderer/core/frustum.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/renderer/core/random_view.h"

namespace gnomon {
namespace {

TEST(Frustum, HoldsEveryPointOfTheView) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& x, const RandomUnit& y, const RandomUnit& d) {
    const CameraView& view = random.view;
    const double far = std::min(view.far, view.near + 1000.0);
    const double depth = view.near + d.value * (far - view.near);
    Aabb point;
    point.add(pointAt(view, {2 * x.value - 1, 2 * y.value - 1}, depth));
    Aabb around = point;
    const glm::dvec3 slack(1e-9 * (1 + glm::length(point.min)));
    around.min -= slack;
    around.max += slack;
    RC_ASSERT(mayIntersect(frustumOf(view), around));
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
