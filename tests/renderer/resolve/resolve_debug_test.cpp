#include "renderer/resolve/resolve_debug.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

/// Three lights: the first asks for no shadow, the second got none, the third has tiles, of which 1 was not drawn.
ShadowPlan plan() {
  ShadowPlan made;
  made.atlasWidth = made.atlasHeight = 128;
  made.tiles.resize(3);
  made.tiles[0].rect = {0, 0, 64, 64};
  made.tiles[2].rect = {64, 0, 64, 64};
  PlannedLight refused;
  refused.light = 1;
  refused.note = "no room in the atlas";
  PlannedLight drawn;
  drawn.light = 2;
  drawn.tileCount = 3;
  made.lights = {refused, drawn};
  return made;
}

FrameSpec specOf(View view, std::optional<int> light = std::nullopt, int tile = 0) {
  FrameSpec spec;
  spec.lights = std::vector<Light>(3);
  spec.views = {view};
  spec.debug = {light, tile};
  return spec;
}

Problem refusal(const FrameSpec& spec, const ShadowPlan& plan) {
  const auto subject = debugSubject(spec, plan);
  EXPECT_FALSE(subject) << "was taken";
  return subject ? Problem{} : subject.problems().front();
}

TEST(ResolveDebug, TheFirstLightThatCastsUnlessOneIsNamed) {
  EXPECT_EQ(debugSubject(specOf(View::shadow), plan())->light, 2);
  EXPECT_EQ(debugSubject(specOf(View::shadow, 1), plan())->light, 1);
  EXPECT_EQ(debugSubject(specOf(View::shadow, 0), plan())->planned, nullptr);
}

TEST(ResolveDebug, TheFirstLightWhereNoneCasts) {
  EXPECT_EQ(debugSubject(specOf(View::shadow), ShadowPlan{})->light, 0);
  FrameSpec dark = specOf(View::shadow);
  dark.lights->clear();
  EXPECT_EQ(debugSubject(dark, ShadowPlan{})->light, -1);
}

TEST(ResolveDebug, ATileIsFoundInThePlan) {
  const ShadowPlan planned = plan();
  EXPECT_EQ(debugSubject(specOf(View::tile, 2, 2), planned)->tile, &planned.tiles[2]);
  EXPECT_EQ(debugSubject(specOf(View::color, 2, 2), planned)->tile, nullptr);
}

TEST(ResolveDebug, ATileBeyondTheLightsIsAProblem) {
  const Problem problem = refusal(specOf(View::tile, std::nullopt, 5), plan());
  EXPECT_EQ(problem.pointer, "/debug/tile");
  EXPECT_EQ(problem.limit, "0..2");
  EXPECT_EQ(problem.actual, "5");
  EXPECT_TRUE(debugSubject(specOf(View::color, std::nullopt, 5), plan())) << "only the view tile reads it";
}

TEST(ResolveDebug, ATileThatWasNotDrawnIsAProblem) {
  const Problem problem = refusal(specOf(View::tile, 2, 1), plan());
  EXPECT_EQ(problem.pointer, "/debug/tile");
  EXPECT_EQ(problem.limit, "0, 2");
  EXPECT_EQ(problem.actual, "1");
}

TEST(ResolveDebug, ATileOfALightThatCastsNoShadowIsAProblem) {
  for (const int light : {0, 1}) {
    const Problem problem = refusal(specOf(View::tile, light), plan());
    EXPECT_EQ(problem.pointer, "/debug/light");
    EXPECT_EQ(problem.actual, std::to_string(light));
  }
  EXPECT_NE(refusal(specOf(View::tile, 1), plan()).detail.find("no room"), std::string::npos);
}

TEST(ResolveDebug, WithoutAnAtlasItsViewsAreProblems) {
  for (const View view : {View::atlas, View::tile}) EXPECT_EQ(refusal(specOf(view), ShadowPlan{}).pointer, "/views");
  EXPECT_TRUE(debugSubject(specOf(View::casterIds), ShadowPlan{}));
}

} // namespace
} // namespace gnomon
