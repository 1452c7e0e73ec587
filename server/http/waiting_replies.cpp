#include "server/http/waiting_replies.h"

#include <cerrno>
#include <exception>
#include <poll.h>
#include <sys/socket.h>
#include <utility>

#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::chrono::seconds kHeartbeat{5};
constexpr int kStatusLeft = 499; ///< in the log alone

} // namespace

void HeldReply::takeResult() {
  if (!reply.streamed) return;
  reply.stages = reply.streamed->stages;
  reply.problem = reply.streamed->problem;
  reply.refusal = reply.streamed->refusal;
}

void HeldReply::end(const ConnectionContext& context) {
  takeResult();
  context.ended(record, reply);
}

void HeldReply::lose(const ConnectionContext& context, Delivery how) {
  record.delivery = how;
  if (!isBegun) reply.status = kStatusLeft;
  end(context);
}

WaitingReplies::WaitingReplies(const ConnectionContext& context, Leaving goesOn)
    : context_(context), goesOn_(std::move(goesOn)), thread_([this] { watch(); }) {}

WaitingReplies::~WaitingReplies() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_->raise();
  thread_.join();
}

void WaitingReplies::adopt(OpenConnection connection) noexcept {
  try {
    const bool mayAsk = connection.held->isHttp11 && !connection.held->isBegun;
    connection.held->reply.wait->wakeBy(wake_);
    const std::lock_guard lock(mutex_);
    adopted_.push_back({.connection = std::move(connection), .mayAsk = mayAsk});
    ++held_;
  } catch (const std::exception& error) {
    logEvent("connection", error.what());
  }
  wake_->raise();
}

bool WaitingReplies::isEmpty() {
  const std::lock_guard lock(mutex_);
  return held_ == 0;
}

void WaitingReplies::watch() {
  std::vector<pollfd> polled;
  while (true) {
    const bool isIdle = waiters_.empty() && wake_->fd() >= 0;
    polled = {{wake_->fd(), POLLIN, 0}, {waiters_.empty() ? -1 : context_.cutReplies.fd(), POLLIN, 0}};
    const std::size_t first = polled.size();
    for (const Waiter& waiter : waiters_) polled.push_back({waiter.connection.socket.get(), eventsOf(waiter), 0});
    ::poll(polled.data(), polled.size(), isIdle ? -1 : static_cast<int>(context_.limits.look.count()));
    wake_->lower();
    {
      const std::lock_guard lock(mutex_);
      if (stopping_) return;
      waiters_.splice(waiters_.end(), adopted_);
    }
    std::size_t socket = first;
    for (auto waiter = waiters_.begin(); waiter != waiters_.end(); ++socket) {
      const Fate fate = look(*waiter, socket < polled.size() ? polled[socket].revents : short{0});
      const auto next = std::next(waiter);
      if (fate != Fate::stays) {
        part(*waiter, fate);
        waiters_.erase(waiter);
      }
      waiter = next;
    }
  }
}

/// That end a sleep; a client that is gone always does.
short WaitingReplies::eventsOf(const Waiter& waiter) {
  return static_cast<short>((waiter.isHalfClosed ? 0 : POLLRDHUP) | (waiter.unsent.empty() ? 0 : POLLOUT));
}

WaitingReplies::Fate WaitingReplies::look(Waiter& waiter, short events) {
  HeldReply& held = *waiter.connection.held;
  try {
    waiter.delivery = hasLeft(waiter, events)        ? Delivery::clientLeft
                      : context_.cutReplies.raised() ? Delivery::shutdown
                                                     : send(waiter);
    if (waiter.delivery != Delivery::whole) return Fate::isLost;
    if (!waiter.unsent.empty()) return Fate::stays; // what is news then has become old when it is sent
    if (waiter.isLast) return Fate::goesOn;
    ReplyWait::News news = held.reply.wait->look();
    if (news.next == ReplyWait::Next::thread) return Fate::goesOn;
    waiter.isLast = news.next == ReplyWait::Next::end;
    waiter.unsent = std::move(news.text);
    const bool isSilent = waiter.unsent.empty() && held.isBegun && Clock::now() - waiter.moved >= kHeartbeat;
    if (isSilent) waiter.unsent = held.reply.wait->heartbeat();
    if (!waiter.unsent.empty()) waiter.moved = Clock::now();
    waiter.delivery = send(waiter);
    if (waiter.delivery != Delivery::whole) return Fate::isLost;
    return waiter.isLast && waiter.unsent.empty() ? Fate::goesOn : Fate::stays;
  } catch (const std::exception& error) { // out of memory: this reply ends early
    held.reply.note = error.what();
    return Fate::isLost;
  }
}

/// As ClientWatch::left(), without waiting: a reset is found by the next look.
bool WaitingReplies::hasLeft(Waiter& waiter, short events) {
  if ((events & (POLLHUP | POLLERR)) != 0) return true;
  if ((events & POLLRDHUP) == 0) return false;
  if (waiter.connection.held->isBegun) return true;
  waiter.isHalfClosed = true;
  if (!std::exchange(waiter.mayAsk, false)) return false;
  return !sendNow(waiter.connection.socket.get(), "HTTP/1.1 100 Continue\r\n\r\n");
}

/// As much as the kernel takes. tooSlow: it has taken nothing for as long as a client's pace allows.
Delivery WaitingReplies::send(Waiter& waiter) {
  while (!waiter.unsent.empty()) {
    const ssize_t count =
        ::send(waiter.connection.socket.get(), waiter.unsent.data(), waiter.unsent.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK) return Delivery::clientLeft;
    if (count < 0) {
      return Clock::now() - waiter.moved < context_.limits.pace.most ? Delivery::whole : Delivery::tooSlow;
    }
    waiter.unsent.erase(0, static_cast<std::size_t>(count));
    waiter.connection.held->record.replyBytes += static_cast<std::size_t>(count);
    waiter.moved = Clock::now();
  }
  return Delivery::whole;
}

void WaitingReplies::part(Waiter& waiter, Fate fate) {
  OpenConnection& connection = waiter.connection;
  if (fate == Fate::isLost) {
    resetWhenClosed(connection.socket.get());
    connection.held->lose(context_, waiter.delivery);
  } else {
    if (waiter.isLast) {
      connection.held->end(context_);
      connection.held = nullptr;
      ::shutdown(connection.socket.get(), SHUT_WR);
      connection.ending = true;
    }
    goesOn_(std::move(connection));
  }
  const std::lock_guard lock(mutex_);
  --held_;
}

} // namespace gnomon
