#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/system/client_identity.h"

/// Shares of what all clients use together: threads, places in queues, jobs, bytes.
namespace gnomon {

/// How much of something is taken, as one client sees it.
struct SharedUse {
  std::uint64_t capacity = 0;
  std::uint64_t taken = 0;    ///< by all
  std::uint64_t byClient = 0; ///< of these
  std::uint64_t bySite = 0;   ///< of these, those of its site, its own included
};

/// Of what others leave, the part that one client may have.
enum class Share { half, threeQuarters };

/// Whether the client may take so many more: those that it has and these are at most its share of what other clients
/// leave, and those of its site three quarters of what other sites leave. One that has none may take all that is left.
constexpr bool mayTake(const SharedUse& use, std::uint64_t more, Share share) {
  const auto isWithin = [&](std::uint64_t own, std::uint64_t quarters) {
    const std::uint64_t left = use.capacity - std::min(use.capacity, use.taken - own);
    return own == 0 || own + more <= left * quarters / 4;
  };
  return more <= use.capacity - std::min(use.capacity, use.taken) &&
         isWithin(use.byClient, share == Share::half ? 2 : 3) && isWithin(use.bySite, 3);
}

/// Who holds how many. Any thread.
class FairShares {
 public:
  /// `most`: of one client, instead of half of what others leave; 0 = that half.
  explicit FairShares(std::size_t capacity, std::size_t most = 0) : capacity_(capacity), most_(most) {}

  std::size_t capacity() const { return capacity_; }

  /// False where this client has its share, or all are taken.
  bool take(const ClientIdentity& client) {
    const std::lock_guard lock(mutex_);
    const SharedUse use{capacity_, taken_, countOf(byName_, client.name), countOf(bySite_, client.site)};
    if (most_ > 0 ? use.taken >= capacity_ || use.byClient >= most_ : !mayTake(use, 1, Share::half)) return false;
    ++taken_;
    ++byName_[client.name];
    ++bySite_[client.site];
    return true;
  }

  void giveBack(const ClientIdentity& client) {
    const std::lock_guard lock(mutex_);
    --taken_;
    drop(byName_, client.name);
    drop(bySite_, client.site);
  }

  /// One of them, given back when its last copy goes; nullptr where take() is false.
  std::shared_ptr<void> place(const ClientIdentity& client) {
    if (!take(client)) return nullptr;
    return {this, [client](FairShares* shares) { shares->giveBack(client); }};
  }

 private:
  using Counts = std::map<std::string, std::size_t>;

  static std::size_t countOf(const Counts& counts, const std::string& name) {
    const auto found = counts.find(name);
    return found == counts.end() ? 0 : found->second;
  }
  static void drop(Counts& counts, const std::string& name) {
    const auto found = counts.find(name);
    if (--found->second == 0) counts.erase(found);
  }

  const std::size_t capacity_;
  const std::size_t most_;
  std::mutex mutex_;
  std::size_t taken_ = 0;
  Counts byName_;
  Counts bySite_;
};

} // namespace gnomon
