#pragma once

#include <chrono>

#include "server/scenes/scene_backend.h"
#include "server/scenes/scene_directory.h"
#include "server/scenes/store_quota.h"

namespace gnomon {

/// Scenes in a directory that other servers may share.
class DirectoryBackend : public SceneBackend {
 public:
  /// `quotaBytes`: of their bundles together; 0 = none. `age`: scenes not used for so long go; 0 = never.
  static Result<std::unique_ptr<SceneBackend>> open(const std::string& path, std::uint64_t quotaBytes,
                                                    std::chrono::seconds age);

  Status checkRoom(std::uint64_t bytes) override { return quota_.check(bytes); }
  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) override;
  Result<StoredBundle> bundle(const std::string& id) override;
  Status contains(const std::string& id) override;
  Status use(const std::string& id) override;
  Result<ScenePage> page(std::string_view after, std::size_t limit) override { return directory_.page(after, limit); }
  StoreSize size() override { return directory_.size(); }
  std::optional<std::string> summary(const std::string& id) override { return directory_.readSummary(id); }
  void keepSummary(const std::string& id, const std::string& summary) override;
  void setAside(const std::string& id) override { directory_.setAside(id); }
  Status remove(const std::string& id) override;
  void keepClean(const SceneListener& removed) override;
  void onRemoved(SceneListener) override {} ///< shared file systems send no notice: each use looks

 private:
  DirectoryBackend(SceneDirectory directory, std::uint64_t quotaBytes, std::chrono::seconds age);

  const std::chrono::seconds age_;
  SceneDirectory directory_;
  StoreQuota quota_;
};

} // namespace gnomon
