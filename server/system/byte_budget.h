#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/system/client_identity.h"
#include "server/system/clock.h"

namespace gnomon {

/// For whom bytes are held. A client without a name has no share and waits for none: what a worker holds.
struct Holder {
  ClientIdentity client{};
  std::string request{}; ///< its id

  bool operator==(const Holder&) const = default;
};

class ByteLease;
struct SharedUse;

/// Bytes that all requests together may hold. Any thread.
///
/// One request of a client may hold whatever is free. All requests of a client together, and those of a site, hold at
/// most three quarters of what others leave (mayTake() of fair_shares.h). A client that found no room counts as waiting
/// until it has found some, at most as long as it was asked to stay away. While it waits, transfers of the site that
/// holds most have to keep a pace that follows from what they hold.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t bytes) : total_(bytes), left_(bytes) {}
  ByteBudget(const ByteBudget&) = delete;
  ByteBudget& operator=(const ByteBudget&) = delete;

  std::size_t total() const { return total_; }
  std::size_t used() const;

  /// Whether a further lease of so many bytes would have room now.
  bool hasRoom(const Holder& holder, std::size_t bytes) const;

  /// How long a client that found no room stays away: until the oldest transfer should be done, 1 to 10 s.
  int retryAfterSeconds(Clock::time_point now = Clock::now()) const;

  /// The bytes that a transfer has to move a second so that it is done within kTransferTime, where another client waits
  /// and no site holds more than the holder's. 0 = it need not hurry.
  std::size_t hurry(const Holder& holder, Clock::time_point now = Clock::now()) const;

  /// Whether a transfer that did not hurry is to be ended now: one a second, the first that asks.
  bool mayEndOne(Clock::time_point now = Clock::now());

  /// What a transfer may take in all while others wait.
  static constexpr std::chrono::seconds kTransferTime{60};

 private:
  friend class ByteLease;

  /// A client that found no room for so many bytes.
  struct Waiting {
    ClientIdentity client;
    std::size_t bytes = 0;
    Clock::time_point until{};
  };

  bool takeBy(ByteLease& lease, std::size_t bytes, Clock::time_point deadline);
  void giveBack(ByteLease& lease, std::size_t bytes);

  // With the mutex held:
  SharedUse useOf(const ClientIdentity& client, const ByteLease* own) const;
  void noteWaiting(const ByteLease& lease, std::size_t bytes, Clock::time_point now);
  std::chrono::seconds timeToStayAway(Clock::time_point now) const;

  const std::size_t total_;
  mutable std::mutex mutex_;
  std::condition_variable freed_;
  std::size_t left_;
  std::vector<const ByteLease*> leases_; ///< that hold something
  std::vector<Waiting> waiting_;         ///< one for each client
  Clock::time_point nextEnd_{};
};

/// What one request holds of a budget; given back when it goes.
class ByteLease {
 public:
  /// `expected`: what the request will need in all, where that is known.
  explicit ByteLease(ByteBudget& budget, Holder holder = {}, std::size_t expected = 0)
      : budget_(&budget), holder_(std::move(holder)), expected_(expected) {}
  ByteLease(const ByteLease&) = delete;
  ByteLease& operator=(const ByteLease&) = delete;
  ~ByteLease() { budget_->giveBack(*this, held_); }

  bool grow(std::size_t bytes) { return growBy(bytes, Clock::time_point::min()); }

  /// Waits for them until the deadline.
  bool growBy(std::size_t bytes, Clock::time_point deadline) { return budget_->takeBy(*this, bytes, deadline); }

  /// The same for as long as they are wanted, which is asked ten times a second.
  bool growBy(std::size_t bytes, Clock::time_point deadline, const std::function<bool()>& unwanted);

  /// REQUIRES: bytes <= held().
  void shrinkTo(std::size_t bytes) { budget_->giveBack(*this, held_ - bytes); }

  std::size_t held() const { return held_; }
  ByteBudget& budget() const { return *budget_; }
  const Holder& holder() const { return holder_; }

 private:
  friend class ByteBudget;

  ByteBudget* budget_;
  const Holder holder_;
  const std::size_t expected_;
  std::size_t held_ = 0;      ///< changed with the budget's mutex held
  Clock::time_point since_{}; ///< when it began to hold something
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
  bool await(ByteBudget& budget, const Holder& holder, std::size_t bytes, Clock::time_point deadline,
             const std::function<bool()>& unwanted);

  std::size_t held() const { return lease_ ? lease_->held() : 0; }

 private:
  std::unique_ptr<ByteLease> lease_;
};

} // namespace gnomon
