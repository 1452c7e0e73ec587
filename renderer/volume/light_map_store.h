#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "renderer/volume/light_map.h"

namespace gnomon {

/// Everything that a light map depends on. Grids are the same where they are the same object.
class LightMapKey {
 public:
  /// `lights`, `casters`: any text that differs where the lights, or the surfaces that throw shadows and where they
  /// stand, differ.
  LightMapKey(const LightMapInput& input, std::string lights, std::string casters);

  bool operator==(const LightMapKey& other) const;

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
class LightMapStore {
 public:
  struct Found {
    std::shared_ptr<const LightMap> map;
    bool made = false; ///< now; otherwise it was kept
  };

  explicit LightMapStore(std::size_t maxBytes) : maxBytes_(maxBytes) {}

  /// The map of this key, by `make` where there is none.
  Found mapOf(const LightMapKey& key, const std::function<LightMap()>& make);

 private:
  using Entry = std::pair<LightMapKey, std::shared_ptr<const LightMap>>;

  std::size_t maxBytes_;
  std::list<Entry> entries_; ///< the latest used first
};

} // namespace gnomon
