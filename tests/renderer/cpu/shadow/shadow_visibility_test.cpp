#include <cmath>

#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/shadow/random_maps.h"
#include "tests/renderer/cpu/shadow/shadow_truth.h"

namespace gnomon::cpu {
namespace {

struct Case {
  const char* name;
  MapsOptions options;
};

const Case kCases[] = {
    {"one bilinear comparison", {}},
    {"3 x 3", {.filterSize = 3}},
    {"5 x 5", {.filterSize = 5}},
    {"7 x 7", {.filterSize = 7}},
    {"7 x 7, fades out", {.filterSize = 7, .fadesOut = true}},
    {"5 x 5 of a point light", {.lightType = GNOMON_POINT, .filterSize = 5}},
    {"3 x 3, manual bias", {.filterSize = 3, .manualBias = true}},
    {"3 x 3 of a spot light, manual bias", {.lightType = GNOMON_SPOT, .filterSize = 3, .manualBias = true}},
    {"4 samples a texel", {.samples = 4}},
    {"5 x 5 of 4 samples a texel", {.filterSize = 5, .samples = 4}},
    {"5 x 5 of 4 samples a texel of a point light", {.lightType = GNOMON_POINT, .filterSize = 5, .samples = 4}},
    {"disc", {.filterKind = GNOMON_FILTER_DISC}},
    {"disc of a point light", {.lightType = GNOMON_POINT, .filterKind = GNOMON_FILTER_DISC}},
    {"disc of 4 samples a texel", {.filterKind = GNOMON_FILTER_DISC, .samples = 4}},
    {"pcss", {.filterKind = GNOMON_FILTER_PCSS}},
    {"pcss of a point light", {.lightType = GNOMON_POINT, .filterKind = GNOMON_FILTER_PCSS}},
    {"pcss, manual bias", {.filterKind = GNOMON_FILTER_PCSS, .manualBias = true}},
    {"pcss of 4 samples a texel", {.filterKind = GNOMON_FILTER_PCSS, .samples = 4}},
    {"vsm", {.filterKind = GNOMON_FILTER_VSM}},
    {"vsm of a point light", {.lightType = GNOMON_POINT, .filterKind = GNOMON_FILTER_VSM}},
    {"evsm", {.filterKind = GNOMON_FILTER_EVSM}},
    {"evsm of a point light", {.lightType = GNOMON_POINT, .filterKind = GNOMON_FILTER_EVSM}},
    {"msm", {.filterKind = GNOMON_FILTER_MSM}},
    {"msm of a point light", {.lightType = GNOMON_POINT, .filterKind = GNOMON_FILTER_MSM}},
};

struct Difference {
  int points = 0;  ///< that differ by more than a 500th
  int between = 0; ///< points that are neither lit nor in full shadow
  double mean = 0;
  float greatest = 0;
};

std::vector<float> expectedOf(const ShadowMaps& maps, const std::vector<AskedPoint>& points) {
  std::vector<float> expected;
  for (const AskedPoint& point : points) expected.push_back(truth::shadowVisibility(maps, 0, point));
  return expected;
}

Difference differences(const ShadowMaps& maps, const std::vector<AskedPoint>& points,
                       const std::vector<float>& expected) {
  std::vector<float> seen(points.size());
  visibilitiesByLanes(maps, points, seen.data());
  Difference result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float off = std::abs(seen[i] - expected[i]);
    if (!(off <= 2e-3f)) ++result.points;
    if (expected[i] > 0.11f && expected[i] < 0.99f) ++result.between;
    result.mean += off / static_cast<double>(points.size());
    result.greatest = std::max(result.greatest, off);
  }
  return result;
}

// A comparison may turn over where the plane meets a texel's depth to within rounding.
TEST(ShadowVisibility, LanesGiveWhatTheShadersText) {
  for (const Case& c : kCases) {
    std::mt19937 random(7);
    const RandomMaps maps = randomMaps(random, c.options);
    const std::vector<AskedPoint> points = randomPoints(random, maps, kPoints);
    const std::vector<float> expected = expectedOf(maps.view(), points);
    onEachInstructionSet([&] {
      const Difference off = differences(maps.view(), points, expected);
      EXPECT_LE(off.points, kPoints / 1000) << c.name << ", greatest " << off.greatest;
      EXPECT_LE(off.mean, 2e-5) << c.name;
      EXPECT_GE(off.between, kPoints / 200) << c.name;
    });
  }
}

/// Squares of texels that are flat or slant, so that neighbours mostly see the same.
void setSquares(std::mt19937& random, DepthBuffer& depths) {
  constexpr int kSide = 48;
  for (int top = 0; top < depths.height; top += kSide) {
    for (int left = 0; left < depths.width; left += kSide) {
      const glm::vec3 plane(between(random, 0, 1), between(random, -4e-3f, 4e-3f), between(random, -4e-3f, 4e-3f));
      for (int y = top; y < std::min(top + kSide, depths.height); ++y) {
        for (int x = left; x < std::min(left + kSide, depths.width); ++x) {
          depths.depths[depths.at(x, y)] = glm::clamp(glm::dot(plane, glm::vec3(1, x - left, y - top)), 0.0f, 1.0f);
        }
      }
    }
  }
}

/// Sixteen points close together, then sixteen others, on surfaces that bend a little.
std::vector<AskedPoint> groupedPoints(std::mt19937& random, const RandomMaps& maps) {
  constexpr std::size_t kTogether = 16;
  const float texel = 1.0f / (maps.tiles[0].atlasPerMetre.x * static_cast<float>(kTestAtlas));
  std::vector<AskedPoint> points;
  for (const AskedPoint& first : randomPoints(random, maps, kPoints / kTogether)) {
    for (std::size_t i = 0; i < kTogether; ++i) {
      points.push_back(first);
      points.back().relative += randomDirection(random) * between(random, 0, 5 * texel);
      points.back().normal = glm::normalize(first.normal + 0.01f * randomDirection(random));
    }
  }
  return points;
}

TEST(ShadowVisibility, NeighboursThatSeeTheSameGiveWhatTheShadersText) {
  for (const int type : {GNOMON_DIRECTIONAL, GNOMON_POINT}) {
    for (const int size : {3, 5, 7}) {
      std::mt19937 random(12);
      RandomMaps maps = randomMaps(random, {.lightType = type, .filterSize = size});
      for (DepthBuffer& depths : maps.depths) setSquares(random, depths);
      const std::vector<AskedPoint> points = groupedPoints(random, maps);
      const std::vector<float> expected = expectedOf(maps.view(), points);
      onEachInstructionSet([&] {
        const Difference off = differences(maps.view(), points, expected);
        EXPECT_LE(off.points, kPoints / 1000) << size << ", greatest " << off.greatest;
        EXPECT_GE(off.between, kPoints / 500);
        EXPECT_LE(off.between, kPoints / 5) << "most are alike";
      });
    }
  }
}

/// Puts something else into every texel that is not marked.
void poison(RandomMaps& maps, const std::vector<TexelMarks>& marks, float depth, float moment) {
  for (std::size_t i = 0; i < maps.depths.size(); ++i) {
    DepthBuffer& depths = maps.depths[i];
    for (int y = 0; y < depths.height; ++y) {
      for (int x = 0; x < depths.width; ++x) {
        if (marks[i].any(x, y, x, y)) continue;
        for (int s = 0; s < depths.samples; ++s) depths.depths[depths.at(x, y, s)] = depth;
        if (maps.moments[i].empty()) continue;
        maps.moments[i][static_cast<std::size_t>(y) * static_cast<std::size_t>(depths.width) +
                        static_cast<std::size_t>(x)] = glm::vec4(moment);
      }
    }
  }
}

TEST(ReadTexels, NothingButMarkedTexelsIsEverRead) {
  for (const Case& each : kCases) {
    SCOPED_TRACE(each.name);
    std::mt19937 random(17);
    const RandomMaps original = randomMaps(random, each.options);
    const std::vector<AskedPoint> points = randomPoints(random, original, 200);
    onEachInstructionSet([&] {
      std::vector<float> expected(points.size());
      visibilitiesByLanes(original.view(), points, expected.data());
      std::vector<TexelMarks> marks;
      for (const TileMap& map : original.maps) marks.emplace_back(map.rect.width, map.rect.height);
      markByLanes(original.view(), points, marks);
      EXPECT_TRUE(marks[0].any() || marks[1].any());
      int marked = 0, texels = 0;
      for (const TexelMarks& tile : marks) {
        for (int i = 0; i < tile.width() * tile.height(); ++i) {
          const int x = i % tile.width(), y = i / tile.width();
          marked += tile.any(x, y, x, y) ? 1 : 0;
          ++texels;
        }
      }
      if (each.options.filterKind == GNOMON_FILTER_KERNEL) {
        EXPECT_LT(marked, texels / 4) << "far fewer than all";
      }
      for (const float depth : {-1.0f, 2.0f}) {
        RandomMaps poisoned = original;
        poison(poisoned, marks, depth, 1e6f * depth);
        for (std::size_t i = 0; i < poisoned.maps.size(); ++i) {
          poisoned.maps[i].depths = &poisoned.depths[i];
          poisoned.maps[i].moments = poisoned.moments[i];
        }
        std::vector<float> seen(points.size());
        visibilitiesByLanes(poisoned.view(), points, seen.data());
        EXPECT_EQ(seen, expected);
      }
    });
  }
}

} // namespace
} // namespace gnomon::cpu
