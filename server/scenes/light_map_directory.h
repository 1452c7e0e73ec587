#pragma once

#include <mutex>
#include <string>

#include "server/system/file_descriptor.h"

namespace gnomon {

/// Light maps on disk, one file each, "<key>.map", within a budget of bytes: the least recently used go first. What the
/// disk refuses is logged and otherwise passed over, since a map can be baked again. Any thread.
class LightMapDirectory {
 public:
  /// Removes what an interrupted write left. The directory itself is made with the first map.
  LightMapDirectory(std::string path, std::size_t budgetBytes);

  /// The map's file, for reading, and marks it as used; empty where there is none.
  FileDescriptor open(const std::string& key);

  /// Keeps the bytes of a file as the map of this key.
  void write(const std::string& key, const FileDescriptor& lightMap);

  /// Removes the maps of a scene.
  void removeScene(const std::string& sceneId);

  /// Removes what writes of servers that died have left.
  void cleanUp();

 private:
  std::string pathOf(const std::string& key) const { return path_ + "/" + key + ".map"; }
  void drop();

  std::string path_;
  std::size_t budgetBytes_;
  std::mutex dropping_;
};

} // namespace gnomon
