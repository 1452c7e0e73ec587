#include "server/frames/reply_cache.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/base/bytes.h"
#include "protocol/json/json_codec.h"

namespace gnomon {

std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form) {
  Sha256 hash;
  for (const std::string_view part : {sceneId, std::string_view("\n"), fingerprint, std::string_view("\n"),
                                      mediaTypeOf(form), std::string_view("\n"), mediaTypeOf(form.format)}) {
    hash.add(part);
  }
  hash.add("\n");
  hash.add(jsonText(toJson(spec)));
  const std::string tag = '"' + hash.hex() + '"';
  return tellsTimes(form) ? "W/" + tag : tag;
}

std::string reprDigest(std::string_view body) {
  Sha256 hash;
  hash.add(body);
  return "sha-256=:" + base64Text(hash.bytes()) + ':';
}

std::shared_ptr<const HttpReply> ReplyCache::find(const std::string& etag) {
  const std::lock_guard lock(mutex_);
  const Entry* const found = lookUp(byTag_, etag);
  ++(found ? use_.hits : use_.misses);
  return found ? found->kept.reply : nullptr;
}

std::shared_ptr<const HttpReply> ReplyCache::findAgain(const std::string& etag) {
  const std::lock_guard lock(mutex_);
  const Entry* const found = lookUp(byTag_, etag);
  return found ? found->kept.reply : nullptr;
}

std::optional<KeptReply> ReplyCache::findRequest(const std::string& request) {
  const std::lock_guard lock(mutex_);
  const Entry* const found = lookUp(byRequest_, request);
  if (!found) return std::nullopt;
  ++use_.hits;
  return found->kept;
}

void ReplyCache::remember(const std::string& request, const std::string& etag) {
  constexpr std::size_t kMostBytes = 1024, kMost = 4;
  const std::lock_guard lock(mutex_);
  const auto known = byTag_.find(etag);
  if (known == byTag_.end() || request.size() > kMostBytes || byRequest_.contains(request)) return;
  std::list<std::string>& requests = known->second->requests;
  requests.push_front(request);
  byRequest_[request] = known->second;
  if (requests.size() > kMost) {
    byRequest_.erase(requests.back());
    requests.pop_back();
  }
}

CacheUse ReplyCache::use() {
  const std::lock_guard lock(mutex_);
  return use_;
}

/// With the mutex held, as are all below. What is found is the most recently used.
const ReplyCache::Entry* ReplyCache::lookUp(const std::unordered_map<std::string, Entries::iterator>& by,
                                            const std::string& name) {
  const auto known = by.find(name);
  if (known == by.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, known->second);
  return &entries_.front();
}

void ReplyCache::dropLast() {
  const Entry& last = entries_.back();
  use_.bytes -= last.kept.reply->body.size();
  for (const std::string& request : last.requests) byRequest_.erase(request);
  byTag_.erase(last.kept.etag);
  entries_.pop_back();
}

void ReplyCache::keep(const std::string& etag, const HttpReply& reply) {
  constexpr std::size_t kMostShare = 8;
  if (reply.status != 200 || reply.body.size() > budget_ / kMostShare) return;
  auto kept = std::make_shared<HttpReply>();
  kept->contentType = reply.contentType;
  kept->body = reply.body;
  kept->headers = {{"Cache-Status", "gnomon; hit"}};
  std::copy_if(reply.headers.begin(), reply.headers.end(), std::back_inserter(kept->headers),
               [](const auto& header) { return header.first == "Repr-Digest"; });
  const std::lock_guard lock(mutex_);
  if (byTag_.contains(etag)) return;
  use_.bytes += kept->body.size();
  entries_.push_front({{etag, std::move(kept)}});
  byTag_[etag] = entries_.begin();
  while (use_.bytes > budget_) dropLast();
}

} // namespace gnomon
