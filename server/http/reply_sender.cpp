#include "server/http/reply_sender.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <optional>
#include <poll.h>
#include <sys/socket.h>
#include <utility>

#include "server/http/socket_io.h"

namespace gnomon {

ReplySender::ReplySender(int fd, TransferPace pace, const StopSignal* cut)
    : fd_(fd), pace_(std::move(pace)), cut_(cut), handedOver_(unacknowledged(fd)), ended_(Clock::now()) {}

/// Waits for events of the socket, at most until the time; those that came. Nothing: it need wait no longer.
std::optional<short> ReplySender::eventsBy(Clock::time_point until, short events) const {
  std::array<pollfd, 2> waiting{{{fd_, events, 0}, {cut_ ? cut_->fd() : -1, POLLIN, 0}}};
  ::poll(waiting.data(), waiting.size(), millisecondsUntil(until));
  return waiting[1].revents != 0 ? std::nullopt : std::optional(waiting[0].revents);
}

/// Bytes that are not acknowledged yet.
std::size_t ReplySender::onItsWay(Clock::time_point now) {
  const std::size_t left = std::min(unacknowledged(fd_), handedOver_ - acknowledged_);
  pace_.moved(handedOver_ - left - acknowledged_, now);
  acknowledged_ = handedOver_ - left;
  return left;
}

Delivery ReplySender::send(std::string_view bytes, bool more) {
  constexpr std::chrono::milliseconds kShortest{1}, kLongest{50};
  const std::size_t mayStay = bytes.size() > kSmallReply ? kSmallReply : std::numeric_limits<std::size_t>::max();
  const int flags = MSG_NOSIGNAL | MSG_DONTWAIT | (more ? MSG_MORE : 0);
  auto pause = kShortest;     // no event says that bytes were acknowledged,
  short nextRequest = POLLIN; // but a client that has all of them may send its next request
  pace_.paused(Clock::now() - ended_);
  while (delivery_ == Delivery::whole) {
    const ssize_t count = bytes.empty() ? 0 : ::send(fd_, bytes.data(), bytes.size(), flags);
    if (count < 0 && !mayComeLater(errno)) delivery_ = Delivery::clientLeft;
    const auto taken = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    bytes.remove_prefix(taken);
    handedOver_ += taken;
    const auto now = Clock::now();
    if (onItsWay(now) <= mayStay && bytes.empty()) break;
    if (taken > 0 || delivery_ != Delivery::whole) continue;
    const TransferState state = pace_.state(now);
    if (state != TransferState::goesOn) {
      delivery_ = state == TransferState::tooSlow ? Delivery::tooSlow : Delivery::othersWaited;
    } else if (!bytes.empty()) {
      if (!eventsBy(pace_.wait(now), POLLOUT)) delivery_ = Delivery::shutdown;
    } else {
      const auto events = eventsBy(now + pause, nextRequest);
      if (!events) break; // the kernel has all of it
      if ((*events & (POLLERR | POLLHUP)) != 0) delivery_ = Delivery::clientLeft;
      if ((*events & POLLIN) != 0) nextRequest = 0;
      pause = std::min(2 * pause, kLongest);
    }
  }
  ended_ = Clock::now();
  return delivery_;
}

bool sendAll(int fd, std::string_view bytes, const Pace& pace, const StopSignal* cut) {
  return ReplySender(fd, TransferPace(pace, {}, {}), cut).send(bytes) == Delivery::whole;
}

} // namespace gnomon
