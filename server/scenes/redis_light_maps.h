#pragma once

#include <memory>

#include "server/redis/redis.h"
#include "server/scenes/stored_light_maps.h"

namespace gnomon {

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
