#include "renderer/frame/volume_cache.h"

#include <set>

#include "renderer/core/collect.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/volume/density_grid.h"
#include "renderer/volume/extinction_cells.h"

namespace gnomon {
namespace {

constexpr std::size_t kMaxPlaces = 128; // of volumes, however small each is

/// In the world, or in the space of the node.
Result<VolumeSpace> ownSpace(const VolumeOptions& options) {
  if (options.box) {
    auto space = gnomon::spaceOf(Aabb{toVector(options.box->min), toVector(options.box->max)});
    return space ? space : Result<VolumeSpace>(placedAt("/box", space.problems()));
  }
  if (!options.matrix) return VolumeSpace{};
  glm::dmat4 matrix(1);
  for (std::size_t i = 0; i < 16; ++i) {
    matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = (*options.matrix)[i];
  }
  auto space = gnomon::spaceOf(matrix);
  return space ? space : Result<VolumeSpace>(placedAt("/matrix", space.problems()));
}

Result<TransferFunction> functionOf(const std::vector<TransferStop>& stops) {
  std::vector<TransferPoint> points;
  for (const TransferStop& stop : stops) points.push_back({stop.value, {toVector(stop.color), stop.extinction}});
  auto function = makeTransferFunction(std::move(points));
  return function ? function : Result<TransferFunction>(placedAt("/transferFunction", function.problems()));
}

std::size_t bytesOf(const DensityGrid& grid) {
  return grid.values.size() * sizeof(float);
}

} // namespace

Result<VolumeSpace> spaceOf(const VolumeOptions& options, const VolumePlace& place) {
  auto own = ownSpace(options);
  if (!own || !place.worldFromNode) return own;
  auto atNode = moved(*own, *place.worldFromNode);
  return atNode ? atNode : Result<VolumeSpace>(placedAt("/node", atNode.problems()));
}

Result<Medium> VolumeCache::filledMedium(const std::shared_ptr<const Bytes>& file, const VolumeOptions& options) const {
  std::shared_ptr<const DensityGrid> grid;
  for (const Entry& entry : entries_) {
    if (entry.file.lock() != file || entry.options.grid != options.grid) continue;
    if (entry.options.transferFunction == options.transferFunction) return *entry.medium;
    grid = entry.medium->grid;
  }
  auto function = functionOf(options.transferFunction);
  if (!function) return function.problems();
  if (!grid) {
    auto read = readGridFile(*file, options.grid.value_or(""));
    if (!read) return placedAt("/file", read.problems());
    grid = std::make_shared<const DensityGrid>(*std::move(read));
  }
  return makeMedium(std::move(grid), *std::move(function), {});
}

Result<std::shared_ptr<const Medium>> VolumeCache::medium(const std::shared_ptr<const Bytes>& file,
                                                          const VolumeOptions& options, const VolumePlace& place) {
  const Entry* const found = entries_.findIf([&](const Entry& entry) {
    return entry.options == options && entry.place == place && entry.file.lock() == file;
  });
  if (found) return found->medium;
  const auto space = spaceOf(options, place);
  if (!space) return space.problems();
  auto made = filledMedium(file, options);
  if (!made) return made.problems();
  made->space = *space;
  made->visible = place.visible;
  made->castShadow = options.castShadow && place.castShadow;
  made->receiveShadow = options.receiveShadow && place.receiveShadow;
  const Entry& added = entries_.add({file, options, place, std::make_shared<const Medium>(*std::move(made))});
  drop();
  return added.medium;
}

void VolumeCache::drop() {
  entries_.eraseIf([](const Entry& entry) { return entry.file.expired(); });
  entries_.keepNewest(kMaxPlaces);
  std::set<const DensityGrid*> grids;
  entries_.keepWithin(budgetBytes_, [&grids](const Entry& entry) {
    const DensityGrid* grid = entry.medium->grid.get();
    const std::size_t cells = entry.medium->cells->perMetre.size() * sizeof(float);
    return entry.medium->bricks.filled.size() + cells + (grids.insert(grid).second ? bytesOf(*grid) : 0);
  });
}

} // namespace gnomon
