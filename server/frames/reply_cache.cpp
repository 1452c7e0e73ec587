#include "server/frames/reply_cache.h"

#include <utility>

namespace gnomon {

std::shared_ptr<const HttpReply> ReplyCache::find(const std::string& etag) {
  const std::lock_guard lock(mutex_);
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
  bytes_ += kept->body.size();
  entries_.push_front({etag, std::move(kept)});
  byTag_[etag] = entries_.begin();
  while (bytes_ > budget_) {
    bytes_ -= entries_.back().reply->body.size();
    byTag_.erase(entries_.back().etag);
    entries_.pop_back();
  }
}

} // namespace gnomon
