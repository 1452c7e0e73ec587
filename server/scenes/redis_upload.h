#pragma once

#include <cstdint>
#include <string>

#include "protocol/base/result.h"
#include "server/redis/redis.h"
#include "server/system/file_descriptor.h"

/// How scenes come into Redis.
namespace gnomon {

/// insufficientStorage where so many bytes have no room in the quota now; 0 = there is none.
Status checkRedisRoom(redis::Redis& redis, std::uint64_t quotaBytes, std::uint64_t bytes);

struct RedisUpload {
  const std::string& id;
  const FileDescriptor& bundle;
  std::uint64_t bytes = 0; ///< of the bundle
  const std::string& summary;
};

/// Keeps a scene whole or not at all. False where it is there already, and marks it as used. Problems: unavailable, and
/// insufficientStorage where the quota or Redis has no room.
Result<bool> uploadToRedis(redis::Redis& redis, std::uint64_t quotaBytes, const RedisUpload& upload);

} // namespace gnomon
