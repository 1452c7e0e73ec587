#pragma once

#include "server/scenes/scene_backend.h"
#include "server/scenes/scene_memory.h"

namespace gnomon {

/// Scenes that this process alone keeps, the least recently used dropped first.
class MemoryBackend : public SceneBackend {
 public:
  MemoryBackend(std::size_t budgetBytes, std::size_t most) : scenes_(budgetBytes, most) {}

  Status checkRoom(std::uint64_t) override { return Done{}; }
  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) override;
  Result<StoredBundle> bundle(const std::string& id) override;
  Status contains(const std::string& id) override;
  Status use(const std::string& id) override;
  Result<ScenePage> page(std::string_view after, std::size_t limit) override { return scenes_.page(after, limit); }
  StoreSize size() override { return scenes_.size(); }
  std::optional<std::string> summary(const std::string& id) override { return scenes_.summary(id); }
  void keepSummary(const std::string&, const std::string&) override {} ///< none is ever missing
  void setAside(const std::string&) override {}                        ///< bytes in memory are not damaged
  Status remove(const std::string& id) override;
  void keepClean(const SceneListener&) override {}
  void onRemoved(SceneListener) override {} ///< this process alone removes any

 private:
  SceneMemory scenes_;
};

} // namespace gnomon
