#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "server/redis/redis.h"
#include "server/system/file_descriptor.h"
#include "server/wire/messages.h"

namespace gnomon {

/// Baked light maps by key, within a budget of bytes: the least recently used go first. What the store refuses is
/// otherwise passed over, since a map can be baked again. Any thread.
class StoredLightMaps {
 public:
  virtual ~StoredLightMaps() = default;

  /// The map, for reading, and marks it as used; empty where there is none.
  virtual FileDescriptor open(const std::string& key) = 0;

  /// Keeps the bytes of a file as the map of this key.
  virtual void write(const std::string& key, const FileDescriptor& lightMap) = 0;

  /// Removes the maps of a scene.
  virtual void removeScene(const std::string& sceneId) = 0;

  /// Removes what writes of servers that died have left.
  virtual void cleanUp() = 0;
};

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

/// Light maps in Redis (redis_scripts.h). While it is away, there are none.
class RedisLightMaps : public StoredLightMaps {
 public:
  RedisLightMaps(std::shared_ptr<redis::Redis> redis, std::size_t budgetBytes)
      : redis_(std::move(redis)), budgetBytes_(budgetBytes) {}

  FileDescriptor open(const std::string& key) override;
  void write(const std::string& key, const FileDescriptor& lightMap) override;
  void removeScene(const std::string& sceneId) override;
  void cleanUp() override {} ///< unfinished ones expire by themselves

 private:
  const std::shared_ptr<redis::Redis> redis_;
  const std::size_t budgetBytes_;
};

} // namespace gnomon
