#include "renderer/environment/prefilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/parallel.h"
#include "renderer/environment/environment_cells.h"
#include "renderer/shaders/shared/functions.h"

namespace gnomon {
namespace {

constexpr int kNarrowest = 256, kWidest = 1024; ///< maps that are summed: the finest square shows no more

struct Square {
  int x, y; ///< its corner in the atlas, without the border
  int side;

  glm::vec3 direction(double column, double row) const {
    return shared::fromOctahedral(glm::vec2(glm::dvec2(column, row) * (2.0 / side) - 1.0));
  }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(y + row) * GNOMON_ENVIRONMENT_WIDTH + static_cast<std::size_t>(x + column);
  }
};

Square squareOf(int number) {
  const glm::vec3& place = shared::kEnvironmentSquares[number];
  return {static_cast<int>(place.x), static_cast<int>(place.y), static_cast<int>(place.z)};
}

/// Across an edge of an octahedral map lies its other half, the other way round.
void addBorder(const Square& square, std::vector<glm::vec4>& texels) {
  const int last = square.side - 1;
  const auto copy = [&](int column, int row) {
    int fromX = column, fromY = row;
    if (fromX < 0 || fromX > last) {
      fromX = std::clamp(fromX, 0, last);
      fromY = last - fromY;
    }
    if (fromY < 0 || fromY > last) {
      fromY = std::clamp(fromY, 0, last);
      fromX = last - fromX;
    }
    texels[square.at(column, row)] = texels[square.at(fromX, fromY)];
  };
  for (int i = -1; i <= square.side; ++i) {
    copy(i, -1);
    copy(i, square.side);
    copy(-1, i);
    copy(square.side, i);
  }
}

glm::vec3 between(const EnvironmentMap& map, const glm::dvec3& direction) {
  const glm::dvec2 place = environmentPlace(direction) * glm::dvec2(map.width, map.height) - 0.5;
  const double column = std::floor(place.x), row = std::floor(place.y);
  const auto texel = [&](int right, int down) {
    const int x = (static_cast<int>(column) + right + map.width) % map.width;
    return map.at(x, std::clamp(static_cast<int>(row) + down, 0, map.height - 1));
  };
  const glm::vec2 share(place - glm::dvec2(column, row));
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x), glm::mix(texel(0, 1), texel(1, 1), share.x), share.y);
}

/// What a mirror shows.
void addMirrored(const EnvironmentMap& map, const Square& square, std::vector<glm::vec4>& texels) {
  forEach(static_cast<std::size_t>(square.side), [&](std::size_t row) {
    for (int x = 0; x < square.side; ++x) {
      const glm::dvec3 towards(square.direction(x + 0.5, double(row) + 0.5));
      texels[square.at(x, static_cast<int>(row))] = glm::vec4(between(map, towards), 1);
    }
  });
}

void addLobes(const std::vector<CellLevel>& levels, const Square& square, float roughness,
              std::vector<glm::vec4>& texels) {
  forEach(static_cast<std::size_t>(square.side), [&](std::size_t row) {
    for (int x = 0; x < square.side; ++x) {
      const glm::vec3 direction = square.direction(x + 0.5, double(row) + 0.5);
      const glm::vec3 mean = meanOverLobe(levels, direction, roughness * roughness);
      texels[square.at(x, static_cast<int>(row))] = glm::vec4(mean, 1);
    }
  });
}

/// Radiance times solid angle of parts of the sphere as vectors, for red, green and blue, and solid angle alone: what
/// faces a direction gets of a part's light the vector's product with it.
struct LightVectors {
  static constexpr int kColumns = 64, kRows = 32;
  std::vector<std::array<glm::vec3, 4>> parts{std::size_t{kColumns} * kRows};
};

LightVectors lightVectors(const CellLevel& finest) {
  LightVectors vectors;
  for (int y = 0; y < finest.height; ++y) {
    for (int x = 0; x < finest.width; ++x) {
      const EnvironmentCell& cell = finest.at(x, y);
      const int part =
          y * LightVectors::kRows / finest.height * LightVectors::kColumns + x * LightVectors::kColumns / finest.width;
      std::array<glm::vec3, 4>& sums = vectors.parts[static_cast<std::size_t>(part)];
      for (int c = 0; c < 3; ++c) sums[static_cast<std::size_t>(c)] += cell.flux[c] * cell.middle;
      sums[3] += cell.solidAngle * cell.middle;
    }
  }
  return vectors;
}

void addIrradiance(const LightVectors& vectors, const Square& square, std::vector<glm::vec4>& texels) {
  constexpr int kTogether = 18; // texels of a row, whose side is a multiple
  forEach(static_cast<std::size_t>(square.side), [&](std::size_t row) {
    for (int first = 0; first < square.side; first += kTogether) {
      float x[kTogether], y[kTogether], z[kTogether], sums[4][kTogether] = {};
      for (int i = 0; i < kTogether; ++i) {
        const glm::vec3 normal = square.direction(first + i + 0.5, double(row) + 0.5);
        x[i] = normal.x;
        y[i] = normal.y;
        z[i] = normal.z;
      }
      for (const std::array<glm::vec3, 4>& part : vectors.parts) {
        for (std::size_t c = 0; c < 4; ++c) {
          const glm::vec3 light = part[c];
          for (int i = 0; i < kTogether; ++i) {
            sums[c][i] += std::max(0.0f, light.x * x[i] + light.y * y[i] + light.z * z[i]);
          }
        }
      }
      for (int i = 0; i < kTogether; ++i) {
        texels[square.at(first + i, static_cast<int>(row))] =
            glm::vec4(glm::vec3(sums[0][i], sums[1][i], sums[2][i]) / sums[3][i], 1);
      }
    }
  });
}

} // namespace

PrefilteredEnvironment prefiltered(const EnvironmentMap& map) {
  const EnvironmentMap own = resampled(map, std::clamp(map.width, kNarrowest, kWidest));
  const std::vector<CellLevel> levels = cellLevels(own);
  PrefilteredEnvironment made;
  made.texels.assign(std::size_t{GNOMON_ENVIRONMENT_WIDTH} * GNOMON_ENVIRONMENT_HEIGHT, glm::vec4(0));
  addMirrored(own, squareOf(0), made.texels);
  for (int n = 1; n < GNOMON_ENVIRONMENT_LEVELS; ++n) {
    addLobes(levels, squareOf(n), float(n) / (GNOMON_ENVIRONMENT_LEVELS - 1), made.texels);
  }
  addIrradiance(lightVectors(levels.front()), squareOf(GNOMON_IRRADIANCE_SQUARE), made.texels);
  for (int n = 0; n < GNOMON_ENVIRONMENT_SQUARES; ++n) addBorder(squareOf(n), made.texels);
  for (const EnvironmentCell& cell : levels.back().cells) made.mean += glm::dvec3(cell.flux);
  made.mean /= 4 * glm::pi<double>();
  return made;
}

} // namespace gnomon
