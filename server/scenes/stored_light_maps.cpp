#include "server/scenes/stored_light_maps.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <vector>

#include "server/scenes/redis_parts.h"
#include "server/scenes/redis_scripts.h"
#include "server/scenes/whole_file.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

/// Of each map in a directory: nothing that is not one is ever touched.
std::vector<std::filesystem::directory_entry> mapsIn(const std::string& path) {
  std::vector<std::filesystem::directory_entry> maps;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".map") maps.push_back(*entry);
  }
  return maps;
}

constexpr std::chrono::seconds kForMap{8}; ///< a worker waits little longer, and then bakes it

redis::Call mapCall() {
  constexpr std::chrono::seconds kPatience{2};
  return {Clock::now() + kPatience};
}

} // namespace

LightMapDirectory::LightMapDirectory(std::string path, std::size_t budgetBytes)
    : path_(std::move(path)), budgetBytes_(budgetBytes) {
  removeUnfinished(path_);
  drop();
}

FileDescriptor LightMapDirectory::open(const std::string& key) {
  if (!isLightMapKey(key)) return {};
  const std::string path = pathOf(key);
  FileDescriptor file = openRegular(path, O_RDONLY);
  std::error_code gone;
  if (file) std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now(), gone);
  return file;
}

void LightMapDirectory::write(const std::string& key, const FileDescriptor& lightMap) {
  const auto bytes = sizeOf(lightMap);
  if (!isLightMapKey(key) || !bytes || *bytes > budgetBytes_) return;
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (!placeFile(pathOf(key), [&](const FileSink& sink) { eachPiece(lightMap, sink); })) {
    const std::string reason = std::error_code(errno, std::generic_category()).message();
    logEvent("store", "A light map could not be written: " + reason + ".");
  }
  drop();
}

void LightMapDirectory::removeScene(const std::string& sceneId) {
  for (const auto& map : mapsIn(path_)) {
    std::error_code ignored;
    if (map.path().filename().string().starts_with(sceneId + "-")) std::filesystem::remove(map.path(), ignored);
  }
}

void LightMapDirectory::cleanUp() {
  removeUnfinished(path_);
}

/// Down to the budget.
void LightMapDirectory::drop() {
  const std::lock_guard lock(dropping_);
  struct Kept {
    std::filesystem::path path;
    std::filesystem::file_time_type used;
    std::size_t bytes = 0;
  };
  std::vector<Kept> all;
  for (const auto& map : mapsIn(path_)) {
    std::error_code gone; // another process may have removed it
    const Kept kept{map.path(), map.last_write_time(gone), static_cast<std::size_t>(map.file_size(gone))};
    if (!gone) all.push_back(kept);
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used > b.used; });
  std::size_t bytes = 0;
  for (const Kept& kept : all) {
    bytes += kept.bytes;
    std::error_code ignored;
    if (bytes > budgetBytes_) std::filesystem::remove(kept.path, ignored);
  }
}

FileDescriptor RedisLightMaps::open(const std::string& key) {
  if (!isLightMapKey(key)) return {};
  redis::Command fields{"HMGET", lightMapKey(key)};
  fields.insert(fields.end(), kPartsFields.begin(), kPartsFields.end());
  const auto reply = redis_->ask(fields, mapCall());
  const auto parts = reply ? partsFrom(*reply) : std::nullopt;
  if (!parts || parts->bytes > budgetBytes_) return {};
  auto read = readParts(*redis_, *parts, kForMap);
  if (!read || !read->file) return {};
  (void)redis_->run(redis_scripts::kUseMap, {}, {key}, mapCall());
  return *std::move(read->file);
}

void RedisLightMaps::write(const std::string& key, const FileDescriptor& lightMap) {
  const auto bytes = sizeOf(lightMap);
  if (!isLightMapKey(key) || !bytes || *bytes == 0) return;
  const RedisParts parts = newParts(*bytes);
  if (parts.bytes > budgetBytes_) return;
  const std::string count = std::to_string(parts.count());
  if (writeParts(*redis_, parts, lightMap, kForMap)) {
    (void)redis_->run(redis_scripts::kCommitMap, {lightMapKey(key)},
                      {key, parts.token, std::to_string(parts.bytes), count, std::to_string(budgetBytes_)}, mapCall());
  } else {
    (void)redis_->run(redis_scripts::kAbandon, {kWritingKey}, {"", parts.token, count}, mapCall());
  }
}

void RedisLightMaps::removeScene(const std::string& sceneId) {
  (void)redis_->run(redis_scripts::kRemoveMaps, {}, {sceneId}, mapCall());
}

} // namespace gnomon
