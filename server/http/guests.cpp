#include "server/http/guests.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <functional>
#include <string_view>
#include <sys/epoll.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

void drain(int eventFd) {
  std::array<char, 8> count;
  [[maybe_unused]] const auto read = ::read(eventFd, count.data(), count.size());
}

bool control(int poll, int operation, int fd, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.fd = fd;
  return ::epoll_ctl(poll, operation, fd, &event) == 0;
}

} // namespace

Guests::Guests(StopSignal& wake) : wake_(wake), poll_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (!poll_ || !control(poll_.get(), EPOLL_CTL_ADD, wake_.fd(), EPOLLIN)) {
    throw std::system_error(errno, std::generic_category());
  }
}

Guest* Guests::find(int fd) {
  const auto found = all_.find(fd);
  return found == all_.end() ? nullptr : &found->second;
}

Guest* Guests::admit(OpenConnection connection) {
  const int fd = connection.socket.get();
  if (!control(poll_.get(), EPOLL_CTL_ADD, fd, EPOLLIN)) return nullptr;
  return &all_.emplace(fd, Guest{std::move(connection), Clock::now(), {}}).first->second;
}

OpenConnection Guests::release(int fd) {
  control(poll_.get(), EPOLL_CTL_DEL, fd, 0);
  return std::move(all_.extract(fd).mapped().connection);
}

void Guests::ignore(const Guest& guest) {
  control(poll_.get(), EPOLL_CTL_MOD, guest.connection.socket.get(), 0);
}

void Guests::heed(const Guest& guest) {
  control(poll_.get(), EPOLL_CTL_MOD, guest.connection.socket.get(), EPOLLIN);
}

void Guests::expectBy(Guest& guest, std::chrono::milliseconds patience) {
  guest.deadline = Clock::now() + patience;
  nextDeadline_ = std::min(nextDeadline_, guest.deadline);
}

void Guests::hurry(Guest& guest, std::chrono::milliseconds patience) {
  guest.deadline = std::min(guest.deadline, Clock::now() + patience);
  nextDeadline_ = std::min(nextDeadline_, guest.deadline);
}

std::vector<Guest*> Guests::takeLate() {
  const auto now = Clock::now();
  std::vector<Guest*> begun;
  if (now < nextDeadline_) return begun;
  nextDeadline_ = Clock::time_point::max();
  std::erase_if(all_, [&](const auto& entry) {
    const Guest& guest = entry.second;
    return !guest.isReady && now >= guest.deadline && (guest.connection.ending || guest.connection.isSilent());
  });
  for (auto& [fd, guest] : all_) {
    if (guest.isReady) continue; // those are looked at anyway
    if (now >= guest.deadline) {
      begun.push_back(&guest);
    } else {
      nextDeadline_ = std::min(nextDeadline_, guest.deadline);
    }
  }
  return begun;
}

std::optional<int> Guests::leastWanted() const {
  return ofWhoHasMost(false, std::less<>());
}

std::optional<int> Guests::lastToAsk() const {
  return ofWhoHasMost(true, std::greater<>());
}

std::optional<int> Guests::ofWhoHasMost(
    bool ready, const std::function<bool(Clock::time_point, Clock::time_point)>& isBefore) const {
  const auto clientOf = [](const Guest& guest) -> std::string_view {
    return guest.isReady ? guest.client.network : guest.connection.peer.network;
  };
  std::map<std::string_view, std::size_t> counts;
  std::size_t most = 0;
  for (const auto& [fd, guest] : all_) {
    if (guest.isReady == ready) most = std::max(most, ++counts[clientOf(guest)]);
  }
  auto first = all_.end();
  for (auto at = all_.begin(); at != all_.end(); ++at) {
    const Guest& guest = at->second;
    const bool isOfMost = guest.isReady == ready && counts[clientOf(guest)] == most;
    if (isOfMost && (first == all_.end() || isBefore(guest.since, first->second.since))) first = at;
  }
  return first == all_.end() ? std::nullopt : std::optional(first->first);
}

std::vector<Guests::Heard> Guests::listen(Clock::time_point until) {
  const auto next = std::min(until, nextDeadline_);
  int wait = -1;
  if (next != Clock::time_point::max()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
    wait = static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
  }
  std::array<epoll_event, 64> events;
  const int count = ::epoll_wait(poll_.get(), events.data(), events.size(), wait);
  std::vector<Heard> heard;
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    if (event.data.fd == wake_.fd()) {
      drain(wake_.fd());
    } else {
      heard.push_back({event.data.fd, (event.events & (EPOLLHUP | EPOLLERR)) != 0});
    }
  }
  return heard;
}

} // namespace gnomon
