#include "tests/bench/hall_textures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <random>
#include <stdexcept>
#include <vector>

#include "renderer/image/picture_encode.h"

namespace gnomon::bench {
namespace {

constexpr int kSide = kTextureSide;
constexpr std::size_t kTexels = std::size_t{kSide} * kSide;
using Field = std::vector<float>; ///< a number a texel; goes round at its ends

float at(const Field& field, int x, int y) {
  return field[static_cast<std::size_t>(y & (kSide - 1)) * kSide + static_cast<std::size_t>(x & (kSide - 1))];
}

Field fieldOf(const std::function<float(int x, int y)>& value) {
  Field field(kTexels);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      field[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] = value(x, y);
  }
  return field;
}

/// About -1 to 1: smooth noise of ever finer grain, and some that differs from texel to texel.
Field noise(std::mt19937& random) {
  std::uniform_real_distribution<float> any(-1, 1);
  Field sum(kTexels, 0.0f);
  float strength = 0.5f;
  for (int cells = 8; cells <= 128; cells *= 4, strength *= 0.6f) {
    std::vector<float> corners(static_cast<std::size_t>(cells * cells));
    for (float& corner : corners) corner = any(random);
    const auto corner = [&](int x, int y) { return corners[static_cast<std::size_t>(y % cells * cells + x % cells)]; };
    const float cell = static_cast<float>(kSide) / static_cast<float>(cells);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::vec2 place = glm::vec2(x, y) / cell;
        const glm::ivec2 low(place);
        const glm::vec2 share = glm::smoothstep(0.0f, 1.0f, glm::fract(place));
        const float above = glm::mix(corner(low.x, low.y), corner(low.x + 1, low.y), share.x);
        const float below = glm::mix(corner(low.x, low.y + 1), corner(low.x + 1, low.y + 1), share.x);
        sum[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] +=
            strength * glm::mix(above, below, share.y);
      }
    }
  }
  for (float& value : sum) value += 0.08f * any(random);
  return sum;
}

/// How high the stuff stands, 0..1.
Field reliefOf(Stuff stuff) {
  if (stuff == Stuff::bricks) {
    return fieldOf([](int x, int y) {
      const glm::vec2 place = glm::vec2(x, y) / static_cast<float>(kSide) * glm::vec2(8, 16);
      const float shifted = place.x + 0.5f * static_cast<float>(static_cast<int>(place.y) % 2);
      const glm::vec2 within(glm::fract(shifted), glm::fract(place.y));
      const glm::vec2 toEdge = glm::min(within, 1.0f - within) * glm::vec2(2, 1);
      return glm::clamp(std::min(toEdge.x, toEdge.y) * 12.0f, 0.0f, 1.0f);
    });
  }
  if (stuff != Stuff::cloth) return Field(kTexels, 1.0f);
  return fieldOf([](int x, int y) {
    const float step = glm::two_pi<float>() / 8; // threads of eight texels
    return 0.75f + 0.25f * std::sin(step * static_cast<float>(x)) * std::sin(step * static_cast<float>(y));
  });
}

/// 1 on leaves, 0 between them.
Field leaves(std::mt19937& random) {
  std::uniform_real_distribution<float> any(0, 1);
  Field alpha(kTexels, 0.0f);
  for (int leaf = 0; leaf < 24; ++leaf) {
    const glm::vec2 middle = glm::vec2(any(random), any(random)) * static_cast<float>(kSide);
    const float turn = any(random) * glm::two_pi<float>();
    constexpr int kReach = kSide / 5;
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x) {
        const glm::vec2 own(std::cos(turn) * static_cast<float>(x) + std::sin(turn) * static_cast<float>(y),
                            std::cos(turn) * static_cast<float>(y) - std::sin(turn) * static_cast<float>(x));
        const glm::vec2 share = own / (static_cast<float>(kReach) * glm::vec2(0.95f, 0.3f));
        const glm::ivec2 place = (glm::ivec2(middle) + glm::ivec2(x, y)) & (kSide - 1);
        float& known = alpha[static_cast<std::size_t>(place.y) * kSide + static_cast<std::size_t>(place.x)];
        known = std::max(known, glm::clamp((1.0f - glm::dot(share, share)) * 8.0f, 0.0f, 1.0f));
      }
    }
  }
  return alpha;
}

std::uint8_t byteOf(float value) {
  return static_cast<std::uint8_t>(glm::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

template <int channels>
Image imageOf(const std::function<glm::vec4(int x, int y)>& texel) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(kTexels * channels);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::vec4 value = texel(x, y);
      for (int c = 0; c < channels; ++c) bytes.push_back(byteOf(value[c]));
    }
  }
  const std::vector<std::string> names{"R", "G", "B", "A"};
  return {kSide, kSide, {names.begin(), names.begin() + channels}, std::move(bytes)};
}

Bytes encoded(Result<Bytes> file) {
  if (!file) throw std::runtime_error(file.problems().front().detail);
  return *std::move(file);
}

Bytes jpegOf(const std::function<glm::vec4(int x, int y)>& texel) {
  constexpr int kQuality = 90;
  return encoded(encodeJpeg(imageOf<3>(texel), kQuality));
}

} // namespace

MaterialTextures texturesOf(Stuff stuff, const glm::vec3& color, unsigned seed) {
  std::mt19937 random(seed);
  const Field relief = reliefOf(stuff), grain = noise(random), wear = noise(random);
  const auto colorAt = [&](int x, int y) {
    return color * (1.0f + 0.35f * at(grain, x, y)) * (0.5f + 0.5f * at(relief, x, y));
  };
  MaterialTextures textures;
  if (stuff == Stuff::leaves) {
    const Field alpha = leaves(random);
    const auto image = imageOf<4>([&](int x, int y) { return glm::vec4(colorAt(x, y), at(alpha, x, y)); });
    textures.baseColor = encoded(encodePng(image, 6));
  } else {
    textures.baseColor = jpegOf([&](int x, int y) { return glm::vec4(colorAt(x, y), 1); });
  }
  textures.roughness = jpegOf([&](int x, int y) { return glm::vec4(0, 0.75f + 0.2f * at(wear, x, y), 0, 1); });
  const auto height = [&](int x, int y) { return 3 * at(relief, x, y) + 2 * at(grain, x, y); };
  textures.normal = jpegOf([&](int x, int y) {
    const glm::vec2 slope(height(x + 1, y) - height(x - 1, y), height(x, y + 1) - height(x, y - 1));
    return glm::vec4(glm::normalize(glm::vec3(-slope.x, slope.y, 1.0f)) * 0.5f + 0.5f, 1);
  });
  return textures;
}

} // namespace gnomon::bench
