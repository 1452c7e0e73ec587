#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "server/redis/address.h"
#include "server/redis/reply.h"
#include "server/redis/stream.h"
#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon::redis {

/// How long a call may wait, and for how much.
struct Call {
  Clock::time_point deadline;
  ReplyLimits limits{};
  const StopSignal* cut = nullptr; ///< once it is raised, the call ends; nullptr = never
};

/// One connection, with user and database chosen. After a problem it is of no use any more. One thread.
///
/// Its problems are unavailable, with a reason for the log.
class Connection {
 public:
  static Result<std::unique_ptr<Connection>> open(const Address& address, const Call& call);

  /// Sends all commands and reads the reply to each, in order, while it sends.
  Result<std::vector<Reply>> exchange(std::span<const Command> commands, const Call& call);

  /// What the server sends by itself: one reply, or nothing at the deadline.
  Result<std::optional<Reply>> receive(const Call& call);

  /// Sends a command whose reply is left for receive().
  Status send(const Command& command, const Call& call);

  /// False where it has ended, or bytes have come that no command asked for.
  bool isQuiet();

 private:
  enum class Step { moved, timedOut, ended };

  explicit Connection(std::unique_ptr<Stream> stream) : stream_(std::move(stream)) {}
  Step step(std::string_view& unsent, const Call& call);
  Problem failure(Step step) const;

  std::unique_ptr<Stream> stream_;
  ReplyReader reader_;
};

} // namespace gnomon::redis
