#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/lru.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

/// Everything that a light map depends on. Grids are the same where they are the same object.
class VolumeLightKey {
 public:
  /// `lights`, `casters`: any text that differs where the lights, or the surfaces that cast shadows and where they
  /// are, differ.
  VolumeLightKey(const VolumeLightInput& input, std::string lights, std::string casters);

  bool operator==(const VolumeLightKey& other) const;

 private:
  struct Part {
    std::weak_ptr<const DensityGrid> grid; ///< is not kept alive by a map
    TransferFunction function;
    VolumeSpace space;
    bool castShadow = true;
    bool receiveShadow = true;
  };
  static bool same(const Part& a, const Part& b);

  std::vector<Part> media_;
  std::size_t chosen_;
  std::optional<glm::dvec3> towards_;
  glm::ivec3 size_;
  std::string lights_, casters_;
};

/// Light maps of earlier frames, the latest used ones, within a bound on their bytes. For one thread.
class VolumeLightStore {
 public:
  struct Found {
    std::shared_ptr<const VolumeLight> map;
    bool made = false; ///< now; otherwise it was kept
  };

  explicit VolumeLightStore(std::size_t maxBytes) : maxBytes_(maxBytes) {}

  bool holds(const VolumeLightKey& key) const;

  /// The map of this key, by `make` where there is none.
  Found mapOf(const VolumeLightKey& key, const std::function<VolumeLight()>& make);

 private:
  using Entry = std::pair<VolumeLightKey, std::shared_ptr<const VolumeLight>>;

  std::size_t maxBytes_;
  LruList<Entry> entries_;
};

} // namespace gnomon
