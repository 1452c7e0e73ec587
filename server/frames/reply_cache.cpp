#include "server/frames/reply_cache.h"

#include <utility>

namespace gnomon {

std::shared_ptr<const HttpReply> ReplyCache::find(const std::string& etag) {
  const std::lock_guard lock(mutex_);
  auto found = lookUp(etag);
  ++(found ? use_.hits : use_.misses);
  return found;
}

std::shared_ptr<const HttpReply> ReplyCache::findAgain(const std::string& etag) {
  const std::lock_guard lock(mutex_);
  return lookUp(etag);
}

CacheUse ReplyCache::use() {
  const std::lock_guard lock(mutex_);
  return use_;
}

/// With the mutex held.
std::shared_ptr<const HttpReply> ReplyCache::lookUp(const std::string& etag) {
  const auto known = byTag_.find(etag);
  if (known == byTag_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, known->second);
  return entries_.front().reply;
}

void ReplyCache::keep(const std::string& etag, const HttpReply& reply) {
  constexpr std::size_t kMostShare = 8;
  if (reply.status != 200 || reply.body.size() > budget_ / kMostShare) return;
  auto kept = std::make_shared<HttpReply>();
  kept->contentType = reply.contentType;
  kept->body = reply.body;
  kept->headers = {{"Cache-Status", "gnomon; hit"}};
  const std::lock_guard lock(mutex_);
  if (byTag_.contains(etag)) return;
  use_.bytes += kept->body.size();
  entries_.push_front({etag, std::move(kept)});
  byTag_[etag] = entries_.begin();
  while (use_.bytes > budget_) {
    use_.bytes -= entries_.back().reply->body.size();
    byTag_.erase(entries_.back().etag);
    entries_.pop_back();
  }
}

} // namespace gnomon
