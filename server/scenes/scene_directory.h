#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon {

/// Bundles on disk, one file each, named by id: "<id>.bundle", beside it "<id>.json" with the summary's text.
/// Files appear by rename only, so that a crash leaves a whole file or none. Any thread.
class SceneDirectory {
 public:
  /// Makes the directory if need be, and removes what an interrupted write left.
  /// `maxSceneBytes` is the largest bundle that read() takes.
  static Result<SceneDirectory> open(const std::string& path, std::size_t maxSceneBytes);

  std::vector<std::string> ids() const; ///< ascending
  bool contains(const std::string& id) const;

  /// Writes the bundle and its summary through to the disk.
  Status write(const std::string& id, const SceneBundle& bundle, const std::string& summary) const;

  /// Replaces the summary of a scene; what the disk refuses is logged only, since a summary can be made again.
  void writeSummary(const std::string& id, const std::string& summary) const;

  /// The bundle, once its hash is found equal to its id. One that differs is renamed to "<id>.damaged" and reported as
  /// notFound; uploading the scene again repairs it.
  Result<SceneBundle> read(const std::string& id) const;

  /// The summary's text as it was written; nothing when it is missing.
  std::optional<std::string> readSummary(const std::string& id) const;

  /// False when there was none.
  bool remove(const std::string& id) const;

 private:
  SceneDirectory(std::string path, std::size_t maxSceneBytes) : path_(std::move(path)), maxSceneBytes_(maxSceneBytes) {}
  std::string pathOf(const std::string& id, const char* ending) const;

  std::string path_;
  std::size_t maxSceneBytes_;
};

} // namespace gnomon
