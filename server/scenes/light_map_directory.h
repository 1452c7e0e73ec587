#pragma once

#include <mutex>
#include <string>

#include "renderer/render.h"

namespace gnomon {

/// Light maps on disk, one file each, "<key>.map", within a budget of bytes: the least recently used go first. What the
/// disk refuses is logged and otherwise passed over, since a map can be baked again. Any thread.
class LightMapDirectory : public LightMapStore {
 public:
  /// Removes what an interrupted write left. The directory itself is made with the first map.
  LightMapDirectory(std::string path, std::size_t budgetBytes);

  std::optional<Bytes> read(const std::string& key) override; ///< and marks it as used
  void write(const std::string& key, const Bytes& lightMap) override;

  /// Removes the maps of a scene.
  void removeScene(const std::string& sceneId);

 private:
  std::string pathOf(const std::string& key) const { return path_ + "/" + key + ".map"; }
  void drop();

  std::string path_;
  std::size_t budgetBytes_;
  std::mutex dropping_;
};

} // namespace gnomon
