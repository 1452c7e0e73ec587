#include "server/http/reply_sender.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <poll.h>
#include <sys/socket.h>
#include <utility>

#include "server/http/socket_io.h"

namespace gnomon {

ReplySender::ReplySender(int fd, TransferPace pace, const StopSignal* cut)
    : fd_(fd), pace_(std::move(pace)), cut_(cut), handedOver_(unacknowledged(fd)), ended_(Clock::now()) {}

/// Waits until there is room in the kernel, or only until the time. `whole`: go on.
Delivery ReplySender::waitFor(bool room, Clock::time_point until) {
  std::array<pollfd, 2> waiting{
      {{fd_, static_cast<short>(room ? POLLOUT : 0), 0}, {cut_ ? cut_->fd() : -1, POLLIN, 0}}};
  ::poll(waiting.data(), waiting.size(), millisecondsUntil(until));
  if (waiting[1].revents != 0) return Delivery::shutdown;
  const bool isLost = !room && (waiting[0].revents & (POLLERR | POLLHUP)) != 0;
  return isLost ? Delivery::clientLeft : Delivery::whole;
}

Delivery ReplySender::send(std::string_view bytes, bool more) {
  constexpr std::chrono::milliseconds kShortest{1}, kLongest{50}; // no event says that bytes were acknowledged
  const std::size_t mayStay = bytes.size() > kSmallReply ? kSmallReply : std::numeric_limits<std::size_t>::max();
  const int flags = MSG_NOSIGNAL | MSG_DONTWAIT | (more ? MSG_MORE : 0);
  auto pause = kShortest;
  pace_.paused(Clock::now() - ended_);
  while (delivery_ == Delivery::whole) {
    const ssize_t count = bytes.empty() ? 0 : ::send(fd_, bytes.data(), bytes.size(), flags);
    if (count < 0 && !mayComeLater(errno)) {
      delivery_ = Delivery::clientLeft;
      break;
    }
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    handedOver_ += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    const auto now = Clock::now();
    const std::size_t onItsWay = std::min(unacknowledged(fd_), handedOver_ - acknowledged_);
    pace_.moved(handedOver_ - onItsWay - acknowledged_, now);
    acknowledged_ = handedOver_ - onItsWay;
    if (bytes.empty() && onItsWay <= mayStay) break;
    if (count > 0) continue;
    const TransferState state = pace_.state(now);
    if (state == TransferState::goesOn) {
      delivery_ = waitFor(!bytes.empty(), bytes.empty() ? now + pause : pace_.wait(now));
      pause = bytes.empty() ? std::min(2 * pause, kLongest) : kShortest;
    } else {
      delivery_ = state == TransferState::tooSlow ? Delivery::tooSlow : Delivery::othersWaited;
    }
  }
  ended_ = Clock::now();
  return delivery_;
}

bool sendAll(int fd, std::string_view bytes, const Pace& pace, const StopSignal* cut) {
  return ReplySender(fd, TransferPace(pace, nullptr, {}), cut).send(bytes) == Delivery::whole;
}

} // namespace gnomon
