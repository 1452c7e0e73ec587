#include "server/system/byte_budget.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "server/system/fair_shares.h"

namespace gnomon {

std::size_t ByteBudget::used() const {
  const std::lock_guard lock(mutex_);
  return total_ - left_;
}

bool ByteBudget::hasRoom(const Holder& holder, std::size_t bytes) const {
  const std::lock_guard lock(mutex_);
  return mayTake(useOf(holder.client, nullptr), bytes, Share::threeQuarters);
}

int ByteBudget::retryAfterSeconds(Clock::time_point now) const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(timeToStayAway(now).count());
}

std::size_t ByteBudget::hurry(const Holder& holder, Clock::time_point now) const {
  const std::lock_guard lock(mutex_);
  const bool isWaitedFor = std::any_of(waiting_.begin(), waiting_.end(), [&](const Waiting& each) {
    return each.until > now && each.bytes > left_ && each.client.name != holder.client.name;
  });
  if (!isWaitedFor) return 0;
  std::map<std::string_view, std::size_t> ofSites;
  std::size_t own = 0;
  for (const ByteLease* each : leases_) {
    ofSites[each->holder_.client.site] += each->held_;
    if (each->holder_ == holder) own += each->held_;
  }
  const std::size_t ofSite = ofSites[holder.client.site];
  const bool holdsMost =
      std::all_of(ofSites.begin(), ofSites.end(), [&](const auto& each) { return each.second <= ofSite; });
  return holdsMost ? own / static_cast<std::size_t>(kTransferTime.count()) : 0;
}

bool ByteBudget::mayEndOne(Clock::time_point now) {
  constexpr std::chrono::seconds kBetween{1}; // so that what it gives back is seen before the next is ended
  const std::lock_guard lock(mutex_);
  if (now < nextEnd_) return false;
  nextEnd_ = now + kBetween;
  return true;
}

bool ByteBudget::takeBy(ByteLease& lease, std::size_t bytes, Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  const auto enough = [&] {
    return mayTake(useOf(lease.holder_.client, &lease), lease.held_ + bytes, Share::threeQuarters);
  };
  if (!enough()) {
    noteWaiting(lease, bytes, Clock::now());
    if (Clock::now() >= deadline || !freed_.wait_until(lock, deadline, enough)) return false;
  }
  std::erase_if(waiting_, [&](const Waiting& each) { return each.client.name == lease.holder_.client.name; });
  if (bytes == 0) return true;
  if (lease.held_ == 0) {
    lease.since_ = Clock::now();
    leases_.push_back(&lease);
  }
  lease.held_ += bytes;
  left_ -= bytes;
  return true;
}

void ByteBudget::giveBack(ByteLease& lease, std::size_t bytes) {
  if (bytes == 0) return;
  {
    const std::lock_guard lock(mutex_);
    lease.held_ -= bytes;
    left_ += bytes;
    if (lease.held_ == 0) std::erase(leases_, &lease);
  }
  freed_.notify_all();
}

/// Without what a lease of the client's own holds.
SharedUse ByteBudget::useOf(const ClientIdentity& client, const ByteLease* own) const {
  SharedUse use{.capacity = total_, .taken = total_ - left_ - (own != nullptr ? own->held_ : 0)};
  for (const ByteLease* each : leases_) {
    const ClientIdentity& other = each->holder_.client;
    if (each == own || other.name.empty()) continue;
    use.byClient += other.name == client.name ? each->held_ : 0;
    use.bySite += other.site == client.site ? each->held_ : 0;
  }
  return use;
}

/// A client that asks for more than its share of everything does not count as waiting for others.
void ByteBudget::noteWaiting(const ByteLease& lease, std::size_t bytes, Clock::time_point now) {
  constexpr std::chrono::seconds kComing{2}; // a client that was asked to come again is there by then
  const ClientIdentity& client = lease.holder_.client;
  if (client.name.empty()) return;
  const std::size_t beside = useOf(client, &lease).byClient;
  const std::size_t wanted = std::max(lease.held_ + bytes, lease.expected_);
  std::erase_if(waiting_, [&](const Waiting& each) { return each.client.name == client.name || each.until <= now; });
  if (!mayTake({total_, beside, beside, beside}, wanted, Share::threeQuarters)) return;
  waiting_.push_back({client, wanted, now + timeToStayAway(now) + kComing});
}

std::chrono::seconds ByteBudget::timeToStayAway(Clock::time_point now) const {
  constexpr std::chrono::seconds kLeast{1}, kMost{10}; // a transfer that is too slow is ended by then
  auto soonest = now + kMost;
  for (const ByteLease* each : leases_) soonest = std::min(soonest, each->since_ + kTransferTime);
  return std::max(kLeast, std::chrono::ceil<std::chrono::seconds>(soonest - now));
}

bool ByteLease::growBy(std::size_t bytes, Clock::time_point deadline, const std::function<bool()>& unwanted) {
  constexpr std::chrono::milliseconds kPiece{100};
  while (!growBy(bytes, std::min(deadline, Clock::now() + kPiece))) {
    if (Clock::now() >= deadline || unwanted()) return false;
  }
  return true;
}

bool ReplyRoom::await(ByteBudget& budget, const Holder& holder, std::size_t bytes, Clock::time_point deadline,
                      const std::function<bool()>& unwanted) {
  const std::size_t needed = bytes > kSmallReply ? std::min(bytes, budget.total()) : 0;
  if (needed <= held()) return true;
  lease_.reset();
  auto lease = std::make_unique<ByteLease>(budget, holder, needed);
  if (!lease->growBy(needed, deadline, unwanted)) return false;
  lease_ = std::move(lease);
  return true;
}

} // namespace gnomon
