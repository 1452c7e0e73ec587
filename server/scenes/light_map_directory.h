#pragma once

#include <mutex>
#include <string>

#include "server/scenes/stored_light_maps.h"

namespace gnomon {

/// Light maps on disk, one file each, "<key>.map". What the disk refuses is logged.
class LightMapDirectory : public StoredLightMaps {
 public:
  /// Removes what an interrupted write left. The directory itself is made with the first map.
  LightMapDirectory(std::string path, std::size_t budgetBytes);

  FileDescriptor open(const std::string& key) override;
  void write(const std::string& key, const FileDescriptor& lightMap) override;
  void removeScene(const std::string& sceneId) override;
  void cleanUp() override;

 private:
  std::string pathOf(const std::string& key) const { return path_ + "/" + key + ".map"; }
  void drop();

  std::string path_;
  std::size_t budgetBytes_;
  std::mutex dropping_;
};

} // namespace gnomon
