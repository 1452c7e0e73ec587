#include "renderer/cpu/shadow/moments.h"

#include <cmath>

#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/shadow/random_maps.h"

namespace gnomon::cpu {
namespace {

/// What shaders/moments.frag computes, a number at a time.
struct Truth {
  const DepthBuffer& depths;
  const MomentBlur& blur;
  std::vector<glm::vec4> rows;

  glm::vec4 momentsOf(float depth) const {
    if (blur.farthest > 0) {
      const float span = blur.farthest - blur.nearest;
      const float distance = blur.nearest * blur.farthest / (blur.farthest - depth * span);
      depth = glm::clamp((distance - blur.nearest) / span, 0.0f, 1.0f);
    }
    return shared::momentsOf(depth, blur.kind);
  }
  glm::vec4 texel(int x, int y) const {
    glm::vec4 sum(0);
    for (int i = 0; i < depths.samples; ++i) sum += momentsOf(depths.depths[depths.at(x, y, i)]);
    return sum / static_cast<float>(depths.samples);
  }
  template <class Source>
  static glm::vec4 blurred(float reach, const Source& source) {
    const int stride = std::max(1, static_cast<int>(std::ceil((2.0f * reach + 1.0f) / 33.0f)));
    const int taps = static_cast<int>(std::ceil(reach)) / stride + 1;
    glm::vec4 sum(0);
    float all = 0;
    for (int i = -taps; i <= taps; ++i) {
      const float weight = glm::clamp(reach + 1.0f - static_cast<float>(std::abs(i * stride)), 0.0f, 1.0f);
      if (weight <= 0) continue;
      sum += weight * source(i * stride);
      all += weight;
    }
    return sum / all;
  }
  std::vector<glm::vec4> all() {
    std::vector<glm::vec4> source;
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * depths.width + x); };
    const auto eachTexel = [&](const auto& value) {
      std::vector<glm::vec4> values;
      for (int y = 0; y < depths.height; ++y) {
        for (int x = 0; x < depths.width; ++x) values.push_back(value(x, y));
      }
      return values;
    };
    source = eachTexel([&](int x, int y) { return texel(x, y); });
    rows = eachTexel([&](int x, int y) {
      return blurred(blur.reach.x, [&](int i) { return source[at(std::clamp(x + i, 0, depths.width - 1), y)]; });
    });
    return eachTexel([&](int x, int y) {
      return blurred(blur.reach.y, [&](int i) { return rows[at(x, std::clamp(y + i, 0, depths.height - 1))]; });
    });
  }
};

DepthBuffer randomBuffer(std::mt19937& random, int width, int height, int samples) {
  DepthBuffer buffer;
  buffer.width = width;
  buffer.height = height;
  buffer.samples = samples;
  buffer.depths.resize(buffer.blocks() * kBlockPlaces * static_cast<std::size_t>(samples));
  for (float& depth : buffer.depths) depth = glm::clamp(between(random, -0.1f, 1.1f), 0.0f, 1.0f);
  return buffer;
}

/// As a share of what the moment may be.
float greatestDifference(const std::vector<glm::vec4>& seen, const std::vector<glm::vec4>& expected) {
  float greatest = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (int m = 0; m < 4; ++m) {
      const float off = std::abs(seen[i][m] - expected[i][m]) / std::max(1.0f, std::abs(expected[i][m]));
      if (!(off <= greatest)) greatest = off;
    }
  }
  return greatest;
}

TEST(BlurredMoments, AreWhatTheShadersTextGives) {
  std::mt19937 random(5);
  const glm::ivec2 sizes[] = {{1, 1}, {5, 18}, {64, 33}, {131, 90}};
  const glm::vec2 reaches[] = {{0, 0}, {1, 1}, {3, 2.3f}, {0.4f, 20.7f}, {60.2f, 7}};
  for (const int kind : {GNOMON_FILTER_VSM, GNOMON_FILTER_EVSM, GNOMON_FILTER_MSM}) {
    for (const glm::ivec2& size : sizes) {
      for (const glm::vec2& reach : reaches) {
        for (const int samples : {1, 4}) {
          MomentBlur blur{kind, reach, 0, 0};
          if (random() % 2 == 0) {
            blur.nearest = 0.5f;
            blur.farthest = 30;
          }
          const DepthBuffer depths = randomBuffer(random, size.x, size.y, samples);
          const std::vector<glm::vec4> expected = Truth{depths, blur, {}}.all();
          onEachInstructionSet([&] {
            std::vector<glm::vec4> seen(expected.size());
            TexelMarks all(size.x, size.y);
            all.markAll();
            blurMoments(depths, blur, all, seen);
            ASSERT_LE(greatestDifference(seen, expected), 3e-5f)
                << "kind " << kind << ", " << size.x << " x " << size.y << ", reach " << reach.x << " " << reach.y
                << ", samples " << samples << ", to " << blur.farthest << " m";
          });
        }
      }
    }
  }
}

/// NaN wherever no depth is made.
DepthBuffer onlyIn(const TexelMarks& made, const DepthBuffer& depths) {
  DepthBuffer some = depths;
  for (int y = 0; y < depths.height; ++y) {
    for (int x = 0; x < depths.width; ++x) {
      if (!made.any(x, y, x, y)) some.depths[some.at(x, y)] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return some;
}

TEST(BlurredMoments, OfSomeTexelsAreThoseOfTheWholeTileAndReadNoFartherThanTheyTell) {
  std::mt19937 random(9);
  const glm::ivec2 size(203, 150);
  for (const glm::vec2& reach : {glm::vec2(0, 1), glm::vec2(2, 2.5f), glm::vec2(23.4f, 40)}) {
    const MomentBlur blur{GNOMON_FILTER_EVSM, reach, 0, 0};
    const DepthBuffer depths = randomBuffer(random, size.x, size.y, 1);
    TexelMarks all(size.x, size.y), wanted(size.x, size.y);
    all.markAll();
    for (int i = 0; i < 5; ++i) {
      const int x = static_cast<int>(random() % 203), y = static_cast<int>(random() % 150);
      wanted.mark(x, y, x + static_cast<int>(random() % 30), y + static_cast<int>(random() % 9));
    }
    const glm::ivec2 around = readAround(blur);
    const DepthBuffer some = onlyIn(wanted.grown(around.x, around.y), depths);
    onEachInstructionSet([&] {
      std::vector<glm::vec4> whole(static_cast<std::size_t>(size.x * size.y)), part(whole.size());
      blurMoments(depths, blur, all, whole);
      blurMoments(some, blur, wanted, part);
      int wrong = 0;
      for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
          const auto at = static_cast<std::size_t>(y * size.x + x);
          wrong += wanted.any(x, y, x, y) && part[at] != whole[at] ? 1 : 0;
        }
      }
      EXPECT_EQ(wrong, 0) << reach.x << ' ' << reach.y;
    });
  }
}

TEST(MomentBlur, TakesInTheFiltersSizeOrItsRadius) {
  ShadowTile tile;
  tile.filter.kind = MapReadingKind::evsm;
  tile.filter.size = 5;
  EXPECT_EQ(momentBlur(tile).kind, GNOMON_FILTER_EVSM);
  EXPECT_EQ(momentBlur(tile).reach, glm::vec2(2));
  EXPECT_EQ(momentBlur(tile).farthest, 0);
  tile.filter.radius = 1;
  tile.space.fit.radius = 1;
  tile.space.fit.texelSize = {0.25, 4};
  EXPECT_EQ(momentBlur(tile).reach, glm::vec2(3.5f, 0));
  tile.space.fit.perspective = true;
  tile.near = 2;
  tile.far = 9;
  EXPECT_EQ(momentBlur(tile).nearest, 2);
  EXPECT_EQ(momentBlur(tile).farthest, 9);
}

} // namespace
} // namespace gnomon::cpu
