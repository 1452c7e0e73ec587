#include "server/scenes/redis_parts.h"

#include <algorithm>
#include <array>
#include <random>
#include <span>

#include "protocol/base/bytes.h"
#include "server/scenes/redis_scripts.h"
#include "server/scenes/store_quota.h"
#include "server/system/log.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

constexpr std::uint64_t kPartBytes = 2 << 20;
constexpr std::size_t kAtOnce = 2; ///< parts in one pipeline
constexpr std::chrono::seconds kPipelinePatience{10};

std::string keyOf(const RedisParts& parts, std::uint64_t number) {
  return "gnomon:part:" + parts.token + ":" + std::to_string(number);
}

std::uint64_t sizeOf(const RedisParts& parts, std::uint64_t number) {
  return std::min(kPartBytes, parts.bytes - number * kPartBytes);
}

redis::Call partsCall(Clock::time_point end) {
  redis::Call call{std::min(Clock::now() + kPipelinePatience, end)};
  call.limits.bytes = kAtOnce * (kPartBytes + 64);
  return call;
}

Problem tooSlow() {
  return {ProblemCode::unavailable, "", "The server's Redis is too slow for a scene of this size.", "", ""};
}

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
      answered(redis.run(redis_scripts::kBegin, {sceneKey(id), kUsedKey, kBytesKey, kWritingKey},
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
      answered(redis.run(redis_scripts::kCommit,
                         {sceneKey(upload.id), kUsedKey, kBytesKey, kWritingKey, kScenesKey, summaryKey(upload.id)},
                         {upload.id, entryOf(parts), parts.token, std::to_string(parts.bytes),
                          std::to_string(parts.count()), upload.summary},
                         storeCall()));
  if (!committed) return committed.problems();
  return committed->integer == 1;
}

} // namespace

std::uint64_t RedisParts::count() const {
  return bytes / kPartBytes + (bytes % kPartBytes > 0 ? 1 : 0);
}

RedisParts newParts(std::uint64_t bytes) {
  std::random_device random;
  std::array<std::uint8_t, 16> name;
  std::generate(name.begin(), name.end(), [&] { return static_cast<std::uint8_t>(random()); });
  return {hexText(name), bytes};
}

std::optional<RedisParts> partsFrom(const redis::Reply& reply) {
  if (!reply.isArray() || reply.elements.size() != 3 || !reply.elements[0].isText()) return std::nullopt;
  const auto bytes = numberIn<std::uint64_t>(reply.elements[1].text);
  const auto count = numberIn<std::uint64_t>(reply.elements[2].text);
  if (!bytes || !count) return std::nullopt;
  RedisParts parts{reply.elements[0].text, *bytes};
  return parts.count() == *count ? std::optional(std::move(parts)) : std::nullopt;
}

Status writeParts(redis::Redis& redis, const RedisParts& parts, const FileDescriptor& file, Clock::duration patience) {
  const auto end = Clock::now() + patience;
  const std::string expires = std::to_string(std::chrono::seconds(kPartsExpire).count());
  for (std::uint64_t first = 0; first < parts.count(); first += kAtOnce) {
    if (Clock::now() >= end) return tooSlow();
    std::vector<redis::Command> commands;
    for (std::uint64_t i = first; i < std::min<std::uint64_t>(first + kAtOnce, parts.count()); ++i) {
      std::string piece(sizeOf(parts, i), '\0');
      const std::span room(reinterpret_cast<std::uint8_t*>(piece.data()), piece.size());
      if (!readAt(file, i * kPartBytes, room))
        return Problem{ProblemCode::internal, "", "A scene's bytes could not be read.", "", ""};
      commands.push_back({"SET", keyOf(parts, i), std::move(piece), "EX", expires});
    }
    const auto replies = redis.pipeline(commands, partsCall(end));
    if (!replies) return replies.problems();
    for (const redis::Reply& reply : *replies) {
      if (reply.isError()) return problemOf(reply);
    }
  }
  return Done{};
}

Result<ReadParts> readParts(redis::Redis& redis, const RedisParts& parts, Clock::duration patience) {
  const auto end = Clock::now() + patience;
  MemoryFileWriter writer;
  Sha256 hash;
  for (std::uint64_t first = 0; first < parts.count(); first += kAtOnce) {
    if (Clock::now() >= end) return tooSlow();
    std::vector<redis::Command> commands;
    for (std::uint64_t i = first; i < std::min<std::uint64_t>(first + kAtOnce, parts.count()); ++i) {
      commands.push_back({"GET", keyOf(parts, i)});
    }
    const auto replies = redis.pipeline(commands, partsCall(end));
    if (!replies) return replies.problems();
    for (std::size_t k = 0; k < replies->size(); ++k) {
      const redis::Reply& reply = (*replies)[k];
      if (reply.isError()) return problemOf(reply);
      if (!reply.isText() || reply.text.size() != sizeOf(parts, first + k)) return ReadParts{};
      writer.add(asBytes(reply.text));
      hash.add(reply.text);
    }
  }
  auto file = writer.finish();
  if (!file) return Problem{ProblemCode::unavailable, "", "The server has no memory for this scene now.", "", ""};
  return ReadParts{std::move(file), hash.hex()};
}

Problem problemOf(const redis::Reply& error) {
  logEvent("store", "Redis answers: " + error.text);
  if (error.isError("OOM")) return {ProblemCode::insufficientStorage, "", "The server's Redis is full.", "", ""};
  return {ProblemCode::unavailable, "", "The server's Redis can't read or write now.", "", ""};
}

Result<redis::Reply> answered(Result<redis::Reply> reply) {
  if (reply && reply->isError()) return problemOf(*reply);
  return reply;
}

redis::Call storeCall(std::size_t bytes) {
  constexpr std::chrono::seconds kStorePatience{3};
  return {Clock::now() + kStorePatience, {.bytes = bytes}};
}

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
    (void)redis.run(redis_scripts::kAbandon, {kWritingKey},
                    {entryOf(parts), parts.token, std::to_string(parts.count())}, storeCall());
  }
  return isNew;
}

} // namespace gnomon
