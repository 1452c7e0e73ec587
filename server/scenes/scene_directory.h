#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "server/scenes/scene_page.h"
#include "server/scenes/store_size.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// Bundles on disk, one file each, named by id: "<id>.bundle", beside it "<id>.json" with the summary's text.
/// Files appear by rename only, so that a crash leaves a whole file or none. A bundle's time of change says when its
/// scene was used last, and each process that has it open holds a shared lock on it (flock), so that all that share the
/// directory agree on what is in use. Any thread, and any number of processes.
class SceneDirectory {
 public:
  /// Makes the directory if need be, and cleans up. `age` is the least for which removeUnused() will be asked; 0 =
  /// never.
  static Result<SceneDirectory> open(const std::string& path, std::chrono::seconds age = {});

  ScenePage page(std::string_view after, std::size_t limit) const; ///< see PageFinder
  bool contains(const std::string& id) const;

  /// Reads the whole directory; damaged bundles have bytes, too. `without`: scenes whose bundles don't count.
  StoreSize size(const std::multiset<std::string>& without = {}) const;
  std::uint64_t bytesOf(const std::string& id) const; ///< of one bundle; 0 where there is none

  /// Writes the bundle's bytes and its summary through to the disk. Problems: insufficientStorage where it is full,
  /// unavailable where it refuses otherwise; nothing is left of the scene then. REQUIRES: the summary has at most
  /// SceneBackend::kMaxSummaryBytes.
  Status write(const std::string& id, const FileDescriptor& bundle, const std::string& summary) const;

  /// Replaces the summary of a scene; what the disk refuses is logged only, since a summary can be made again.
  void writeSummary(const std::string& id, const std::string& summary) const;

  /// The bundle's file, for reading, and marks its scene as used now; an empty one where there is none, or where the
  /// disk refuses. While it is open, removeUnused() of no server takes the scene away.
  FileDescriptor openBundle(const std::string& id) const;

  /// Renames a bundle whose bytes are not those that its id names to "<id>.damaged"; uploading the scene again repairs
  /// it.
  void setAside(const std::string& id) const;

  /// The summary's text as it was written; nothing when it is missing.
  std::optional<std::string> readSummary(const std::string& id) const;

  /// False when there was none.
  bool remove(const std::string& id) const;

  /// Removes what servers that died have left: unfinished files, and summaries without a bundle.
  void cleanUp() const;

  /// Removes the scenes that were not used for so long, and reports each of them; and bundles set aside as long ago.
  void removeUnused(std::chrono::seconds age, const std::function<void(const std::string& id)>& removed) const;

 private:
  SceneDirectory(std::string path, std::chrono::seconds age);
  std::string pathOf(const std::string& id, const char* ending) const;

  std::string path_;
  std::chrono::milliseconds resolution_; ///< of the time of a scene's last use
};

} // namespace gnomon
