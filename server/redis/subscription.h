#pragma once

#include <functional>
#include <string>
#include <thread>

#include "server/redis/redis.h"
#include "server/system/file_descriptor.h"

namespace gnomon::redis {

/// The messages of a channel, on a thread and a connection of its own, for as long as this exists. Where the connection
/// ends, another is made: while a server is away, this is what finds it again.
class Subscription {
 public:
  struct Listener {
    std::function<void()> begun; ///< subscribed, also again: earlier messages may have been missed
    std::function<void(const std::string& message)> message; ///< in the order of the channel
  };

  /// Both functions are called by the subscription's thread; what they throw is logged. `redis` outlives it.
  Subscription(Redis& redis, std::string channel, Listener listener);
  ~Subscription();

 private:
  void run();
  bool listen(Connection& connection);

  Redis& redis_;
  const std::string channel_;
  const Listener listener_;
  StopSignal stop_;
  std::thread thread_;
};

} // namespace gnomon::redis
