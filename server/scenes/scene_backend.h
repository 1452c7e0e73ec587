#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "server/scenes/scene_memory.h"

namespace gnomon {

/// The notFound problem of a route that names a scene.
Problem unknownScene(std::string_view id);

/// A bundle as it is sent to a worker.
struct StoredBundle {
  BundlePtr file;
  bool isStored = false; ///< it comes from a disk, and may be damaged
};

/// Takes the id of a scene that is there no longer.
using SceneListener = std::function<void(const std::string& id)>;

/// Where bundles and summaries are kept by id: in this process, in a directory, or in Redis. Any thread.
///
/// Each call may have the problem unavailable, where what keeps the scenes is away or refuses.
class SceneBackend {
 public:
  /// The most bytes of a summary.
  static constexpr std::size_t kMaxSummaryBytes = 16 << 20;

  virtual ~SceneBackend() = default;

  /// insufficientStorage where a bundle of so many bytes has no room now.
  virtual Status checkRoom(std::uint64_t bytes) = 0;

  /// Keeps a scene whole or not at all. False where it is there already, and marks it as used. `bytes`: of the bundle.
  /// Problems: insufficientStorage, too. REQUIRES: the summary has at most kMaxSummaryBytes.
  virtual Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes,
                           const std::string& summary) = 0;

  /// Marks the scene as used. Problems: notFound, too.
  virtual Result<StoredBundle> bundle(const std::string& id) = 0;

  virtual Status contains(const std::string& id) = 0; ///< or notFound
  virtual Status use(const std::string& id) = 0;      ///< the same, and marks the scene as used now

  /// `limit` >= 1 ids behind `after`, ascending.
  virtual Result<ScenePage> page(std::string_view after, std::size_t limit) = 0;

  virtual StoreSize size() = 0; ///< while what keeps them is away: as it was last known

  virtual StoreState state() { return {}; }

  /// The summary's text as it was written, which may be damaged; nothing where it is missing, or can't be read now.
  virtual std::optional<std::string> summary(const std::string& id) = 0;

  /// Replaces it where it can: it can be made again.
  virtual void keepSummary(const std::string& id, const std::string& summary) = 0;

  /// The bytes are not those that the id names: the scene is not offered any more until it is uploaded again.
  virtual void setAside(const std::string& id) = 0;

  virtual Status remove(const std::string& id) = 0; ///< or notFound

  /// Removes what was not used for so long, where that is asked for, reporting each, and what servers that died have
  /// left. One thread.
  virtual void keepClean(const SceneListener& removed) = 0;

  /// From now on `listener` gets each scene that others remove; nullptr = none. Any thread may call it, until the next
  /// call of this has returned. Without it a removal is found when the scene is used next.
  virtual void onRemoved(SceneListener listener) = 0;
};

} // namespace gnomon
