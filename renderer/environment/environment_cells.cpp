#include "renderer/environment/environment_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

constexpr int kCoarsest = 8; ///< cells along a row

/// The places from `first` to `last` of a row or a column, and how much of each lies there.
template <class Each>
void forOverlapped(double first, double last, int count, const Each& each) {
  for (int i = static_cast<int>(first); i < count && i < last; ++i) {
    const double share = std::min<double>(last, i + 1) - std::max<double>(first, i);
    if (share > 0) each(i, share);
  }
}

/// From many cells one.
class CellSum {
 public:
  void add(const EnvironmentCell& cell) {
    sum_.flux += cell.flux;
    sum_.solidAngle += cell.solidAngle;
    sum_.middle += cell.middle * cell.solidAngle;
    sum_.brightest += cell.brightest * (cell.flux.x + cell.flux.y + cell.flux.z);
  }

  EnvironmentCell cell(float width) const {
    EnvironmentCell cell = sum_;
    cell.middle = glm::normalize(cell.middle);
    cell.width = width;
    const float length = glm::length(cell.brightest);
    cell.brightest = length > 0 ? cell.brightest / length : cell.middle;
    return cell;
  }

 private:
  EnvironmentCell sum_;
};

/// Of cells of a row, `step` texels wide and high.
float cellWidth(const EnvironmentMap& map, int y, int step) {
  const double high = glm::pi<double>() * step / map.height;
  const double top = high * y;
  const double bottom = std::min(top + high, glm::pi<double>());
  const bool overEquator = top < glm::half_pi<double>() && bottom > glm::half_pi<double>();
  const double across = overEquator ? 1 : std::max(std::sin(top), std::sin(bottom));
  return static_cast<float>(std::max(high, glm::two_pi<double>() * step / map.width * across));
}

CellLevel finestLevel(const EnvironmentMap& map) {
  CellLevel level{map.width, map.height, std::vector<EnvironmentCell>(map.texels.size())};
  forEach(static_cast<std::size_t>(map.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    const auto solidAngle = static_cast<float>(texelSolidAngle(map, y));
    const float width = cellWidth(map, y, 1);
    for (int x = 0; x < map.width; ++x) {
      const glm::vec3 middle(environmentDirection({(x + 0.5) / map.width, (y + 0.5) / map.height}));
      level.cells[row * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)] = {
          map.at(x, y) * solidAngle, solidAngle, middle, width, middle};
    }
  });
  return level;
}

CellLevel coarserLevel(const EnvironmentMap& map, const CellLevel& finer, int step) {
  CellLevel level{(finer.width + 1) / 2, (finer.height + 1) / 2, {}};
  for (int y = 0; y < level.height; ++y) {
    const float width = cellWidth(map, y, step);
    for (int x = 0; x < level.width; ++x) {
      CellSum sum;
      for (int i = 0; i < 4; ++i) {
        const int column = 2 * x + (i & 1), row = 2 * y + (i >> 1);
        if (column < finer.width && row < finer.height) sum.add(finer.at(column, row));
      }
      level.cells.push_back(sum.cell(width));
    }
  }
  return level;
}

/// GGX about a direction that is normal, eye and mirrored direction at once, times the cosine; not normalized.
struct Lobe {
  glm::vec3 direction;
  float alpha2;

  float operator()(const glm::vec3& towards) const {
    const float cosine = glm::dot(direction, towards);
    const glm::vec3 apart = towards - direction;
    const float d = alpha2 + (1 - alpha2) * 0.25f * glm::dot(apart, apart);
    return cosine > 0 ? cosine / (d * d) : 0;
  }
};

} // namespace

EnvironmentMap resampled(const EnvironmentMap& map, int width) {
  if (map.width == width) return map;
  EnvironmentMap made{width, width / 2,
                      std::vector<glm::vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(width / 2))};
  const double across = static_cast<double>(map.width) / made.width;
  const double down = static_cast<double>(map.height) / made.height;
  forEach(static_cast<std::size_t>(made.height), [&](std::size_t row) {
    for (int x = 0; x < made.width; ++x) {
      glm::dvec3 flux(0);
      double covered = 0;
      forOverlapped(static_cast<double>(row) * down, (static_cast<double>(row) + 1) * down, map.height,
                    [&](int fromY, double shareY) {
                      const double solidAngle = texelSolidAngle(map, fromY) * shareY;
                      forOverlapped(x * across, (x + 1) * across, map.width, [&](int fromX, double shareX) {
                        flux += glm::dvec3(map.at(fromX, fromY)) * (solidAngle * shareX);
                        covered += solidAngle * shareX;
                      });
                    });
      made.texels[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = glm::vec3(flux / covered);
    }
  });
  return made;
}

std::vector<CellLevel> cellLevels(const EnvironmentMap& map) {
  std::vector<CellLevel> levels{finestLevel(map)};
  for (int step = 2; levels.back().width > kCoarsest; step *= 2) {
    levels.push_back(coarserLevel(map, levels.back(), step));
  }
  return levels;
}

// As in Barnes and Hut, "A Hierarchical O(N log N) Force-Calculation Algorithm", 1986: a cell is taken whole where it
// is small beside its distance and the lobe. Its light comes from where the most of it is, its share of the lobe is
// that of its middle.
glm::vec3 meanOverLobe(const std::vector<CellLevel>& levels, const glm::vec3& direction, float alpha) {
  constexpr float kShare = 0.4f;
  constexpr float kWidestCell = 0.3f; // radians
  struct Asked {
    int level, x, y;
  };
  const Lobe lobe{direction, alpha * alpha};
  const float lobeWidth = 2 * alpha;
  glm::vec3 light(0);
  float all = 0;
  const auto visit = [&](const Asked& root) {
    std::array<Asked, 64> waiting; // three more a level
    std::size_t count = 0;
    waiting[count++] = root;
    while (count > 0) {
      const Asked asked = waiting[--count];
      const CellLevel& level = levels[static_cast<std::size_t>(asked.level)];
      const EnvironmentCell& cell = level.at(asked.x, asked.y);
      if (glm::dot(direction, cell.middle) < -cell.width) continue;
      const float near = kShare * (glm::length(cell.middle - direction) + lobeWidth);
      if (asked.level == 0 || cell.width < std::min(near, kWidestCell)) {
        light += cell.flux * lobe(cell.brightest);
        all += cell.solidAngle * lobe(cell.middle);
        continue;
      }
      const CellLevel& finer = levels[static_cast<std::size_t>(asked.level) - 1];
      for (int i = 0; i < 4; ++i) {
        const int x = 2 * asked.x + (i & 1), y = 2 * asked.y + (i >> 1);
        if (x < finer.width && y < finer.height) waiting[count++] = {asked.level - 1, x, y};
      }
    }
  };
  const int last = static_cast<int>(levels.size()) - 1;
  for (int y = 0; y < levels.back().height; ++y) {
    for (int x = 0; x < levels.back().width; ++x) visit({last, x, y});
  }
  return light / all;
}

} // namespace gnomon
