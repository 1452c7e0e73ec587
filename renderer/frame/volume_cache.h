#pragma once

#include <memory>
#include <string>

#include "protocol/base/bytes.h"
#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/resolve/resolve_nodes.h"
#include "renderer/volume/medium.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

/// In the world. A problem at /box, /matrix or /node of the volume where it is flat or not finite.
Result<VolumeSpace> spaceOf(const VolumeOptions& options, const VolumePlace& place);

/// Volumes of earlier frames: grids that were read, with their transfer functions, and the light that
/// arrives in them. The least recently used are dropped first once either takes more than a budget, and grids of files
/// that are in use nowhere else. For one thread.
class VolumeCache {
 public:
  explicit VolumeCache(std::size_t budgetBytes) : budgetBytes_(budgetBytes), lights_(budgetBytes) {}

  /// Read now if need be. A problem's pointer begins at the volume. `file`: what `options.file` names. The newest
  /// stays, whatever its size.
  Result<std::shared_ptr<const Medium>> medium(const std::shared_ptr<const Bytes>& file, const VolumeOptions& options,
                                               const VolumePlace& place);

  VolumeLightStore& lights() { return lights_; }

 private:
  struct Entry {
    std::weak_ptr<const Bytes> file;
    VolumeOptions options;
    VolumePlace place;
    std::shared_ptr<const Medium> medium;
  };

  /// The same grid with the same transfer function, at any place; else read now.
  Result<Medium> filledMedium(const std::shared_ptr<const Bytes>& file, const VolumeOptions& options) const;
  void drop();

  std::size_t budgetBytes_;
  LruList<Entry> entries_;
  VolumeLightStore lights_;
};

} // namespace gnomon
