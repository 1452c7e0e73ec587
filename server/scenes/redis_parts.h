#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "server/redis/redis.h"
#include "server/system/file_descriptor.h"

/// Files in Redis, cut into values of a few megabytes.
namespace gnomon {

/// Where the parts of a file are.
struct RedisParts {
  std::string token; ///< a name that no other file has
  std::uint64_t bytes = 0;
  std::uint64_t count() const; ///< of the parts
};

/// A name of its own for the parts of a file.
RedisParts newParts(std::uint64_t bytes);

/// What the hash of a scene or light map says: HMGET parts bytes count. Nothing where it is missing, or says nonsense.
std::optional<RedisParts> partsFrom(const redis::Reply& reply);
inline const std::vector<std::string> kPartsFields{"parts", "bytes", "count"};

/// After so long a part that no scene or light map holds is removed by Redis.
constexpr std::chrono::minutes kPartsExpire{10};
constexpr std::chrono::minutes kForScene{1}; ///< the patience for a bundle: well before its first part expires

/// Writes the parts of a file, which expire. Problems: unavailable, also where it takes longer than `patience`, and
/// insufficientStorage where Redis is full; some parts may be there then.
Status writeParts(redis::Redis& redis, const RedisParts& parts, const FileDescriptor& file, Clock::duration patience);

/// What was read: a file in memory, and the SHA-256 of its bytes. Without a file: parts are missing.
struct ReadParts {
  std::optional<FileDescriptor> file;
  std::string sha256;
};

/// Problems: unavailable, also where it takes longer than `patience`.
Result<ReadParts> readParts(redis::Redis& redis, const RedisParts& parts, Clock::duration patience);

/// What an error of Redis means: insufficientStorage where it is full, else unavailable, and a line in the log.
Problem problemOf(const redis::Reply& error);

/// The reply, or what its error means.
Result<redis::Reply> answered(Result<redis::Reply> reply);

/// A call of a store, other than those that move parts. `bytes`: of its reply.
redis::Call storeCall(std::size_t bytes = 1 << 20);

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
