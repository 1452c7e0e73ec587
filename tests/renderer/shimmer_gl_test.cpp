// Shadows hold still on surfaces while a camera moves by less than a texel.
#include <cmath>

#include "tests/renderer/frame_fixture.h"
#include "tests/support/moved_scene.h"

namespace gnomon {
namespace {

using Place = std::array<double, 3>;

/// A camera's way: where it starts, and what eye and target move by a frame.
struct Way {
  Place eye;
  Place target;
  Place eyeStep;
  Place targetStep;
  int frames = 16;
};

Json placed(const Place& from, const Place& step, int times, const Place& root) {
  Json place = Json::array();
  for (std::size_t i = 0; i < 3; ++i) place.push_back(root[i] + from[i] + times * step[i]);
  return place;
}

FrameSpec decoded(const Json& json) {
  auto spec = decodeFrameSpec(testing::withMaps(json).dump());
  EXPECT_TRUE(spec) << spec.problems().front().pointer << ' ' << spec.problems().front().detail;
  return spec ? *spec : FrameSpec{};
}

Result<Shimmer> along(const ScenePtr& scene, Json json, const Way& way, const Place& root = {0, 0, 0}) {
  json["width"] = 320;
  json["height"] = 180;
  std::vector<Camera> path;
  for (int i = 0; i < way.frames; ++i) {
    json["camera"] = {{"eye", placed(way.eye, way.eyeStep, i, root)},
                      {"target", placed(way.target, way.targetStep, i, root)},
                      {"perspective", {{"fovYDegrees", 50}, {"near", 0.1}}}};
    path.push_back(decoded(json).camera);
  }
  return testing::sharedRenderer().shimmer(scene, decoded(json), path);
}

Shimmer measured(const ScenePtr& scene, const Json& json, const Way& way, const Place& root = {0, 0, 0}) {
  const auto shimmer = along(scene, json, way, root);
  EXPECT_TRUE(shimmer) << shimmer.problems().front().detail;
  return shimmer ? *shimmer : Shimmer{};
}

Json sunned(const std::string& stabilization, const std::string& filter, int cascades) {
  return {{"lights", {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 135}, {"elevationDegrees", 45}}}}}},
          {"shadow",
           {{"stabilization", stabilization},
            {"filter", {{"type", filter}}},
            {"cascadeCount", cascades},
            {"depthRange", {{"mode", "manual"}, {"min", 0}, {"max", 60}}}}}};
}

// Across the view no point changes its depth, so that each keeps its cascade.
const Way kAcross{{0, 3, 4}, {0, 3, -20}, {0.0037, 0, 0}, {0.0037, 0, 0}};
const Way kDiagonal{{0, 3, 4}, {0, 3, -20}, {0.0029, 0.0017, 0}, {0.0029, 0.0017, 0}};
const Way kForwards{{0, 3, 4}, {0, 2.2, -20}, {0.0011, 0.0007, -0.0031}, {0.0011, 0.0007, -0.0031}};
const Way kTurning{{0, 3, 4}, {0, 2.2, -20}, {0.0003, 0, 0}, {0.011, 0.003, 0}};

constexpr const char* kSnapped[] = {"projectionSnapping", "viewSnapping"};

TEST(Shimmer, H6_X24_SnappedCascadesHoldStillWhileTheCameraMovesAcross) {
  const ScenePtr scene = testing::generatedScene("long_row");
  for (const char* stabilization : kSnapped) {
    for (const char* filter : {"hard", "pcf"}) {
      for (const Way& way : {kAcross, kDiagonal}) {
        const Shimmer shimmer = measured(scene, sunned(stabilization, filter, 4), way);
        EXPECT_GT(shimmer.points, 1000u);
        EXPECT_EQ(shimmer.flips, 0u) << stabilization << ", " << filter;
      }
    }
  }
}

TEST(Shimmer, H6_X24_OneSnappedCascadeHoldsStillWhereverTheCameraGoesOrTurns) {
  for (const char* name : {"long_row", "tilted_planes", "thin_slats"}) {
    const ScenePtr scene = testing::generatedScene(name);
    for (const char* stabilization : kSnapped) {
      for (const Way& way : {kForwards, kTurning}) {
        const Shimmer shimmer = measured(scene, sunned(stabilization, "hard", 1), way);
        EXPECT_GT(shimmer.points, 500u) << name;
        EXPECT_EQ(shimmer.flips, 0u) << name << ", " << stabilization;
      }
    }
  }
}

TEST(Shimmer, H6_H12_NothingFlipsAMillionMetresAwayEither) {
  const Place root{1e6, 1e5, -1e6};
  const ScenePtr scene = testing::sceneOf(testing::movedBy(testing::generatedGlb("long_row"), root));
  for (const char* stabilization : kSnapped) {
    EXPECT_EQ(measured(scene, sunned(stabilization, "hard", 4), kDiagonal, root).flips, 0u) << stabilization;
    EXPECT_EQ(measured(scene, sunned(stabilization, "hard", 1), kForwards, root).flips, 0u) << stabilization;
  }
}

TEST(Shimmer, H6_X20_ARangeHeldFromFrameToFrameHoldsShadowsStill) {
  Json spec = sunned("projectionSnapping", "hard", 4);
  spec["shadow"]["depthRange"] = {{"previous", {{"near", 2}, {"far", 130}}}, {"guardDistance", 1}};
  EXPECT_EQ(measured(testing::generatedScene("long_row"), spec, kDiagonal).flips, 0u);
}

TEST(Shimmer, H6_FacesHoldStillInTheLightOfSpotsAndPoints) {
  const ScenePtr scene = testing::generatedScene("long_row");
  for (const char* light : {R"({"type":"point","position":[0.4,5.5,-9.7],"intensity":200})",
                            R"({"type":"spot","position":[2,8,2],"direction":[-2,-5,-12],"intensity":900})"}) {
    Json spec = sunned("projectionSnapping", "hard", 1);
    spec["lights"] = {Json::parse(light)};
    const Shimmer shimmer = measured(scene, spec, kForwards);
    EXPECT_GT(shimmer.points, 300u);
    EXPECT_EQ(shimmer.flips, 0u) << light;
  }
}

/// The lens widens by a quarter of a percent a frame.
Shimmer zoomed(const Json& light, double fovYDegrees) {
  Json json = light;
  json["width"] = 320;
  json["height"] = 180;
  std::vector<Camera> path;
  for (int i = 0; i < 12; ++i) {
    json["camera"] = {{"eye", {0, 3, 4}},
                      {"target", {0, 2.2, -20}},
                      {"perspective", {{"fovYDegrees", fovYDegrees * std::pow(1.0025, i)}, {"near", 0.1}}}};
    path.push_back(decoded(json).camera);
  }
  const auto shimmer = testing::sharedRenderer().shimmer(testing::generatedScene("long_row"), decoded(json), path);
  EXPECT_TRUE(shimmer) << shimmer.problems().front().detail;
  return shimmer ? *shimmer : Shimmer{};
}

TEST(Shimmer, H6_X24_SnappedCascadesHoldStillWhileTheLensZooms) {
  for (const char* stabilization : kSnapped) {
    for (const double fov : {40.0, 50.0, 62.0}) {
      const Shimmer shimmer = zoomed(sunned(stabilization, "hard", 4), fov);
      EXPECT_GT(shimmer.points, 500u);
      EXPECT_EQ(shimmer.flips, 0u) << stabilization << fov;
    }
  }
  EXPECT_GT(zoomed(sunned("none", "hard", 4), 40).flips, 0u);
}

TEST(Shimmer, H6_TightCascadesShimmer) {
  const ScenePtr scene = testing::generatedScene("long_row");
  const Shimmer shimmer = measured(scene, sunned("none", "hard", 1), kForwards);
  EXPECT_GT(shimmer.perThousand(), 0.5);
  Json automatic = sunned("projectionSnapping", "hard", 4);
  automatic["shadow"].erase("depthRange");
  EXPECT_GT(measured(scene, automatic, kForwards).perThousand(), 0.5) << "the range is each frame's own";
}

TEST(Shimmer, H6_WhatIsTracedIsTheSameForAPointFromEverywhere) {
  Json spec = sunned("none", "hard", 1);
  spec["shadow"]["technique"] = "rayTraced";
  const Shimmer shimmer = measured(testing::generatedScene("long_row"), spec, kForwards);
  EXPECT_GT(shimmer.points, 1000u);
  EXPECT_EQ(shimmer.flips, 0u);
}

TEST(Shimmer, H6_LightsWhoseShadowsDoNotShowAreNotWatched) {
  const ScenePtr scene = testing::generatedScene("long_row");
  const Json faint = Json::parse(
      R"({"type":"point","position":[0.4,5.5,-9.7],"intensity":200,"shadow":{"strength":0.2,"size":"Small"}})");
  Json spec = sunned("projectionSnapping", "hard", 1);
  const std::size_t ofTheSun = measured(scene, spec, kForwards).points;
  spec["lights"].push_back(faint);
  EXPECT_GT(measured(scene, spec, kForwards).points, ofTheSun) << "a faint shadow counts as a full one does";
  spec["lights"][1]["shadow"]["strength"] = 0;
  EXPECT_EQ(measured(scene, spec, kForwards).points, ofTheSun);
}

TEST(Shimmer, H6_APathWithNothingToWatchIsAProblem) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  const Way away{{0, 30, 0}, {0, 60, 1}, {0, 0, 0}, {0, 0, 0}, 2};
  const auto nothing = along(scene, sunned("none", "hard", 1), away);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.problems().front().pointer, "/path");
  Way still = kAcross;
  still.frames = 1;
  const auto one = along(scene, sunned("none", "hard", 1), still);
  ASSERT_FALSE(one);
  EXPECT_EQ(one.problems().front().limit, "at least 2");
  for (const auto& [key, value] : {std::pair<const char*, Json>{"enabled", false}, {"strength", 0}}) {
    Json off = sunned("none", "hard", 1);
    off["shadow"][key] = value;
    const auto dark = along(scene, off, kAcross);
    ASSERT_FALSE(dark) << key;
    EXPECT_NE(dark.problems().front().detail.find("No light"), std::string::npos) << key;
  }
}

} // namespace
} // namespace gnomon
