#include "server/http/client_shares.h"

namespace gnomon {

bool ClientShares::take(const std::string& network) {
  const std::lock_guard lock(mutex_);
  std::size_t& taken = taken_[network];
  if (taken >= most_) return false;
  ++taken;
  return true;
}

void ClientShares::giveBack(const std::string& network) {
  const std::lock_guard lock(mutex_);
  const auto found = taken_.find(network);
  if (--found->second == 0) taken_.erase(found);
}

} // namespace gnomon
