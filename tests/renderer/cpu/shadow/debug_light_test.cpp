#include <cmath>

#include "renderer/cpu/shadow/probe.h"
#include "renderer/prepare/draw_list.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/shadow/debug_truth.h"
#include "tests/renderer/cpu/shadow/random_maps.h"
#include "tests/renderer/cpu/shadow/shadow_truth.h"

namespace gnomon::cpu {
namespace {

shared::FrameData frameAlong(const glm::vec3& forward, bool perspective) {
  shared::FrameData frame{};
  const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0.1f, 1, 0.2f)));
  frame.forward = forward;
  frame.perspective = perspective ? 1 : 0;
  frame.right = 0.8f * right;
  frame.up = 0.45f * glm::cross(right, forward);
  frame.pixelStep = {2.0f / 1280, 2.0f / 720};
  return frame;
}

/// A light, a camera, and points before it.
struct DebugScene {
  RandomMaps random;
  ShadowMaps maps;
  shared::FrameData frame;
  std::vector<AskedPoint> points;

  DebugScene(int lightType, bool perspective, bool manualBias) {
    std::mt19937 generator(17);
    random = randomMaps(generator, {.lightType = lightType, .manualBias = manualBias, .fadesOut = true});
    random.lights[0].range = 9;
    random.lights[0].coneScale = 1;
    random.lights[0].coneOffset = 1;
    random.lights[0].litGroups = ~1u;
    maps = random.view();
    frame = frameAlong(randomDirection(generator), perspective);
    points = randomPoints(generator, random, kPoints);
    for (AskedPoint& point : points) {
      point.relative += frame.forward * 9.0f;
      point.viewDepth = glm::dot(point.relative, frame.forward) + 1; // splits come before surfaces
      const shared::LightData& light = random.lights[0];
      point.toLight =
          lightType == GNOMON_DIRECTIONAL ? light.direction : glm::normalize(light.position - point.relative);
      point.normal = glm::normalize(point.normal + point.toLight);
    }
  }
};

/// Numbers that differ by more than a share; where a result jumps with rounding, a few may.
struct Jumps {
  int count = 0;
  void compare(float seen, float expected, float share) {
    if (!(std::abs(seen - expected) <= share * std::max(1.0f, std::abs(expected)))) ++count;
  }
};

template <class Check>
void onEachScene(const Check& check) {
  for (const int type : {GNOMON_DIRECTIONAL, GNOMON_POINT, GNOMON_SPOT}) {
    const bool perspective = type != GNOMON_POINT;
    SCOPED_TRACE("light type " + std::to_string(type));
    check(DebugScene(type, perspective, type == GNOMON_SPOT));
  }
}

TEST(DebugLight, TexelsAndBiasAreWhatTheShadersTextGives) {
  onEachScene([](const DebugScene& scene) {
    const DebugMaps debug{scene.maps, scene.frame};
    for (const View view : {View::texelDensity, View::blendWeight, View::bias}) {
      std::vector<float> expected;
      int found = 0;
      for (const AskedPoint& point : scene.points) {
        const auto texel = truth::debugTexel(debug, point);
        found += texel.has_value();
        expected.push_back(!texel                      ? 0.0f
                           : view == View::blendWeight ? texel->blend
                           : view == View::bias        ? truth::biasMetres(debug, *texel, point)
                                                       : truth::texelDensity(debug, *texel, point));
      }
      EXPECT_GE(found, kPoints / 10);
      onEachInstructionSet([&] {
        std::vector<glm::vec4> numbers(scene.points.size());
        std::vector<glm::vec4> colors(scene.points.size());
        debugDataByLanes(debug, view, false, scene.points, numbers.data());
        debugDataByLanes(debug, view, true, scene.points, colors.data());
        Jumps off;
        Jumps colorsOff;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          off.compare(numbers[i].x, expected[i], 2e-3f);
          ASSERT_EQ(numbers[i].x, numbers[i].w);
          if (view == View::blendWeight) continue;
          const float number = numbers[i].x;
          const float place =
              view == View::bias ? 1.0f + 0.25f * std::log10(std::max(number, 1e-9f)) : 0.5f + std::log2(number) / 8.0f;
          const glm::vec3 color = shared::heat(place) * colors[i].w;
          for (int axis = 0; axis < 3; ++axis) colorsOff.compare(colors[i][axis], color[axis], 2e-3f);
        }
        EXPECT_LE(off.count, kPoints / 1000) << static_cast<int>(view);
        EXPECT_EQ(colorsOff.count, 0) << static_cast<int>(view);
      });
    }
  });
}

TEST(DebugLight, TheGridIsWhatTheShadersTextGives) {
  onEachScene([](const DebugScene& scene) {
    const DebugMaps debug{scene.maps, scene.frame};
    const glm::vec3 shown(0.2f, 0.7f, 0.4f);
    std::vector<glm::vec3> expected;
    for (const AskedPoint& point : scene.points) expected.push_back(truth::texelGrid(debug, shown, point));
    onEachInstructionSet([&] {
      std::vector<glm::vec3> seen(scene.points.size());
      texelGridByLanes(debug, shown, scene.points, seen.data());
      Jumps off;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) off.compare(seen[i][axis], expected[i][axis], 0.02f);
      }
      EXPECT_LE(off.count, kPoints / 200);
    });
  });
}

TEST(DebugLight, CastersAreWhatTheShadersTextGives) {
  onEachScene([](DebugScene scene) {
    std::mt19937 random(3);
    const std::vector<std::int32_t> slotNodes{4, 0, 77, 12};
    std::vector<TileMap> casters(scene.maps.maps.begin(), scene.maps.maps.end());
    for (DepthBuffer& buffer : scene.random.depths) {
      for (std::size_t i = 0; i < buffer.depths.size(); ++i) {
        const auto number = static_cast<std::uint32_t>(random() % (slotNodes.size() * kClusterTriangles));
        buffer.triangles.push_back(buffer.depths[i] < 1 ? number : kNoNumber);
      }
    }
    const DebugMaps debug{scene.maps, scene.frame, casters, slotNodes};
    std::vector<int> expected;
    for (const AskedPoint& point : scene.points) expected.push_back(truth::casterNode(debug, point));
    EXPECT_GE(std::count(expected.begin(), expected.end(), 77), kPoints / 100);
    onEachInstructionSet([&] {
      std::vector<glm::vec4> numbers(scene.points.size());
      std::vector<glm::vec4> colors(scene.points.size());
      debugDataByLanes(debug, View::casterIds, false, scene.points, numbers.data());
      debugDataByLanes(debug, View::casterIds, true, scene.points, colors.data());
      Jumps off;
      Jumps colorsOff;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        off.compare(numbers[i].x, static_cast<float>(expected[i]), 1e-6f);
        const AskedPoint& point = scene.points[i];
        const glm::vec3 toEye = scene.frame.perspective != 0u ? -glm::normalize(point.relative) : -scene.frame.forward;
        const glm::vec3 lit(0.25f + 0.35f * std::abs(glm::dot(point.normal, toEye)));
        const glm::vec3 color = numbers[i].x < 0 ? lit : truth::nodeColor(static_cast<int>(numbers[i].x));
        for (int axis = 0; axis < 3; ++axis) colorsOff.compare(colors[i][axis], color[axis], 1e-4f);
        ASSERT_EQ(colors[i].w, 1.0f);
      }
      EXPECT_LE(off.count, kPoints / 500);
      EXPECT_EQ(colorsOff.count, 0);
    });
  });
}

TEST(MapFootprints, AreWhatTheShadersTextGives) {
  onEachScene([](const DebugScene& scene) {
    const DebugMaps debug{scene.maps, scene.frame};
    std::vector<MapFootprint> expected;
    for (const AskedPoint& point : scene.points) expected.push_back(truth::footprint(debug, point));
    onEachInstructionSet([&] {
      std::vector<MapFootprint> seen(scene.points.size());
      footprintsByLanes(debug, scene.points, seen.data());
      Jumps off;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        for (int axis = 0; axis < 2; ++axis) {
          off.compare(seen[i].shift[axis], expected[i].shift[axis], 5e-3f);
          off.compare(seen[i].texelU[axis], expected[i].texelU[axis], 5e-3f);
          off.compare(seen[i].texelV[axis], expected[i].texelV[axis], 5e-3f);
        }
        off.compare(seen[i].viewDepth, expected[i].viewDepth, 0);
        off.compare(glm::length(seen[i].normal - expected[i].normal), 0, 0);
        off.compare(static_cast<float>(seen[i].tile), static_cast<float>(expected[i].tile), 0);
      }
      EXPECT_LE(off.count, kPoints / 500);
    });
  });
}

TEST(Probe, PointsGetTheirShareOfTheTiles) {
  onEachScene([](DebugScene scene) {
    scene.random.lights[0].visibilityLayer = 1; // which no probe reads
    std::vector<ProbePoint> probes;
    std::vector<float> expected;
    RandomMaps withoutLayer = scene.random;
    withoutLayer.lights[0].visibilityLayer = 0;
    ShadowMaps maps = scene.maps;
    maps.lights = withoutLayer.lights;
    for (AskedPoint& point : scene.points) {
      const auto group = static_cast<std::uint8_t>(point.groupBit == 1 ? 0 : 1);
      probes.push_back({glm::dvec3(point.relative), glm::dvec3(point.normal), group});
      point.viewDepth = glm::dot(point.relative, scene.frame.forward);
      expected.push_back(truth::shadowVisibility(maps, 0, point));
    }
    maps.lights = scene.random.lights;
    onEachInstructionSet([&] {
      const std::vector<float> seen = probedShares(maps, scene.frame, 0, probes);
      Jumps off;
      for (std::size_t i = 0; i < seen.size(); ++i) off.compare(seen[i], expected[i], 2e-3f);
      EXPECT_LE(off.count, kPoints / 1000);
    });
  });
}

} // namespace
} // namespace gnomon::cpu
