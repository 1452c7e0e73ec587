#include "server/scenes/redis_backend.h"

#include <algorithm>
#include <functional>

#include "protocol/base/scene_bundle.h"
#include "server/scenes/redis_scripts.h"
#include "server/system/log.h"
#include "server/system/numbers.h"
#include "server/wire/bundle.h"

namespace gnomon {
namespace {

constexpr std::size_t kSummaryReply = SceneBackend::kMaxSummaryBytes + 1024;

Problem tooLargeForMemory(std::size_t limit, std::uint64_t bytes) {
  return {ProblemCode::tooLarge, "",
          "The scene is larger than the server's memory for bundles (--bundle-memory-bytes).",
          std::to_string(limit) + " bytes", std::to_string(bytes) + " bytes"};
}

} // namespace

RedisBackend::RedisBackend(std::shared_ptr<redis::Redis> redis, Options options)
    : redis_(std::move(redis)),
      options_(options),
      channel_("gnomon:removed:" + std::to_string(redis_->address().database)), // channels know no databases
      memory_(options.memoryBytes, options.memoryScenes),
      delay_(options.age),
      removals_(*redis_, channel_,
                {[this] { checkMemory(); },
                 [this](const std::string& id) {
                   if (isSceneId(id)) forget(id);
                 }}) {}

/// Of these scenes, those that are not there; the others are used now.
Result<std::vector<std::string>> RedisBackend::missing(const std::vector<std::string>& ids) {
  std::vector<std::string> missing;
  if (ids.empty()) return missing;
  auto reply = answered(redis_->run(redis_scripts::kUse, {}, ids, storeCall()));
  if (!reply) return std::move(reply).problems();
  for (redis::Reply& id : reply->elements) missing.push_back(std::move(id.text));
  return missing;
}

/// A scene was removed, by whomever.
void RedisBackend::forget(const std::string& id) {
  memory_.remove(id);
  const std::lock_guard lock(telling_);
  if (listener_) listener_(id);
}

/// After a time in which notices of removals may have been lost.
void RedisBackend::checkMemory() {
  const auto ids = memory_.page("", options_.memoryScenes).ids;
  constexpr std::size_t kAtOnce = 1'000;
  for (std::size_t first = 0; first < ids.size(); first += kAtOnce) {
    const auto last = std::min(ids.size(), first + kAtOnce);
    std::vector<redis::Command> commands;
    for (std::size_t i = first; i < last; ++i) commands.push_back({"EXISTS", sceneKey(ids[i])});
    const auto replies = redis_->pipeline(commands, storeCall());
    if (!replies) return;
    for (std::size_t i = first; i < last; ++i) {
      const redis::Reply& reply = (*replies)[i - first];
      if (reply.isInteger() && reply.integer == 0) forget(ids[i]);
    }
  }
}

Status RedisBackend::contains(const std::string& id) {
  if (memory_.contains(id)) return Done{};
  const auto reply = answered(redis_->ask({"EXISTS", sceneKey(id)}, storeCall()));
  if (!reply) return reply.problems();
  if (reply->integer == 0) return unknownScene(id);
  return Done{};
}

Status RedisBackend::use(const std::string& id) {
  if (memory_.bundle(id)) {
    const std::lock_guard lock(mutex_);
    used_.insert(id);
    return Done{};
  }
  const auto gone = missing({id});
  if (!gone) return gone.problems();
  if (!gone->empty()) return unknownScene(id);
  return Done{};
}

Status RedisBackend::checkRoom(std::uint64_t bytes) {
  return checkRedisRoom(*redis_, options_.quotaBytes, bytes);
}

Result<bool> RedisBackend::put(const std::string& id, BundlePtr bundle, std::uint64_t bytes,
                               const std::string& summary) {
  if (bytes > options_.memoryBytes) return tooLargeForMemory(options_.memoryBytes, bytes); // it could never be read
  auto isNew = uploadToRedis(*redis_, options_.quotaBytes, {id, *bundle, bytes, summary});
  if (isNew && *isNew) (void)keepInMemory(id, std::move(bundle), bytes, summary); // it may be removed by now
  return isNew;
}

/// A removed scene is published after its removal: what is in memory first, and found in Redis then, is covered.
Status RedisBackend::keepInMemory(const std::string& id, BundlePtr bundle, std::uint64_t bytes,
                                  const std::string& summary) {
  memory_.put(id, std::move(bundle), bytes, summary);
  const auto reply = answered(redis_->ask({"EXISTS", sceneKey(id)}, storeCall()));
  if (reply && reply->integer == 1) return Done{};
  memory_.remove(id);
  if (!reply) return reply.problems();
  return unknownScene(id);
}

Result<StoredBundle> RedisBackend::bundle(const std::string& id) {
  if (BundlePtr kept = memory_.bundle(id)) {
    ++hits_;
    const std::lock_guard lock(mutex_);
    used_.insert(id);
    return StoredBundle{std::move(kept), false};
  }
  std::unique_lock lock(fetching_[std::hash<std::string>()(id) % fetching_.size()], kForScene);
  if (!lock) return Problem{ProblemCode::unavailable, "", "The server's Redis is too slow for this scene.", "", ""};
  if (BundlePtr kept = memory_.bundle(id)) return StoredBundle{std::move(kept), false};
  ++misses_;
  return fetch(id);
}

/// Reads a scene into memory. Its bytes are those that its id names.
Result<StoredBundle> RedisBackend::fetch(const std::string& id) {
  redis::Command fields{"HMGET", sceneKey(id)};
  fields.insert(fields.end(), kPartsFields.begin(), kPartsFields.end());
  auto replies = redis_->pipeline({std::move(fields), {"GET", summaryKey(id)}}, storeCall(kSummaryReply));
  if (!replies) return std::move(replies).problems();
  for (const redis::Reply& reply : *replies) {
    if (reply.isError()) return problemOf(reply);
  }
  const auto parts = partsFrom(replies->front());
  if (!parts) return unknownScene(id);
  if (parts->bytes > options_.memoryBytes) return tooLargeForMemory(options_.memoryBytes, parts->bytes);
  auto read = readParts(*redis_, *parts, kForScene);
  if (!read) return std::move(read).problems();
  if (!read->file || read->sha256 != id) {
    if (const Status there = contains(id); !there) return there.problems(); // removed meanwhile
    setAside(id);
    return Problem{ProblemCode::notFound, "id", "The stored bytes of this scene were damaged. Upload it again.", "",
                   id};
  }
  const auto file = std::make_shared<const FileDescriptor>(*std::move(read->file));
  const Status kept = keepInMemory(id, file, parts->bytes, replies->back().text);
  if (!kept) return kept.problems();
  return StoredBundle{file, false};
}

Result<ScenePage> RedisBackend::page(std::string_view after, std::size_t limit) {
  const std::string from = after.empty() ? "-" : "(" + std::string(after);
  auto reply = answered(redis_->ask({"ZRANGEBYLEX", kScenesKey, from, "+", "LIMIT", "0", std::to_string(limit + 1)},
                                    storeCall(128 * (limit + 2))));
  if (!reply) return std::move(reply).problems();
  ScenePage page;
  for (redis::Reply& id : reply->elements) {
    if (isSceneId(id.text)) page.ids.push_back(std::move(id.text));
  }
  page.hasMore = page.ids.size() > limit;
  page.ids.resize(std::min(page.ids.size(), limit));
  return page;
}

StoreSize RedisBackend::size() {
  const auto replies = redis_->pipeline({{"ZCARD", kScenesKey}, {"GET", kBytesKey}}, storeCall());
  const std::lock_guard lock(mutex_);
  if (!replies) return size_;
  size_.scenes = static_cast<std::size_t>(std::max<std::int64_t>(replies->front().integer, 0));
  size_.bytes = numberIn<std::uint64_t>(replies->back().text).value_or(0);
  return size_;
}

StoreState RedisBackend::state() {
  const redis::Use use = redis_->use();
  return {use.isReachable, use.connections, use.calls, use.failures, memory_.size(), hits_, misses_};
}

std::optional<std::string> RedisBackend::summary(const std::string& id) {
  if (auto kept = memory_.summary(id); kept && !kept->empty()) return kept;
  auto reply = redis_->ask({"GET", summaryKey(id)}, storeCall(kSummaryReply));
  if (!reply || !reply->isText()) return std::nullopt;
  return std::move(reply->text);
}

void RedisBackend::keepSummary(const std::string& id, const std::string& summary) {
  memory_.replaceSummary(id, summary);
  const auto kept =
      answered(redis_->run(redis_scripts::kKeepSummary, {sceneKey(id), summaryKey(id)}, {summary}, storeCall()));
  if (!kept) logEvent("store", "A summary could not be written.");
}

void RedisBackend::setAside(const std::string& id) {
  logEvent("store", "The stored bytes of scene " + id + " do not match its id. They are removed.");
  (void)remove(id);
}

Status RedisBackend::remove(const std::string& id) {
  const auto reply = answered(redis_->run(redis_scripts::kRemove, {}, {id, channel_}, storeCall()));
  if (!reply) return reply.problems();
  memory_.remove(id);
  if (reply->integer == 0) return unknownScene(id);
  return Done{};
}

/// What was served from memory is used in Redis, too.
void RedisBackend::markUsed() {
  constexpr std::size_t kAtOnce = 1'000;
  std::set<std::string> used;
  {
    const std::lock_guard lock(mutex_);
    used.swap(used_);
  }
  std::vector<std::string> ids(used.begin(), used.end());
  while (!ids.empty()) {
    const std::size_t count = std::min(kAtOnce, ids.size());
    const auto gone = missing({ids.end() - static_cast<std::ptrdiff_t>(count), ids.end()});
    if (!gone) break;
    for (const std::string& id : *gone) forget(id);
    ids.resize(ids.size() - count);
  }
  const std::lock_guard lock(mutex_);
  used_.insert(ids.begin(), ids.end()); // next time
}

void RedisBackend::keepClean(const SceneListener& removed) {
  markUsed();
  if (options_.age.count() == 0) return;
  const std::string age = std::to_string(std::chrono::milliseconds(options_.age).count());
  const auto counts = answered(redis_->run(redis_scripts::kCountUnused, {}, {age}, storeCall()));
  if (!counts || counts->elements.size() != 2) return;
  const auto countAt = [&](std::size_t i) {
    return static_cast<std::size_t>(std::max<std::int64_t>(counts->elements[i].integer, 0));
  };
  if (!delay_.mayGo(countAt(0), countAt(1), Clock::now())) return;
  const auto reply = answered(redis_->run(redis_scripts::kRemoveUnused, {}, {age, channel_, "100"}, storeCall()));
  if (!reply) return;
  for (const redis::Reply& id : reply->elements) {
    if (!isSceneId(id.text)) continue;
    memory_.remove(id.text);
    removed(id.text);
  }
}

void RedisBackend::onRemoved(SceneListener listener) {
  const std::lock_guard lock(telling_);
  listener_ = std::move(listener);
}

} // namespace gnomon
