#include "server/scenes/redis_light_maps.h"

#include <sys/stat.h>

#include "server/scenes/redis_parts.h"
#include "server/scenes/redis_scripts.h"

namespace gnomon {
namespace {

constexpr std::chrono::seconds kForMap{8}; ///< a worker waits little longer, and then bakes it

redis::Call mapCall() {
  constexpr std::chrono::seconds kPatience{2};
  return {Clock::now() + kPatience};
}

} // namespace

FileDescriptor RedisLightMaps::open(const std::string& key) {
  if (!isLightMapKey(key)) return {};
  redis::Command fields{"HMGET", lightMapKey(key)};
  fields.insert(fields.end(), kPartsFields.begin(), kPartsFields.end());
  const auto reply = redis_->ask(fields, mapCall());
  const auto parts = reply ? partsFrom(*reply) : std::nullopt;
  if (!parts || parts->bytes > budgetBytes_) return {};
  auto read = readParts(*redis_, *parts, kForMap);
  if (!read || !read->file) return {};
  (void)redis_->run(redis_scripts::useMap(), {}, {key}, mapCall());
  return *std::move(read->file);
}

void RedisLightMaps::write(const std::string& key, const FileDescriptor& lightMap) {
  struct stat status {};
  if (!isLightMapKey(key) || ::fstat(lightMap.get(), &status) != 0 || status.st_size <= 0) return;
  const RedisParts parts = newParts(static_cast<std::uint64_t>(status.st_size));
  if (parts.bytes > budgetBytes_) return;
  const std::string count = std::to_string(parts.count());
  if (writeParts(*redis_, parts, lightMap, kForMap)) {
    (void)redis_->run(redis_scripts::commitMap(), {lightMapKey(key)},
                      {key, parts.token, std::to_string(parts.bytes), count, std::to_string(budgetBytes_)}, mapCall());
  } else {
    (void)redis_->run(redis_scripts::abandon(), {kWritingKey}, {"", parts.token, count}, mapCall());
  }
}

void RedisLightMaps::removeScene(const std::string& sceneId) {
  (void)redis_->run(redis_scripts::removeMaps(), {}, {sceneId}, mapCall());
}

} // namespace gnomon
