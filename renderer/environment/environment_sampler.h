#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/environment/environment_map.h"

/// Which directions of an environment rays ask about.
namespace gnomon {

/// Radiance by direction on an octahedral grid, each of whose cells is of one radiance: 0.4 to 1 degrees wide. Places
/// of the unit square become directions by how much light comes from there, weighted by luminance. Immutable; any
/// thread.
class EnvironmentSampler {
 public:
  static constexpr int kSide = 256; ///< cells

  /// `radiance` of a direction of unit length: linear RGB, finite, not negative. Asked on all cores. `across`: places
  /// of a cell that it is asked about, along each side.
  EnvironmentSampler(const std::function<glm::vec3(const glm::dvec3&)>& radiance, int across);
  explicit EnvironmentSampler(const EnvironmentMap& map);

  /// `direction`: of unit length, in the map's own directions.
  glm::vec3 radiance(const glm::vec3& direction) const { return glm::vec3(cellAt(direction)); }

  /// How many of the directions of places lie there, per steradian, of 1 in all.
  float density(const glm::vec3& direction) const {
    const float sum = sumOf(direction);
    return cellAt(direction).w / (sum * sum * sum);
  }

  /// Where a place of the unit square leads. Close places lead to close directions, but for the grid's borders.
  glm::vec3 direction(glm::vec2 place) const;

  /// The same of many at once, one a lane.
  static constexpr std::size_t kLanes = 16;
  struct Directions {
    alignas(64) float x[kLanes], y[kLanes], z[kLanes]; ///< of unit length, in the map's own directions
  };
  struct Light {
    alignas(64) float red[kLanes], green[kLanes], blue[kLanes]; ///< radiance
    float density[kLanes];                                      ///< as density
  };
  void lookUp(const Directions& directions, Light& light) const;
  /// `across`, `up`: of the unit square. `asked`: -1, or 0 for lanes whose direction may be any.
  void aim(const float (&across)[kLanes], const float (&up)[kLanes], const int (&asked)[kLanes],
           Directions& directions) const;

  /// The share of rays that is worth sending by these places, the others going by the cosine: 0 where the radiance
  /// varies little over all directions.
  float share() const { return share_; }

 private:
  static float sumOf(const glm::vec3& d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z); }

  const glm::vec4& cellAt(const glm::vec3& direction) const;

  std::vector<glm::vec4> cells_;        ///< row by row: radiance; density where |x| + |y| + |z| = 1
  std::array<float, kSide + 1> rows_{}; ///< the part of all places that lies in rows before each
  static constexpr int kEnds = kSide + 1;
  std::vector<std::array<float, kEnds>> columns_;       ///< of each row, the part that lies before each column
  std::vector<std::array<std::uint8_t, kSide>> guides_; ///< of rows_, then of columns_: the last of its places that
                                                        ///< is no more than each 1 / kSide, where a search begins
  float share_ = 0;
};

} // namespace gnomon
