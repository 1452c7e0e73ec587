#include "renderer/shadow/receiver_pieces.h"

#include <gtest/gtest.h>

#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

TEST(ReceiverPieces, X18_HoldsTheReceiversAndLittleElse) {
  EXPECT_TRUE(rc::check([](const RandomPlan& random) {
    const PlanInput& input = random.input;
    RC_PRE(!input.receivers.range.empty());
    const LightBasis basis = lightBasis(input.casters[0].direction);
    const double nearest = input.receivers.range.nearest;
    const double farthest = input.receivers.range.farthest;
    const Aabb box = boxAround(receiverPieces(input.view, input.receivers, basis, {nearest, farthest, farthest}));

    Aabb corners; // the corners of every block's piece of view, two pixels wider
    const ReceiverDepths& r = input.receivers;
    for (int i = 0; i < r.columns * r.rows; ++i) {
      const DepthSpan& span = r.blocks[static_cast<std::size_t>(i)];
      if (span.empty()) continue;
      const glm::dvec2 first(i % r.columns * 8 - 2, i / r.columns * 8 - 2);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec2 pixel = first + glm::dvec2(corner & 1, corner >> 1 & 1) * 12.0;
        const glm::dvec2 ndc(2 * pixel.x / r.width - 1, 1 - 2 * pixel.y / r.height);
        const double depth = corner & 4 ? span.farthest : span.nearest;
        corners.add(basis.lightFromWorld() * pointAt(input.view, ndc, depth));
      }
    }
    Dice dice(random.seed + 4);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 point = basis.lightFromWorld() * randomReceiver(dice, input).relative;
      for (int axis = 0; axis < 3; ++axis) RC_ASSERT(point[axis] >= box.min[axis] && point[axis] <= box.max[axis]);
    }
    const double slack = 1e-3 * glm::length(corners.max - corners.min) +
                         2 * depthSlack(input.view, std::max(std::abs(nearest), std::abs(farthest))) *
                             (1 + glm::length(input.view.halfSize));
    for (int axis = 0; axis < 3; ++axis) {
      RC_ASSERT(box.min[axis] >= corners.min[axis] - slack && box.max[axis] <= corners.max[axis] + slack);
    }
  }));
}

TEST(ReceiverPieces, X18_ACascadeWithoutSurfacesIsEmpty) {
  const PlanInput input = simplePlan(10, 20);
  const auto box = [&](const CascadeInterval& cascade) {
    return boxAround(receiverPieces(input.view, input.receivers, LightBasis{}, cascade));
  };
  EXPECT_TRUE(box({1, 5, 5}).empty());
  EXPECT_TRUE(box({30, 40, 40}).empty());
  const Aabb middle = box({5, 15, 15});
  // A basis that looks along -Z: light space x and y are the view's, and z is the depth.
  EXPECT_NEAR(middle.min.z, 10, 1e-3);
  EXPECT_NEAR(middle.max.z, 15, 1e-3);
  EXPECT_NEAR(middle.max.x, 15, 0.05);
}

} // namespace
} // namespace gnomon
