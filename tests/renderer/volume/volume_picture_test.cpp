#include "renderer/volume/volume_picture.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/volume/volume_space.h"
#include "tests/renderer/volume/media.h"

namespace gnomon {
namespace {

constexpr int kWidth = 31, kHeight = 17;
constexpr std::array kMiddle{glm::vec2(0.5f)};
constexpr float kNothing = std::numeric_limits<float>::infinity();

/// A box in the light of a sun overhead, and its map.
struct LitBox {
  Medium medium;
  VolumeLight map;

  LitBox(const glm::dvec3& low, const glm::dvec3& high, double sigma)
      : medium(homogeneous(boxSpace(low, high), sigma)) {
    const Medium* media[]{&medium};
    const ArrivalAt lights[]{[](std::size_t, const glm::dvec3&) {
      return Arrival{.towards = {0, 1, 0}, .irradiance = glm::dvec3(3.141592653589793)};
    }};
    map = makeVolumeLight({.media = media, .lights = lights, .towards = glm::dvec3(0, 1, 0), .size = {2, 33, 2}});
  }
};

CameraView cameraAt(const glm::dvec3& eye, bool perspective) {
  CameraView view;
  view.eye = eye;
  view.perspective = perspective;
  view.halfSize = perspective ? glm::dvec2(0.8, 0.45) : glm::dvec2(8, 4.5);
  view.near = perspective ? 0.5 : -5;
  view.far = perspective ? kInfinite : 60;
  return view;
}

TEST(VolumePicture, D7_SurfacesInFrontInsideAndBehindCutEachPixelsRay) {
  const LitBox box({-4, -3, -20}, {4, 3, -10}, 0.2);
  const MappedMedium media[]{{&box.medium, &box.map}};
  for (const bool perspective : {true, false}) {
    for (const double eyeZ : {0.0, -12.0}) { // before the box, and inside it
      for (const float depth : {2.0f, 7.0f, 14.0f, 40.0f, kNothing}) {
        const std::vector<float> depths(kWidth * kHeight, depth);
        const SeenSurfaces seen{cameraAt({0, 0, eyeZ}, perspective), kWidth, kHeight, kMiddle, depths};
        const auto picture = marchPicture(seen, media, glm::dvec3(0));
        ASSERT_EQ(picture.size(), depths.size());
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const ViewRay ray = viewRayAt(seen.view, {(2 * x + 1.0) / kWidth - 1, (2 * y + 1.0) / kHeight - 1});
            const auto line = insideUnitCube(toUnit(box.medium.space, ray.ray));
            const double end = std::min(ray.seen.to, depth * ray.metresPerDepth);
            const double length =
                line ? std::max(0.0, std::min(line->to, end) - std::max(line->from, ray.seen.from)) : 0;
            ASSERT_NEAR(picture[static_cast<std::size_t>(y * kWidth + x)].a, std::exp(-0.2 * length), 1e-5)
                << perspective << eyeZ << ' ' << depth << " at " << x << ' ' << y;
          }
        }
      }
    }
  }
}

TEST(VolumePicture, AWhiteMediumIsAsBrightAsAWhiteSurfaceInTheSameLight) {
  const LitBox dense({-4, -3, -20}, {4, 3, -10}, 1e-3);
  Medium opaque = dense.medium;
  opaque.function = *makeTransferFunction({{0, {glm::dvec3(1), 50}}});
  const MappedMedium media[]{{&opaque, &dense.map}};
  const std::vector<float> depths(kWidth * kHeight, kNothing);
  const SeenSurfaces seen{cameraAt({0, 0, 0}, true), kWidth, kHeight, kMiddle, depths};
  const auto picture = marchPicture(seen, media, glm::dvec3(0.25));
  const glm::vec4 middle = picture[kWidth * (kHeight / 2) + kWidth / 2];
  EXPECT_NEAR(middle.r, 1 + 0.25, 0.01);
  EXPECT_EQ(middle.a, 0);
  EXPECT_EQ(picture[0], glm::vec4(0, 0, 0, 1)); // beside the box
}

TEST(VolumePicture, D6_OnlySurfacesBehindTheVolumeAreInItsShadow) {
  // A wall that faces the camera, from below the box to above it.
  const LitBox box({-2, -1, -12}, {2, 1, -8}, 0.5);
  const MappedMedium media[]{{&box.medium, &box.map}};
  std::vector<float> depths(kWidth * kHeight, 10.0f);
  depths[0] = kNothing;
  const SeenSurfaces seen{cameraAt({0, 0, 0}, false), kWidth, kHeight, kMiddle, depths};
  const auto shadows = volumeShadowPicture(seen, media, {0, 1, 0});
  EXPECT_EQ(shadows[0], 65535);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 1; x < kWidth; ++x) {
      const glm::dvec2 place((2 * x + 1.0) / kWidth * 8 - 8, (2 * y + 1.0) / kHeight * 4.5 - 4.5);
      const double above = std::abs(place.x) > 2 ? 0 : std::clamp(1 - place.y, 0.0, 2.0);
      ASSERT_NEAR(shadows[static_cast<std::size_t>(y * kWidth + x)] / 65535.0, std::exp(-0.5 * above), 1e-3)
          << x << ' ' << y;
    }
  }
}

TEST(VolumePicture, SamplesOfAPixelHaveTheirOwnDepths) {
  const LitBox box({-4, -3, -20}, {4, 3, -10}, 0.2);
  const MappedMedium media[]{{&box.medium, &box.map}};
  const std::array<glm::vec2, 4> places{{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
  const std::vector<float> depths{5.0f, 5.01f, 15.0f, kNothing};
  CameraView view = cameraAt({0, 0, 0}, false);
  view.halfSize = glm::dvec2(1e-3);
  const auto picture = marchPicture({view, 1, 1, places, depths}, media, glm::dvec3(0));
  EXPECT_NEAR(picture[0].a, (1 + 1 + std::exp(-0.2 * 5) + std::exp(-0.2 * 10)) / 4, 1e-5);
  const auto shadows = volumeShadowPicture({view, 1, 1, places, depths}, media, {0, 1, 0});
  EXPECT_EQ(shadows[0], 65535);
  EXPECT_EQ(shadows[1], 65535);
  EXPECT_NEAR(shadows[2] / 65535.0, std::exp(-0.2 * 3), 1e-3);
  EXPECT_EQ(shadows[3], 65535);
}

TEST(VolumePicture, DepthsThatEachDifferLittleFromTheNextAreOne) {
  const LitBox box({-4, -3, -20}, {4, 3, -10}, 0.2);
  const MappedMedium media[]{{&box.medium, &box.map}};
  const std::array<glm::vec2, 4> places{{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
  const std::vector<float> depths{15.0f, 15.12f, 15.24f, 15.36f};
  CameraView view = cameraAt({0, 0, 0}, false);
  view.halfSize = glm::dvec2(1e-3);
  const auto picture = marchPicture({view, 1, 1, places, depths}, media, glm::dvec3(0));
  EXPECT_NEAR(picture[0].a, std::exp(-0.2 * 5.2), 0.02);
}

} // namespace
} // namespace gnomon
