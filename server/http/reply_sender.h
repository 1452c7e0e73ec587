#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "server/http/transfer_pace.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// How the sending of a reply ended.
enum class Delivery {
  whole,
  clientLeft,
  tooSlow,      ///< the client took it more slowly than its pace
  othersWaited, ///< TransferState::othersWaited
  shutdown      ///< the server waited for it no longer
};

/// Sends one reply. A client's pace is what its machine has acknowledged, not what this machine's kernel took: that may
/// be megabytes ahead.
class ReplySender {
 public:
  /// `fd` still belongs to the caller. `cut`: once raised, nothing is waited for.
  ReplySender(int fd, TransferPace pace, const StopSignal* cut = nullptr);

  /// Sends everything. Of more than kSmallReply bytes it returns once no more than so many are on their way: what the
  /// kernel holds beyond them, the caller's room for the bytes covers. After a failure it sends nothing further.
  /// `more`: other bytes follow at once, and may leave with these.
  Delivery send(std::string_view bytes, bool more = false);

  Delivery delivery() const { return delivery_; }

 private:
  std::optional<short> eventsBy(Clock::time_point until, short events) const;
  std::size_t onItsWay(Clock::time_point now);

  const int fd_;
  TransferPace pace_;
  const StopSignal* const cut_;
  Delivery delivery_ = Delivery::whole;
  std::size_t handedOver_;       ///< to the kernel, with what it had before
  std::size_t acknowledged_ = 0; ///< of that
  Clock::time_point ended_;      ///< the last send()
};

/// Sends everything at a pace of its own. False: not everything was sent.
bool sendAll(int fd, std::string_view bytes, const Pace& pace, const StopSignal* cut = nullptr);

} // namespace gnomon
