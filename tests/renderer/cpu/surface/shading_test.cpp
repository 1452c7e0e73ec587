#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/prepare/draw_list.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/surface/made_scene.h"

namespace gnomon::cpu {
namespace {

std::vector<shared::LightData> threeLights(const CameraView& view) {
  std::vector<shared::LightData> lights(3);
  for (shared::LightData& light : lights) light.litGroups = ~0u;
  lights[0].type = GNOMON_DIRECTIONAL;
  lights[0].direction = glm::normalize(glm::vec3(1, 2, -1));
  lights[0].radiance = {1, 0.9f, 0.8f};
  lights[0].litGroups = 0b101u;
  lights[1].type = GNOMON_POINT;
  lights[1].position = glm::vec3(view.forward * 15.0);
  lights[1].radiance = {20, 30, 40};
  lights[1].range = 30;
  lights[2].type = GNOMON_SPOT;
  lights[2].position = glm::vec3(view.forward * 2.0);
  lights[2].direction = glm::vec3(view.forward);
  lights[2].radiance = {100, 90, 110};
  lights[2].coneScale = 5;
  lights[2].coneOffset = -4;
  return lights;
}

/// The picture of a surface (a row of surfacesByLanes) under lights of which it is asked, of odd ones a quarter.
glm::vec3 pictureOf(const FrameScene& scene, const LightInput& lights, const NumberTable& surface, std::size_t row,
                    std::span<const std::uint32_t> asked) {
  glm::vec3 radiance = surface.triple(row, kEmission);
  if (surface.at(row, kUnlit) != 1.0f) {
    const glm::vec3 relative = surface.triple(row, kRelative);
    const auto point =
        shared::surfacePoint(surface.triple(row, kBaseColor), surface.at(row, kMetallic), surface.at(row, kRoughness),
                             surface.triple(row, kNormal), -glm::normalize(relative));
    radiance += scene.frame.ambient * shared::ambientReflected(point) * surface.at(row, kOcclusion);
    for (const std::uint32_t light : asked) {
      if ((lights.lights[light].litGroups & static_cast<std::uint32_t>(surface.at(row, kGroupBit))) == 0) continue;
      glm::vec3 toLight;
      const glm::vec3 arriving = shared::irradiance(lights.lights[light], relative, toLight);
      radiance += shared::reflectedRadiance(point, toLight) * arriving * (light % 2 == 0 ? 1.0f : 0.25f);
    }
  }
  const glm::vec3 exposed = radiance * scene.frame.exposureScale;
  return lights.encoded ? shared::acesToneMapped(exposed) : exposed;
}

class CpuShading : public testing::Test {
 protected:
  CpuShading() : made_(true), seen_(seen()), in_(made_.fragmentsOf(seen_)) {}

  std::vector<MadeScene::Seen> seen() {
    std::vector<Material> materials(4);
    materials[0].metallicFactor = 0.0f;
    materials[1].metallicFactor = 0.5f;
    materials[1].roughnessFactor = 0.5f;
    materials[2].emissiveFactor = {0.1f, 0.2f, 0.3f};
    materials[3].unlit = true;
    made_.place(materials);
    return made_.seen(9600);
  }

  /// `askedAt(row)`: the lights that the list of a place names.
  template <class AskedAt>
  void expectTruth(const LightInput& lights, const AskedAt& askedAt) {
    onEachInstructionSet([&] {
      const NumberTable surface = surfacesByLanes(made_.frameScene(), in_);
      const NumberTable out = picturesByLanes(made_.frameScene(), lights, in_);
      float largest = 0;
      for (std::size_t row = 0; row < out.rows; ++row) {
        const glm::vec3 expected = pictureOf(made_.frameScene(), lights, surface, row, askedAt(row));
        const float off = glm::length(out.triple(row, 0) - expected) / (1.0f + glm::length(expected));
        if (!(off <= largest)) largest = off; // not a number counts
      }
      EXPECT_LT(largest, 2e-4f);
    });
  }

  MadeScene made_;
  std::vector<MadeScene::Seen> seen_;
  FragmentInput in_;
};

constexpr std::array<std::uint32_t, 3> kAll{0, 1, 2};

TEST_F(CpuShading, SumsTheLightsThatReachASurfacesGroup) {
  const auto lights = threeLights(made_.view());
  for (const bool encoded : {true, false}) {
    expectTruth({lights, {}, encoded}, [](std::size_t) { return std::span<const std::uint32_t>(kAll); });
  }
}

TEST_F(CpuShading, AsksTheLightsOfEachSquaresList) {
  const auto lights = threeLights(made_.view());
  // Squares have one light each, by their number.
  const int columns = (made_.frameScene().width + GNOMON_REGION_SIZE - 1) / GNOMON_REGION_SIZE;
  const int rows = (made_.frameScene().height + GNOMON_REGION_SIZE - 1) / GNOMON_REGION_SIZE;
  const auto squares = static_cast<std::uint32_t>(columns * rows);
  std::vector<std::uint32_t> lists;
  for (std::uint32_t square = 0; square < squares; ++square) {
    lists.push_back(2 * squares + square % 3);
    lists.push_back(2 * squares + square % 3 + 1);
  }
  lists.insert(lists.end(), kAll.begin(), kAll.end());
  expectTruth({lights, lists, false}, [&](std::size_t row) {
    const int fromTop = made_.frameScene().height - 1 - static_cast<int>(in_.y[row]);
    const int square = fromTop / GNOMON_REGION_SIZE * columns + static_cast<int>(in_.x[row]) / GNOMON_REGION_SIZE;
    return std::span(kAll).subspan(static_cast<std::size_t>(square) % 3, 1);
  });
}

} // namespace
} // namespace gnomon::cpu
