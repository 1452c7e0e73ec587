#include "renderer/cpu/raster/raster.h"

#include <algorithm>
#include <utility>

#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/raster/mesh.h"

namespace gnomon::cpu {
namespace {

TEST(Raster, EverySampleLiesInExactlyOneTriangleOfANet) {
  onEachInstructionSet([] {
    Random random(7);
    for (const int samples : {1, 4}) {
      for (const double reach : {1.0, 1.01, 40.0, 3000.0}) {
        const Mesh whole = net(random, 8, reach);
        std::vector<int> hits(97 * 61 * static_cast<std::size_t>(samples));
        const auto triangles = whole.scene.welded.size() / 3;
        for (std::uint32_t t = 0; t < triangles; ++t) {
          const auto* own = &whole.scene.welded[3 * std::size_t{t}];
          // What moving corners turned over lies twice where its neighbours lie, and counts against them.
          for (const Facing facing : {Facing::counterClockwise, Facing::clockwise}) {
            const DepthBuffer one = drawn(meshOf(whole.scene.positions, {own[0], own[1], own[2]}, facing), 97, 61,
                                          samples, DepthRange::clamped);
            for (int i = 0; i < static_cast<int>(hits.size()); ++i) {
              const int pixel = i / samples;
              const bool hit = one.triangles[one.at(pixel % 97, pixel / 97, i % samples)] == 0;
              hits[static_cast<std::size_t>(i)] += hit ? (facing == Facing::clockwise ? -1 : 1) : 0;
            }
          }
        }
        EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), static_cast<std::ptrdiff_t>(hits.size())) << reach;
      }
    }
  });
}

/// Whether a sample belongs to a triangle, in exact arithmetic.
bool covers(const std::array<glm::i64vec2, 3>& corners, const glm::i64vec2& sample) {
  auto [a, b, c] = corners;
  const auto cross = [](const glm::i64vec2& u, const glm::i64vec2& v) { return u.x * v.y - u.y * v.x; };
  if (cross(b - a, c - a) == 0) return false;
  if (cross(b - a, c - a) < 0) std::swap(b, c);
  const std::array<glm::i64vec2, 4> round{a, b, c, a};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::i64vec2 along = round[i + 1] - round[i];
    const std::int64_t side = cross(along, sample - round[i]);
    const bool owns = along.y < 0 || (along.y == 0 && along.x < 0);
    if (side < 0 || (side == 0 && !owns)) return false;
  }
  return true;
}

TEST(Raster, CoverageIsThatOfExactArithmeticOnTheGrid) {
  onEachInstructionSet([] {
    Random random(11);
    constexpr int kSide = 64; // so that 1/256 of a pixel is a power of two in clip space
    for (int round = 0; round < 600; ++round) {
      const double reach = round % 3 == 0 ? 0.05 : round % 3 == 1 ? 1.2 : 100;
      std::vector<glm::vec3> positions;
      std::array<glm::i64vec2, 3> corners{};
      for (glm::i64vec2& corner : corners) {
        // Whole pixels and halves, so that samples often lie on edges.
        const auto place = [&] {
          const auto at = std::llround(between(random, -reach, reach) * 64 * 256 / 2);
          return round % 2 == 0 ? at / 128 * 128 : at;
        };
        corner = {place(), place()};
        positions.emplace_back(static_cast<float>(corner.x) / (kSide / 2 * 256.0f),
                               static_cast<float>(corner.y) / (kSide / 2 * 256.0f), 0.5f);
      }
      const DepthBuffer buffer = drawn(meshOf(positions, {0, 1, 2}), kSide, kSide);
      int wrong = 0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const glm::i64vec2 sample((x - kSide / 2) * 256 + 128, (y - kSide / 2) * 256 + 128);
          wrong += covers(corners, sample) != (buffer.triangles[buffer.at(x, y)] == 0);
        }
      }
      ASSERT_EQ(wrong, 0) << round;
    }
  });
}

TEST(Raster, TheNearestIsShownAndOfTwoAtOneDepthTheFirst) {
  onEachInstructionSet([] {
    const std::vector<glm::vec3> positions{{-3, -1, 0.5f}, {3, -1, 0.5f},  {0, 4, 0.5f},  {-3, -1, 0.5f}, {3, -1, 0.5f},
                                           {0, 4, 0.5f},   {-3, -1, 0.7f}, {3, -1, 0.7f}, {0, 4, 0.0f}};
    const Mesh mesh = meshOf(positions, {0, 1, 2, 3, 4, 5, 6, 7, 8});
    const DepthBuffer camera = drawn(mesh, 32, 32);
    EXPECT_EQ(camera.triangles[camera.at(16, 1)], 2u) << "nearer below";
    EXPECT_NEAR(camera.depths[camera.at(16, 1)], 0.7, 0.02);
    EXPECT_EQ(camera.triangles[camera.at(16, 30)], 0u) << "two alike";
    const DepthBuffer light = drawn(mesh, 32, 32, 1, DepthRange::clamped);
    EXPECT_EQ(light.triangles[light.at(16, 1)], 0u);
    EXPECT_EQ(light.triangles[light.at(16, 30)], 2u);
  });
}

/// A camera at the origin that looks along -z, 90 degrees, near plane at 1, far plane at infinity.
glm::mat4 perspective() {
  glm::mat4 clip(0);
  clip[0][0] = clip[1][1] = 1;
  clip[2][3] = -1;
  clip[3][2] = 1;
  return clip;
}

TEST(Raster, TrianglesAcrossTheNearPlaneShowWhatLiesBehindIt) {
  onEachInstructionSet([] {
    Random random(5);
    constexpr int kSide = 48;
    for (int round = 0; round < 500; ++round) {
      const double size = round % 2 == 0 ? 4 : 1e6;
      std::array<glm::dvec3, 3> c;
      std::vector<glm::vec3> positions;
      for (glm::dvec3& corner : c) {
        positions.emplace_back(between(random, -size, size), between(random, -size, size),
                               between(random, -size, size));
        corner = glm::dvec3(positions.back());
      }
      Mesh mesh = meshOf(positions, {0, 1, 2});
      mesh.clip = perspective();
      const DepthBuffer buffer = drawn(mesh, kSide, kSide);
      const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
      int wrong = 0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const glm::dvec3 ray((x + 0.5) / (kSide / 2) - 1, (y + 0.5) / (kSide / 2) - 1, -1);
          const double t = glm::dot(normal, c[0]) / glm::dot(normal, ray); // the view depth
          const glm::dvec3 hit = ray * t;
          double least = std::abs(t - 1); // how surely it is a hit or none
          bool inside = t > 1;
          for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 edge = c[(i + 1) % 3] - c[i];
            const glm::dvec3 inward = glm::cross(normal, edge);
            const double side = glm::dot(inward, hit - c[i]) / glm::length(inward);
            inside = inside && side > 0;
            least = std::min(least, std::abs(side));
          }
          // A corner may be moved by half of 1/256 pixel, which is that share of the distance on the surface, seen
          // as obliquely as it is.
          const double oblique = std::abs(glm::dot(normal, ray)) / (glm::length(normal) * glm::length(ray));
          if (least < 0.004 * std::abs(t) / std::max(oblique, 1e-9)) continue;
          wrong += inside != (buffer.triangles[buffer.at(x, y)] == 0);
        }
      }
      ASSERT_EQ(wrong, 0) << round;
    }
  });
}

TEST(Raster, WhatLiesBeyondALightsDepthsIsFlattenedOntoThem) {
  const std::vector<glm::vec3> positions{{-3, -1, -5}, {3, -1, -5}, {0, 4, -5}, {-3, -1, 5}, {3, -1, 5}, {0, 4, 5}};
  const DepthBuffer front = drawn(meshOf(positions, {0, 1, 2}), 16, 16, 1, DepthRange::clamped);
  EXPECT_EQ(front.depths[front.at(8, 8)], 0);
  DepthBuffer behind = drawn(meshOf(positions, {3, 4, 5}), 16, 16, 1, DepthRange::clamped);
  EXPECT_EQ(behind.depths[behind.at(8, 8)], 1);
}

TEST(Raster, ComesOutTheSameOnEveryRunAndInstructionSetForOrthographicNets) {
  Random random(3);
  Mesh mesh = net(random, 90, 1.0); // 16,200 triangles in 16 slots
  const DepthBuffer first = drawn(mesh, 300, 200, 4);
  onEachInstructionSet([&] {
    const DepthBuffer again = drawn(mesh, 300, 200, 4);
    EXPECT_TRUE(again.triangles == first.triangles);
  });
}

/// Depths that no triangle has.
DepthBuffer poisoned(int width, int height, int samples) {
  DepthBuffer buffer = unfilledBuffer(width, height, samples, false);
  std::fill(buffer.depths.begin(), buffer.depths.end(), -7.0f);
  return buffer;
}

TEST(Raster, WantedBlocksAreThoseOfTheWholePictureAndTheOthersStayAsTheyWere) {
  Random random(11);
  const std::vector<Mesh> meshes{net(random, 60, 1.0), net(random, 3, 40.0), net(random, 9, 3000.0)};
  onEachInstructionSet([&] {
    for (const Mesh& mesh : meshes) {
      for (const int samples : {1, 4}) {
        const int width = 203, height = 150;
        const DepthBuffer whole = drawn(mesh, width, height, samples, DepthRange::clamped);
        TexelMarks marks(width, height);
        for (int i = 0; i < 6; ++i) {
          const int x = static_cast<int>(random() % width), y = static_cast<int>(random() % height);
          marks.mark(x, y, x + static_cast<int>(random() % 40), y + static_cast<int>(random() % 9));
        }
        DepthBuffer some = poisoned(width, height, samples);
        RasterInput input = mesh.input();
        input.only = &marks;
        RasterScratch scratch;
        EXPECT_EQ(raster(input, DepthRange::clamped, some, scratch), mesh.scene.welded.size() / 3);
        int wrong = 0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            for (int s = 0; s < samples; ++s) {
              const float expected = marks.any(x, y, x, y) ? whole.depths[whole.at(x, y, s)] : -7.0f;
              wrong += some.depths[some.at(x, y, s)] != expected ? 1 : 0;
            }
          }
        }
        EXPECT_EQ(wrong, 0);
      }
    }
  });
}

TEST(TexelMarks, GrowToTheBlocksAroundThem) {
  Random random(13);
  for (int round = 0; round < 50; ++round) {
    const int width = 1 + static_cast<int>(random() % 300), height = 1 + static_cast<int>(random() % 300);
    TexelMarks marks(width, height), expected(width, height);
    const int reachX = static_cast<int>(random() % 80), reachY = static_cast<int>(random() % 20);
    for (int i = 0; i < 4; ++i) {
      const int x = static_cast<int>(random() % 300), y = static_cast<int>(random() % 300);
      marks.mark(x, y, x + static_cast<int>(random() % 140), y + static_cast<int>(random() % 140));
    }
    std::size_t count = 0;
    for (int y = 0; y < height; y += kMarkSide) {
      for (int x = 0; x < width; x += kMarkSide) {
        if (!marks.any(x, y, x, y)) continue;
        ++count;
        expected.mark(x - reachX, y - reachY, x + kMarkSide - 1 + reachX, y + kMarkSide - 1 + reachY);
      }
    }
    EXPECT_EQ(marks.count(), count);
    const TexelMarks grown = marks.grown(reachX, reachY);
    for (std::size_t i = 0; i < grown.squares(); ++i) EXPECT_EQ(grown.in(i), expected.in(i));
  }
}

TEST(TexelMarks, HoldTheBlocksOfWhatWasMarked) {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    const int width = 1 + static_cast<int>(random() % 300), height = 1 + static_cast<int>(random() % 300);
    TexelMarks marks(width, height);
    EXPECT_FALSE(marks.any());
    const auto corner = [&] { return static_cast<int>(random() % 400) - 50; };
    int x0 = corner(), y0 = corner(), x1 = corner(), y1 = corner();
    if (x1 < x0) std::swap(x0, x1);
    if (y1 < y0) std::swap(y0, y1);
    marks.mark(x0, y0, x1, y1);
    const auto blockOf = [](int texel) { return texel >= 0 ? texel / kMarkSide : -1; };
    for (int i = 0; i < 200; ++i) {
      const int x = static_cast<int>(random()) % width, y = static_cast<int>(random()) % height;
      if (x < 0 || y < 0) continue;
      const bool meant = x1 >= 0 && y1 >= 0 && x0 < width && y0 < height && blockOf(x) >= blockOf(std::max(x0, 0)) &&
                         blockOf(x) <= blockOf(std::min(x1, width - 1)) && blockOf(y) >= blockOf(std::max(y0, 0)) &&
                         blockOf(y) <= blockOf(std::min(y1, height - 1));
      EXPECT_EQ(marks.any(x, y, x, y), meant);
    }
    TexelMarks all(width, height);
    all.markAll();
    TexelMarks rest = all.without(marks);
    rest.add(marks);
    EXPECT_FALSE(all.without(rest).any());
    EXPECT_TRUE(all.any(width - 1, height - 1, width + 90, height + 90));
    EXPECT_FALSE(all.any(width, 0, width + 9, 9));
  }
  TexelMarks none(0, 0);
  none.markAll();
  EXPECT_FALSE(none.any());
}

} // namespace
} // namespace gnomon::cpu
