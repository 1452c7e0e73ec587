#include "server/scenes/redis_upload.h"

#include "server/scenes/redis_parts.h"
#include "server/scenes/redis_scripts.h"
#include "server/scenes/store_quota.h"

namespace gnomon {
namespace {

/// What a scene that is being written stands for in the quota.
std::string entryOf(const RedisParts& parts) {
  return parts.token + ":" + std::to_string(parts.bytes);
}

enum class Beginning { mayWrite, isThere };

/// `entry` empty: nothing is begun, and only the room is looked at.
Result<Beginning> begin(redis::Redis& redis, std::uint64_t quotaBytes, const std::string& id, const std::string& entry,
                        std::uint64_t bytes) {
  const std::string expires = std::to_string(std::chrono::milliseconds(kPartsExpire).count());
  const auto reply =
      answered(redis.run(redis_scripts::begin(), {sceneKey(id), kUsedKey, kBytesKey, kWritingKey},
                         {id, entry, std::to_string(bytes), std::to_string(quotaBytes), expires}, storeCall()));
  if (!reply) return reply.problems();
  if (reply->elements.size() != 2) return Problem{ProblemCode::internal, "", "Redis answers nonsense.", "", ""};
  const std::int64_t answer = reply->elements[0].integer;
  if (answer == 2) return noRoom(quotaBytes, static_cast<std::uint64_t>(reply->elements[1].integer), bytes);
  return answer == 1 ? Beginning::isThere : Beginning::mayWrite;
}

/// Whether it is new.
Result<bool> writeAndCommit(redis::Redis& redis, const RedisUpload& upload, const RedisParts& parts) {
  if (const Status written = writeParts(redis, parts, upload.bundle, kForScene); !written) return written.problems();
  const auto committed =
      answered(redis.run(redis_scripts::commit(),
                         {sceneKey(upload.id), kUsedKey, kBytesKey, kWritingKey, kScenesKey, summaryKey(upload.id)},
                         {upload.id, entryOf(parts), parts.token, std::to_string(parts.bytes),
                          std::to_string(parts.count()), upload.summary},
                         storeCall()));
  if (!committed) return committed.problems();
  return committed->integer == 1;
}

} // namespace

Status checkRedisRoom(redis::Redis& redis, std::uint64_t quotaBytes, std::uint64_t bytes) {
  const auto begun = begin(redis, quotaBytes, "", "", bytes);
  if (!begun) return begun.problems();
  return Done{};
}

Result<bool> uploadToRedis(redis::Redis& redis, std::uint64_t quotaBytes, const RedisUpload& upload) {
  const RedisParts parts = newParts(upload.bytes);
  const auto begun = begin(redis, quotaBytes, upload.id, entryOf(parts), upload.bytes);
  if (!begun) return begun.problems();
  if (*begun == Beginning::isThere) return false;
  auto isNew = writeAndCommit(redis, upload, parts);
  if (!isNew) { // while Redis is away, the parts expire by themselves
    (void)redis.run(redis_scripts::abandon(), {kWritingKey},
                    {entryOf(parts), parts.token, std::to_string(parts.count())}, storeCall());
  }
  return isNew;
}

} // namespace gnomon
