#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/base/lru.h"
#include "renderer/volume/medium.h"

namespace gnomon {

inline constexpr int kMaxVolumeLightSide = 64; ///< texels, of a map without a given size

/// Light on its way to one place.
struct Arrival {
  glm::dvec3 towards{0, 1, 0}; ///< the light, unit length
  double distance = std::numeric_limits<double>::infinity();
  glm::dvec3 irradiance{0};       ///< through clear air, on a surface that faces it
  double surfaceVisibility = 1.0; ///< the share that surfaces between let through
};

/// What of a light arrives at `place`, a point of the map (latticePlace). Any thread.
using ArrivalAt = std::function<Arrival(std::size_t point, const glm::dvec3& place)>;

/// The light in a volume at the points of a lattice from face to face of the unit cube, x fastest. Red, green and blue:
/// the light that arrives, in shares of `fullLight`; radiance from all around counts pi times. Alpha: the mean
/// extinction that this volume alone has on the way towards the chosen light, in shares of `fullExtinction`, exact in a
/// homogeneous medium.
struct VolumeLight {
  glm::ivec3 size{0};            ///< points along each axis, at least 2
  std::vector<glm::vec4> texels; ///< 0..1, each number one that a 16-bit float can hold
  glm::dvec3 fullLight{0};
  double fullExtinction = 0; ///< per metre
  double milliseconds = 0;   ///< that making it took
};

struct VolumeLightInput {
  std::span<const Medium* const> media{}; ///< all of the frame
  std::size_t chosen = 0;                 ///< the one that gets its map
  std::span<const ArrivalAt> lights{};
  std::optional<glm::dvec3> towards{}; ///< the directional light whose share is kept in alpha; none = 0
  glm::ivec3 size{2};                  ///< at least 2 each
  /// Besides, radiance from all around, the mean over all directions, that arrives in the chosen one; null = none.
  const VolumeLight* around = nullptr;
};

/// A point for each face between voxels, as far as there are no more than `most` along an axis. REQUIRES: most >= 2.
glm::ivec3 volumeLightSize(const DensityGrid& grid, int most = kMaxVolumeLightSide);

std::size_t pointsOf(const glm::ivec3& size);

/// Where a point of a map lies in the world; x fastest, then y, then z. REQUIRES: point < pointsOf(size).
glm::dvec3 latticePlace(const VolumeSpace& space, const glm::ivec3& size, std::size_t point);

/// By marching from each point to each light, through what casts shadows where the medium receives them.
VolumeLight makeVolumeLight(const VolumeLightInput& input);

/// What arrives at a place of the unit cube.
glm::dvec3 lightAt(const VolumeLight& map, const glm::dvec3& unit);

/// The share that the volume takes of the chosen light on its way to a place of the world; 0 where the ray misses it.
double shareTaken(const Medium& medium, const VolumeLight& map, const glm::dvec3& place, const glm::dvec3& towards);

struct MappedMedium {
  const Medium* medium = nullptr;
  const VolumeLight* map = nullptr;
};

/// The share of the chosen light that all of these let through to a place of the world.
double volumeVisibility(std::span<const MappedMedium> media, const glm::dvec3& place, const glm::dvec3& towards);

/// The volumes of a frame, with the light in them.
struct FrameVolumes {
  std::vector<std::shared_ptr<const Medium>> media;
  std::vector<std::shared_ptr<const VolumeLight>> lights; ///< parallel
  int light = -1;        ///< the frame's light that they shade surfaces from, a directional one; -1 = none
  glm::dvec3 towards{0}; ///< that light, unit length
  glm::dvec3 ambient{0}; ///< radiance from all around that is not in `lights`

  bool empty() const { return media.empty(); }
  std::vector<const Medium*> all() const { ///< which live as long as `media`
    std::vector<const Medium*> each;
    for (const auto& medium : media) each.push_back(medium.get());
    return each;
  }
  std::vector<MappedMedium> mapped() const {
    std::vector<MappedMedium> all;
    for (std::size_t i = 0; i < media.size(); ++i) all.push_back({media[i].get(), lights[i].get()});
    return all;
  }
};

/// Everything that a light map depends on. Grids are the same where they are the same object.
class VolumeLightKey {
 public:
  /// `lights`, `casters`: texts that differ where the lights, or the surfaces that cast, differ. `environment`: the
  /// same object where the rest of the lights is the same; it is not kept alive.
  VolumeLightKey(const VolumeLightInput& input, std::string lights, std::string casters,
                 std::weak_ptr<const void> environment = {});

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
  std::weak_ptr<const void> environment_;
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
