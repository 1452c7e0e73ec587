#include "renderer/volume/density_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon {
namespace {

std::string sizeText(std::int64_t x, std::int64_t y, std::int64_t z) {
  return std::to_string(x) + " x " + std::to_string(y) + " x " + std::to_string(z);
}

} // namespace

Result<std::size_t> voxelCount(std::int64_t x, std::int64_t y, std::int64_t z) {
  if (std::min({x, y, z}) < 1) {
    return Problem{ProblemCode::invalidValue, "", "A grid has at least one voxel along each axis.",
                   "1.." + std::to_string(kMaxGridSide), sizeText(x, y, z)};
  }
  if (std::max({x, y, z}) > kMaxGridSide) {
    return Problem{ProblemCode::tooLarge, "", "The grid has too many voxels along an axis.",
                   "1.." + std::to_string(kMaxGridSide), sizeText(x, y, z)};
  }
  if (x * y * z > kMaxGridVoxels) {
    return Problem{ProblemCode::tooLarge, "", "The grid has too many voxels.", std::to_string(kMaxGridVoxels),
                   sizeText(x, y, z)};
  }
  return static_cast<std::size_t>(x * y * z);
}

Result<DensityGrid> requireFinite(DensityGrid grid) {
  const auto bad = std::find_if(grid.values.begin(), grid.values.end(), [](float v) { return !std::isfinite(v); });
  if (bad == grid.values.end()) return grid;
  const auto index = bad - grid.values.begin();
  const auto row = index / grid.size.x;
  const std::string place = "x " + std::to_string(index % grid.size.x) + ", y " + std::to_string(row % grid.size.y) +
                            ", z " + std::to_string(row / grid.size.y);
  return Problem{ProblemCode::invalidValue, "", "The voxel at " + place + " is no finite number.", "finite",
                 std::isnan(*bad) ? "NaN" : "infinite"};
}

double valueAt(const DensityGrid& grid, const glm::dvec3& unit) {
  const glm::dvec3 last = glm::dvec3(grid.size - 1);
  const glm::dvec3 place = glm::clamp(unit * glm::dvec3(grid.size) - 0.5, glm::dvec3(0.0), last);
  const glm::ivec3 low = glm::ivec3(place);
  const glm::ivec3 high = glm::min(low + 1, grid.size - 1);
  const glm::dvec3 share = place - glm::dvec3(low);
  const auto alongX = [&](int y, int z) {
    return glm::mix(double{grid.at(low.x, y, z)}, double{grid.at(high.x, y, z)}, share.x);
  };
  const auto alongY = [&](int z) { return glm::mix(alongX(low.y, z), alongX(high.y, z), share.y); };
  return glm::mix(alongY(low.z), alongY(high.z), share.z);
}

} // namespace gnomon
