#include "server/http/client_watch.h"

#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <utility>

#include "server/http/socket_io.h"

namespace gnomon {
namespace {

constexpr int kRoundTripMilliseconds = 10; ///< a reset that takes longer is found by the next call

/// Bytes of earlier replies that have not arrived yet: behind them an interim reply could be sent in part only.
bool isSending(int fd) {
  int unsent = 0;
  return ::ioctl(fd, SIOCOUTQ, &unsent) != 0 || unsent > 0;
}

} // namespace

bool ClientWatch::isReset(int milliseconds) const {
  pollfd waiting{fd_, 0, 0};
  return ::poll(&waiting, 1, milliseconds) > 0 && (waiting.revents & (POLLHUP | POLLERR)) != 0;
}

bool ClientWatch::left() {
  const std::lock_guard lock(mutex_);
  if (left_ || ended_) return left_;
  pollfd waiting{fd_, POLLRDHUP, 0};
  ::poll(&waiting, 1, 0);
  left_ = (waiting.revents & (POLLHUP | POLLERR)) != 0;
  if (!left_ && (waiting.revents & POLLRDHUP) != 0) {
    if (streaming_) {
      left_ = true;
    } else if (mayAsk_ && !isSending(fd_)) {
      mayAsk_ = false;
      left_ = !sendNow(fd_, "HTTP/1.1 100 Continue\r\n\r\n") || isReset(kRoundTripMilliseconds);
    }
  }
  return left_;
}

void ClientWatch::beginStream() {
  const std::lock_guard lock(mutex_);
  streaming_ = true;
}

void ClientWatch::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
}

} // namespace gnomon
