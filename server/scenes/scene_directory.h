#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "server/scenes/store_use.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// Bundles on disk, one file each, named by id: "<id>.bundle", beside it "<id>.json" with the summary's text.
/// Files appear by rename only, so that a crash leaves a whole file or none. Any thread, and any number of processes.
class SceneDirectory {
 public:
  /// Makes the directory if need be, and removes what an interrupted write or removal left.
  static Result<SceneDirectory> open(const std::string& path);

  std::vector<std::string> ids() const; ///< ascending
  StoreUse use() const;                 ///< reads the whole directory
  bool contains(const std::string& id) const;

  /// Writes the bundle's bytes and its summary through to the disk. Problems: insufficientStorage where it is full,
  /// unavailable where it refuses otherwise; nothing is left of the scene then.
  Status write(const std::string& id, const FileDescriptor& bundle, const std::string& summary) const;

  /// Replaces the summary of a scene; what the disk refuses is logged only, since a summary can be made again.
  void writeSummary(const std::string& id, const std::string& summary) const;

  /// The bundle's file, for reading; an empty one where there is none, or where the disk refuses.
  FileDescriptor openBundle(const std::string& id) const;

  /// Renames a bundle whose bytes are not those that its id names to "<id>.damaged"; uploading the scene again repairs
  /// it.
  void setAside(const std::string& id) const;

  /// The summary's text as it was written; nothing when it is missing.
  std::optional<std::string> readSummary(const std::string& id) const;

  /// False when there was none.
  bool remove(const std::string& id) const;

 private:
  explicit SceneDirectory(std::string path) : path_(std::move(path)) {}
  std::string pathOf(const std::string& id, const char* ending) const;

  std::string path_;
};

} // namespace gnomon
