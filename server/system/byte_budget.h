#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "server/system/clock.h"

namespace gnomon {

/// Bytes that all requests together may hold. Any thread.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t bytes) : total_(bytes), left_(bytes) {}

  std::size_t total() const { return total_; }

  std::size_t used() const {
    const std::lock_guard lock(mutex_);
    return total_ - left_;
  }

  bool take(std::size_t bytes) { return takeBy(bytes, Clock::time_point::min()); }

  /// Waits until there are so many; false where the deadline comes first.
  bool takeBy(std::size_t bytes, Clock::time_point deadline) {
    std::unique_lock lock(mutex_);
    const auto enough = [&] { return left_ >= bytes; };
    if (!enough() && (Clock::now() >= deadline || !freed_.wait_until(lock, deadline, enough))) return false;
    left_ -= bytes;
    return true;
  }

  void giveBack(std::size_t bytes) {
    {
      const std::lock_guard lock(mutex_);
      left_ += bytes;
    }
    freed_.notify_all();
  }

 private:
  const std::size_t total_;
  mutable std::mutex mutex_;
  std::condition_variable freed_;
  std::size_t left_;
};

/// What one request holds of a budget; given back when it goes.
class ByteLease {
 public:
  explicit ByteLease(ByteBudget& budget) : budget_(&budget) {}
  ByteLease(const ByteLease&) = delete;
  ByteLease& operator=(const ByteLease&) = delete;
  ~ByteLease() { budget_->giveBack(held_); }

  bool grow(std::size_t bytes) { return growBy(bytes, Clock::time_point::min()); }

  /// Waits for them until the deadline.
  bool growBy(std::size_t bytes, Clock::time_point deadline) {
    if (!budget_->takeBy(bytes, deadline)) return false;
    held_ += bytes;
    return true;
  }

  /// The same for as long as they are wanted, which is asked ten times a second.
  bool growBy(std::size_t bytes, Clock::time_point deadline, const std::function<bool()>& unwanted) {
    constexpr std::chrono::milliseconds kPiece{100};
    while (!growBy(bytes, std::min(deadline, Clock::now() + kPiece))) {
      if (Clock::now() >= deadline || unwanted()) return false;
    }
    return true;
  }

  /// REQUIRES: bytes <= held().
  void shrinkTo(std::size_t bytes) {
    budget_->giveBack(held_ - bytes);
    held_ = bytes;
  }

  std::size_t held() const { return held_; }

 private:
  ByteBudget* budget_;
  std::size_t held_ = 0;
};

/// Replies up to this size need no room: problems and probes.
inline constexpr std::size_t kSmallReply = 64 * 1024;

/// What the bytes of one reply hold of the budget for replies, from before they are read until the client has them. A
/// copy holds nothing: the sender of the copied bytes takes room for them.
class ReplyRoom {
 public:
  ReplyRoom() = default;
  ReplyRoom(const ReplyRoom&) {}
  ReplyRoom(ReplyRoom&&) noexcept = default;
  ReplyRoom& operator=(ReplyRoom other) noexcept {
    lease_ = std::move(other.lease_);
    return *this;
  }

  /// Waits for room for a reply of so many bytes, and holds nothing while it waits; nothing is waited for where it
  /// holds as much already. One reply alone may be larger than the budget. False where the deadline comes first, or
  /// `unwanted` says so, which is asked ten times a second: then it holds nothing.
  bool await(ByteBudget& budget, std::size_t bytes, Clock::time_point deadline, const std::function<bool()>& unwanted) {
    const std::size_t needed = bytes > kSmallReply ? std::min(bytes, budget.total()) : 0;
    if (needed <= held()) return true;
    lease_.reset();
    auto lease = std::make_unique<ByteLease>(budget);
    if (!lease->growBy(needed, deadline, unwanted)) return false;
    lease_ = std::move(lease);
    return true;
  }

  std::size_t held() const { return lease_ ? lease_->held() : 0; }

 private:
  std::unique_ptr<ByteLease> lease_;
};

} // namespace gnomon
