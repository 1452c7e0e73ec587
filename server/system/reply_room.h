#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

#include "server/system/byte_budget.h"

namespace gnomon {

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
