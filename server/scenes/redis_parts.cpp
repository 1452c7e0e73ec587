#include "server/scenes/redis_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <random>
#include <unistd.h>

#include "protocol/base/bytes.h"
#include "server/system/log.h"
#include "server/system/memory_file.h"

namespace gnomon {
namespace {

constexpr std::uint64_t kPartBytes = 2 << 20;
constexpr std::size_t kAtOnce = 2;            ///< parts in one pipeline
constexpr std::chrono::seconds kPatience{10}; ///< for one pipeline

std::string keyOf(const RedisParts& parts, std::uint64_t number) {
  return "gnomon:part:" + parts.token + ":" + std::to_string(number);
}

std::uint64_t sizeOf(const RedisParts& parts, std::uint64_t number) {
  return std::min(kPartBytes, parts.bytes - number * kPartBytes);
}

std::optional<std::uint64_t> numberOf(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Empty where the file is shorter.
std::string pieceOf(const FileDescriptor& file, std::uint64_t from, std::uint64_t size) {
  std::string piece(size, '\0');
  std::size_t read = 0;
  while (read < piece.size()) {
    const ssize_t count =
        ::pread(file.get(), piece.data() + read, piece.size() - read, static_cast<off_t>(from + read));
    if (count <= 0) return {};
    read += static_cast<std::size_t>(count);
  }
  return piece;
}

redis::Call partsCall(Clock::time_point end) {
  redis::Call call{std::min(Clock::now() + kPatience, end)};
  call.limits.bytes = kAtOnce * (kPartBytes + 64);
  return call;
}

Problem tooSlow() {
  return {ProblemCode::unavailable, "", "The server's Redis is too slow for a scene of this size.", "", ""};
}

} // namespace

std::uint64_t RedisParts::count() const {
  return (bytes + kPartBytes - 1) / kPartBytes;
}

RedisParts newParts(std::uint64_t bytes) {
  std::random_device random;
  std::array<std::uint8_t, 16> name;
  std::generate(name.begin(), name.end(), [&] { return static_cast<std::uint8_t>(random()); });
  return {hexText(name), bytes};
}

std::optional<RedisParts> partsFrom(const redis::Reply& reply) {
  if (!reply.isArray() || reply.elements.size() != 3 || !reply.elements[0].isText()) return std::nullopt;
  const auto bytes = numberOf(reply.elements[1].text);
  const auto count = numberOf(reply.elements[2].text);
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
      std::string piece = pieceOf(file, i * kPartBytes, sizeOf(parts, i));
      if (piece.empty()) return Problem{ProblemCode::internal, "", "A scene's bytes could not be read.", "", ""};
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

} // namespace gnomon
