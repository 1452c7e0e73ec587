#include <gtest/gtest.h>

#include "renderer/resolve/plan_input.h"

namespace gnomon {
namespace {

/// The lights that get a map in a frame with a sun of that technique and these views.
std::vector<int> mapped(ShadowTechnique technique, std::vector<View> views, double degrees = 0) {
  ResolvedFrame frame;
  frame.spec.views = std::move(views);
  Light sun;
  sun.angularDiameterDegrees = degrees;
  sun.shadow = Shadow{};
  sun.shadow->technique = technique;
  frame.spec.lights = {sun};
  return mappedLights(frame);
}

TEST(HybridMaps, AreDrawnWhereAViewShowsThem) {
  for (const double degrees : {0.0, 0.53}) {
    EXPECT_EQ(mapped(ShadowTechnique::hybrid, {View::color, View::depth}, degrees), std::vector<int>{});
    EXPECT_EQ(mapped(ShadowTechnique::hybrid, {View::color, View::cascades}, degrees), std::vector{0});
    EXPECT_EQ(mapped(ShadowTechnique::hybrid, {View::tile}, degrees), std::vector{0});
  }
}

TEST(HybridMaps, OthersAreDrawnWhateverIsShown) {
  EXPECT_EQ(mapped(ShadowTechnique::shadowMap, {View::color}), std::vector{0});
  EXPECT_EQ(mapped(ShadowTechnique::rayTraced, {View::tile}), std::vector<int>{});
}

} // namespace
} // namespace gnomon
