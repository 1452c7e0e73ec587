#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "protocol/spec/environment_options.h"
#include "renderer/bake/baked_light.h"
#include "renderer/core/stop.h"
#include "renderer/environment/frame_sampler.h"
#include "renderer/frame/light_map_store.h"
#include "renderer/rays/trace.h"

namespace gnomon {

/// What a bake takes place on.
struct BakeInput {
  std::shared_ptr<const Scene> scene; ///< posed
  int index = 0;                      ///< into Scene::scenes
  const TracedScene& traced;
  std::span<const Light> lights;       ///< effective
  std::span<const NodeSwitches> nodes; ///< one a node of the file
  std::string keyInStore{};            ///< of what is asked for; empty = its map is not kept in a store
};

/// An environment of whose light the share that arrives is baked.
struct BakedEnvironment {
  const SkyLight& sky;
  const EnvironmentOptions& options; ///< effective
  const LightMapOptions& map;        ///< how fine it is
};

/// What a baked shadow depends on besides the scene and its nodes, the rest left at its defaults: two that are the same
/// share a map.
struct ShadowSource {
  Light light; ///< of an environment: one that has but the options of its map
  std::optional<EnvironmentOptions> environment{};

  bool operator==(const ShadowSource&) const = default;
};

ShadowSource sourceOf(const Light& light);
ShadowSource sourceOf(const BakedEnvironment& environment);

/// Light maps of earlier frames and bakes, the least recently used dropped first once they take more than a budget, and
/// those of scenes that are in use nowhere else. A map serves as long as all that its shadow depends on is the same
/// (ShadowSource). Any thread; one that asks for a map waits while another thread makes that map.
class LightMapCache {
 public:
  /// `store`: also keeps what is baked, and is asked before anything is; may be nullptr.
  explicit LightMapCache(std::size_t budgetBytes, std::shared_ptr<LightMapStore> store = nullptr)
      : budgetBytes_(budgetBytes), store_(std::move(store)) {}

  bool hasStore() const { return store_ != nullptr; }

  struct Found {
    std::shared_ptr<const BakedLight> baked;
    bool reused = false; ///< of an earlier bake of this process, or of the store
  };

  /// Baked now if need be. `light`: index into the lights, of technique lightMap. A problem where the map would be too
  /// large; its pointer begins at the light's `shadow.lightMap`. The newest stays, whatever its size. `progress` is
  /// also asked while this waits for another thread; where it asks to stop, a problem of code unavailable.
  Result<Found> get(const BakeInput& input, int light, const Progress& progress = {});

  /// The same of an environment; the problem's pointer begins at the options of the map.
  Result<Found> get(const BakeInput& input, const BakedEnvironment& environment, const Progress& progress = {});

 private:
  struct Key {
    std::weak_ptr<const Scene> scene;
    int index = 0;
    ShadowSource source;
    std::vector<NodeSwitches> nodes;
  };
  struct Entry {
    Key key;
    std::shared_ptr<const BakedLight> baked;
  };

  class Claim;

  /// Bakes as seen from a camera that sees all of the scene; nothing where it was stopped.
  using Bake = std::function<std::optional<std::vector<LightMap>>(const CameraView&, const LightMapLayout&)>;

  static bool isOf(const Key& key, const BakeInput& input, const ShadowSource& source);
  std::shared_ptr<const BakedLight> kept(const BakeInput& input, const ShadowSource& source);
  std::shared_ptr<const LightMapLayout> keptLayout(const BakeInput& input, const LightMapOptions& options);
  Result<Found> get(const BakeInput& input, const ShadowSource& source, const Bake& bake, const Progress& progress);
  Result<Found> make(const BakeInput& input, const ShadowSource& source, const Bake& bake, const Progress& progress);
  void drop();

  std::size_t budgetBytes_;
  std::shared_ptr<LightMapStore> store_;
  std::mutex mutex_;
  std::condition_variable changed_; ///< a map was made or given up
  LruList<Entry> entries_;
  std::list<Key> making_; ///< what some thread bakes at the moment
};

} // namespace gnomon
