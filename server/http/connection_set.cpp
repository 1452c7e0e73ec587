#include "server/http/connection_set.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <string_view>
#include <sys/epoll.h>
#include <system_error>
#include <utility>

namespace gnomon {
namespace {

bool control(int poll, int operation, int fd, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.fd = fd;
  return ::epoll_ctl(poll, operation, fd, &event) == 0;
}

} // namespace

ConnectionSet::ConnectionSet(StopSignal& wake) : wake_(wake), poll_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (!poll_ || !control(poll_.get(), EPOLL_CTL_ADD, wake_.fd(), EPOLLIN)) {
    throw std::system_error(errno, std::generic_category());
  }
}

PendingConnection* ConnectionSet::find(int fd) {
  const auto found = all_.find(fd);
  return found == all_.end() ? nullptr : &found->second;
}

PendingConnection* ConnectionSet::admit(OpenConnection connection) {
  const int fd = connection.socket.get();
  if (!control(poll_.get(), EPOLL_CTL_ADD, fd, EPOLLIN)) return nullptr;
  return &all_.emplace(fd, PendingConnection{std::move(connection), Clock::now(), {}}).first->second;
}

OpenConnection ConnectionSet::release(int fd) {
  control(poll_.get(), EPOLL_CTL_DEL, fd, 0);
  return std::move(all_.extract(fd).mapped().connection);
}

void ConnectionSet::stopReading(const PendingConnection& pending) {
  control(poll_.get(), EPOLL_CTL_MOD, pending.connection.socket.get(), 0);
}

void ConnectionSet::resumeReading(const PendingConnection& pending) {
  control(poll_.get(), EPOLL_CTL_MOD, pending.connection.socket.get(), EPOLLIN);
}

void ConnectionSet::setDeadline(PendingConnection& pending, std::chrono::milliseconds patience) {
  pending.deadline = Clock::now() + patience;
  nextDeadline_ = std::min(nextDeadline_, pending.deadline);
}

void ConnectionSet::shortenDeadline(PendingConnection& pending, std::chrono::milliseconds patience) {
  pending.deadline = std::min(pending.deadline, Clock::now() + patience);
  nextDeadline_ = std::min(nextDeadline_, pending.deadline);
}

std::vector<PendingConnection*> ConnectionSet::takeExpired() {
  const auto now = Clock::now();
  std::vector<PendingConnection*> begun;
  if (now < nextDeadline_) return begun;
  nextDeadline_ = Clock::time_point::max();
  std::erase_if(all_, [&](const auto& entry) {
    const PendingConnection& pending = entry.second;
    return !pending.isReady && now >= pending.deadline && (pending.connection.ending || pending.connection.isSilent());
  });
  for (auto& [fd, pending] : all_) {
    if (pending.isReady) continue; // those are looked at anyway
    if (now >= pending.deadline) {
      begun.push_back(&pending);
    } else {
      nextDeadline_ = std::min(nextDeadline_, pending.deadline);
    }
  }
  return begun;
}

std::optional<int> ConnectionSet::evictionCandidate() const {
  return firstOfBusiestClient(false, std::less<>());
}

std::optional<int> ConnectionSet::newestReady() const {
  return firstOfBusiestClient(true, std::greater<>());
}

std::optional<int> ConnectionSet::firstOfBusiestClient(
    bool ready, const std::function<bool(Clock::time_point, Clock::time_point)>& isBefore) const {
  const auto clientOf = [](const PendingConnection& pending) -> std::string_view {
    return pending.isReady ? pending.client.identity.name : pending.connection.peer.identity.name;
  };
  std::map<std::string_view, std::size_t> counts;
  std::size_t most = 0;
  for (const auto& [fd, pending] : all_) {
    if (pending.isReady == ready) most = std::max(most, ++counts[clientOf(pending)]);
  }
  auto first = all_.end();
  for (auto at = all_.begin(); at != all_.end(); ++at) {
    const PendingConnection& pending = at->second;
    const bool isOfMost = pending.isReady == ready && counts[clientOf(pending)] == most;
    if (isOfMost && (first == all_.end() || isBefore(pending.since, first->second.since))) first = at;
  }
  return first == all_.end() ? std::nullopt : std::optional(first->first);
}

std::vector<ConnectionSet::Readable> ConnectionSet::wait(Clock::time_point until) {
  const auto next = std::min(until, nextDeadline_);
  const int wait = next == Clock::time_point::max() ? -1 : millisecondsUntil(next);
  std::array<epoll_event, 64> events;
  const int count = ::epoll_wait(poll_.get(), events.data(), events.size(), wait);
  std::vector<Readable> readable;
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    if (event.data.fd == wake_.fd()) {
      wake_.lower();
    } else {
      readable.push_back({event.data.fd, (event.events & (EPOLLHUP | EPOLLERR)) != 0});
    }
  }
  return readable;
}

} // namespace gnomon
