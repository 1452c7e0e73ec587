#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "server/http/reply.h"

namespace gnomon {

/// What a cache holds, and of how much use it was.
struct CacheUse {
  std::size_t bytes = 0;
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;
};

/// Replies that hold a picture, by entity tag, within a budget of bytes; the least recently used are dropped first. The
/// tag names every byte of the body, so that none is ever out of date. Any thread.
class ReplyCache {
 public:
  explicit ReplyCache(std::size_t budgetBytes) : budget_(budgetBytes) {}

  /// nullptr = it is not there. The reply has a Cache-Status (RFC 9211), and no stages.
  std::shared_ptr<const HttpReply> find(const std::string& etag);

  /// The same for a request that has not found it before; counts nothing.
  std::shared_ptr<const HttpReply> findAgain(const std::string& etag);

  CacheUse use();

  /// Keeps a reply of status 200, unless it is larger than an eighth of the budget.
  void keep(const std::string& etag, const HttpReply& reply);

 private:
  struct Entry {
    std::string etag;
    std::shared_ptr<const HttpReply> reply;
  };

  std::shared_ptr<const HttpReply> lookUp(const std::string& etag);

  std::mutex mutex_;
  const std::size_t budget_;
  CacheUse use_;
  std::list<Entry> entries_; ///< most recently used first
  std::unordered_map<std::string, std::list<Entry>::iterator> byTag_;
};

} // namespace gnomon
