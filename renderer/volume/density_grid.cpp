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
  if (bad == grid.values.end()) {
    const auto [least, greatest] = std::minmax_element(grid.values.begin(), grid.values.end());
    grid.range = {*least, *greatest};
    return grid;
  }
  const auto index = bad - grid.values.begin();
  const auto row = index / grid.size.x;
  const std::string place = "x " + std::to_string(index % grid.size.x) + ", y " + std::to_string(row % grid.size.y) +
                            ", z " + std::to_string(row / grid.size.y);
  return Problem{ProblemCode::invalidValue, "", "The voxel at " + place + " is no finite number.", "finite",
                 std::isnan(*bad) ? "NaN" : "infinite"};
}

double valueAt(const DensityGrid& grid, const glm::dvec3& unit) {
  const glm::dvec3 size(grid.size);
  const glm::dvec3 place = glm::clamp(unit * size - 0.5, glm::dvec3(0.0), size - 1.0);
  const glm::ivec3 low = glm::ivec3(place);
  const glm::dvec3 share = place - glm::dvec3(low);
  // To the next centre along each axis, where there is one.
  const auto rowStep = static_cast<std::size_t>(grid.size.x);
  const std::size_t layerStep = rowStep * static_cast<std::size_t>(grid.size.y);
  const std::size_t x = low.x + 1 < grid.size.x ? 1 : 0;
  const std::size_t y = low.y + 1 < grid.size.y ? rowStep : 0;
  const std::size_t z = low.z + 1 < grid.size.z ? layerStep : 0;
  const float* at = grid.values.data() + static_cast<std::size_t>(low.z) * layerStep +
                    static_cast<std::size_t>(low.y) * rowStep + static_cast<std::size_t>(low.x);
  const auto alongX = [&](std::size_t row) { return glm::mix(double{at[row]}, double{at[row + x]}, share.x); };
  const auto alongY = [&](std::size_t layer) { return glm::mix(alongX(layer), alongX(layer + y), share.y); };
  return glm::mix(alongY(0), alongY(z), share.z);
}

} // namespace gnomon
