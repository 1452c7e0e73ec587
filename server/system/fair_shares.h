#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/system/client_identity.h"

/// Shares of what all clients use together: threads, places in queues, jobs.
namespace gnomon {

/// How much of something is taken, as one client sees it.
struct SharedUse {
  std::size_t capacity = 0;
  std::size_t taken = 0;    ///< by all
  std::size_t byClient = 0; ///< of these
  std::size_t bySite = 0;   ///< of these, those of its site, its own included
};

/// Whether the client may take one more: as long as it has no more than half of what other clients leave, and its site
/// no more than three quarters of what other sites leave. One is always allowed where one is left.
constexpr bool mayTakeOne(const SharedUse& use) {
  const std::size_t leftToClient = use.capacity - std::min(use.capacity, use.taken - use.byClient);
  const std::size_t leftToSite = use.capacity - std::min(use.capacity, use.taken - use.bySite);
  return use.taken < use.capacity && use.byClient < std::max<std::size_t>(leftToClient / 2, 1) &&
         use.bySite < std::max<std::size_t>(leftToSite * 3 / 4, 1);
}

/// Who holds how many. Any thread.
class FairShares {
 public:
  /// `most`: of one client, instead of the share that mayTakeOne() gives; 0 = that share.
  explicit FairShares(std::size_t capacity, std::size_t most = 0) : capacity_(capacity), most_(most) {}

  /// False where this client has its share, or all are taken.
  bool take(const ClientIdentity& client) {
    const std::lock_guard lock(mutex_);
    const SharedUse use{capacity_, taken_, countOf(byName_, client.name), countOf(bySite_, client.site)};
    if (most_ > 0 ? use.taken >= capacity_ || use.byClient >= most_ : !mayTakeOne(use)) return false;
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
