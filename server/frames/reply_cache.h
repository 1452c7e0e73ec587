#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "protocol/spec/frame_spec.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"

namespace gnomon {

/// The entity tag of a frame: of the scene, the spec, the renderer and the form. Strong where its bytes are the same
/// every time; weak where it tellsTimes.
std::string frameEtag(std::string_view sceneId, const FrameSpec& spec, std::string_view fingerprint, FrameForm form);

/// The value of Repr-Digest (RFC 9530) for a body: sha-256=:BASE64:
std::string reprDigest(std::string_view body);

/// What a cache holds, and of how much use it was.
struct CacheUse {
  std::size_t bytes = 0;
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;
};

/// A reply that was kept, and its entity tag.
struct KeptReply {
  std::string etag;
  std::shared_ptr<const HttpReply> reply;
};

/// Replies that hold a picture, by entity tag, within a budget of bytes; the least recently used are dropped first. The
/// tag names every byte of the body, so that none is ever out of date. Any thread.
class ReplyCache {
 public:
  explicit ReplyCache(std::size_t budgetBytes) : budget_(budgetBytes) {}

  /// nullptr = it is not there. The reply has a Cache-Status (RFC 9211) and its Repr-Digest, and no stages.
  std::shared_ptr<const HttpReply> find(const std::string& etag);

  /// The same for a request that has not found it before; counts nothing.
  std::shared_ptr<const HttpReply> findAgain(const std::string& etag);

  /// By a request that had this reply before (remember): its tag needn't be made again. Counts only what it finds.
  std::optional<KeptReply> findRequest(const std::string& request);

  /// Such a request, of at most 1 KiB; a reply knows the last four. Nothing where the tag's reply is not kept.
  void remember(const std::string& request, const std::string& etag);

  CacheUse use();

  /// Keeps a reply of status 200, unless it is larger than an eighth of the budget.
  void keep(const std::string& etag, const HttpReply& reply);

 private:
  struct Entry {
    KeptReply kept;
    std::list<std::string> requests{}; ///< that are remembered, the newest first
  };
  using Entries = std::list<Entry>;

  const Entry* lookUp(const std::unordered_map<std::string, Entries::iterator>& by, const std::string& name);
  void dropLast();

  std::mutex mutex_;
  const std::size_t budget_;
  CacheUse use_;
  Entries entries_; ///< most recently used first
  std::unordered_map<std::string, Entries::iterator> byTag_;
  std::unordered_map<std::string, Entries::iterator> byRequest_;
};

} // namespace gnomon
