#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

namespace gnomon {

/// Shares of the threads that serve requests, one for each client. Any thread.
class ClientShares {
 public:
  explicit ClientShares(std::size_t most) : most_(most) {}

  /// False where this client has its share already.
  bool take(const std::string& network);
  void giveBack(const std::string& network);

 private:
  const std::size_t most_;
  std::mutex mutex_;
  std::map<std::string, std::size_t> taken_;
};

} // namespace gnomon
