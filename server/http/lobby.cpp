#include "server/http/lobby.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "server/http/reply.h"
#include "server/http/socket_io.h"
#include "server/http/trace_context.h"
#include "server/http/unserved_head.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kLastLinger{500}; ///< once the server ends

void drain(int eventFd) {
  std::array<char, 8> count;
  [[maybe_unused]] const auto read = ::read(eventFd, count.data(), count.size());
}

bool listenFor(int poll, int operation, int fd, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.fd = fd;
  return ::epoll_ctl(poll, operation, fd, &event) == 0;
}

Problem noPlace(bool clientHasItsShare) {
  if (clientHasItsShare) {
    return {ProblemCode::busy, "", "Other requests from this address take all the threads that it may have.", "", ""};
  }
  return {ProblemCode::unavailable, "", "The server already serves as many requests as it can.", "", ""};
}

} // namespace

Lobby::Lobby(ConnectionContext& context, std::size_t threads, std::size_t perClient)
    : context_(context), shares_(perClient), poll_(::epoll_create1(EPOLL_CLOEXEC)), pool_(threads) {
  if (!poll_ || !listenFor(poll_.get(), EPOLL_CTL_ADD, wake_.fd(), EPOLLIN)) {
    throw std::system_error(errno, std::generic_category());
  }
  thread_ = std::thread([this] { watch(); });
}

void Lobby::finish() {
  finishing_ = true;
  wake_.raise();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Lobby::adopt(OpenConnection connection) noexcept {
  try {
    const std::lock_guard lock(mutex_);
    adopted_.push_back(std::move(connection));
  } catch (const std::exception& error) {
    logEvent("connection", error.what());
  }
  wake_.raise();
}

void Lobby::makeRoom() noexcept {
  roomWanted_ = true;
  wake_.raise();
}

bool Lobby::isSettled() {
  const std::lock_guard lock(mutex_);
  return adopted_.empty() &&
         std::all_of(guests_.begin(), guests_.end(), [](const auto& guest) { return guest.second.connection.ending; });
}

void Lobby::watch() {
  while (true) {
    try {
      if (isOver()) {
        return;
      }
      waitForBytes();
      placeReady();
      if (roomWanted_.exchange(false)) {
        dropOne();
      }
      if (Clock::now() >= nextDeadline_) {
        dropLate();
      }
    } catch (const std::exception& error) {
      logEvent("connection", error.what()); // out of memory: whom it hit is dropped when late
    }
  }
}

/// Sleeps until a guest sends something, or until the next deadline.
void Lobby::waitForBytes() {
  constexpr std::chrono::milliseconds kRetry{2}; // while a head waits for a thread
  const auto next = ready_.empty() ? nextDeadline_ : std::min(nextDeadline_, Clock::now() + kRetry);
  int wait = -1;
  if (next != Clock::time_point::max()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
    wait = static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
  }
  std::array<epoll_event, 64> events;
  const int count = ::epoll_wait(poll_.get(), events.data(), events.size(), wait);
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    if (event.data.fd == wake_.fd()) {
      drain(wake_.fd());
    } else {
      hear(event.data.fd, (event.events & (EPOLLHUP | EPOLLERR)) != 0);
    }
  }
}

/// Finishing goes in order: heads, the threads that answer them, what these hand back.
bool Lobby::isOver() {
  takeAdopted();
  if (!finishing_) {
    return false;
  }
  dropIdle();
  if (context_.cutBodies.raised()) {
    refuseWaiting();
  }
  if (!isDrained_ && isSettled()) {
    pool_.shutdown();
    isDrained_ = true;
    takeAdopted();
    dropIdle();
  }
  return isDrained_ && guests_.empty();
}

void Lobby::takeAdopted() {
  std::vector<OpenConnection> adopted;
  {
    const std::lock_guard lock(mutex_);
    adopted.swap(adopted_);
  }
  for (OpenConnection& connection : adopted) {
    if (guests_.size() >= context_.limits.maxWaiting) {
      dropOne();
    }
    const int fd = connection.socket.get();
    if (!listenFor(poll_.get(), EPOLL_CTL_ADD, fd, EPOLLIN)) {
      continue; // and close it: the system has no memory to watch it
    }
    const auto guest = guests_.emplace(fd, Guest{std::move(connection), Clock::now(), {}}).first;
    const OpenConnection& own = guest->second.connection;
    expectBy(guest->second, own.ending          ? context_.limits.linger
                            : own.requests == 0 ? context_.limits.firstByte
                                                : context_.limits.idle);
    if (!own.ending && !own.isSilent()) {
      weigh(guest, true);
    }
  }
}

/// Takes what a guest has sent.
void Lobby::hear(int fd, bool lost) {
  const auto found = guests_.find(fd);
  if (found == guests_.end()) {
    return;
  }
  Guest& guest = found->second;
  if (guest.isReady) { // its body waits in the socket
    if (lost) guests_.erase(found);
    return;
  }
  OpenConnection& connection = guest.connection;
  std::array<char, 16 * 1024> bytes;
  const ssize_t count = ::recv(fd, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) {
    return;
  }
  if (connection.ending) {
    if (count <= 0) guests_.erase(found);
    return;
  }
  const bool wasSilent = connection.isSilent();
  if (count > 0) {
    if (wasSilent) connection.arrived = Clock::now();
    connection.received.append(bytes.data(), static_cast<std::size_t>(count));
    weigh(found, wasSilent);
  } else if (wasSilent) {
    guests_.erase(found);
  } else {
    refuse(guest, {ProblemCode::malformed, "", "The connection ended before the headers did.", "", ""});
  }
}

/// Who sent a complete head. It is parsed here only where a proxy may have passed it on.
PeerAddress Lobby::clientOf(const OpenConnection& connection, std::size_t headBytes) const {
  if (context_.trustedProxies.empty()) return connection.peer;
  const auto head = parseRequestHead(std::string_view(connection.received).substr(0, headBytes));
  return head ? clientAddress(connection.peer, head->headers, context_.trustedProxies) : connection.peer;
}

/// What has come of a head decides what becomes of its sender.
void Lobby::weigh(Guests::iterator guest, bool headBegins) {
  const OpenConnection& connection = guest->second.connection;
  const auto length = headLength(connection.received);
  if (length.value_or(connection.received.size()) > kMaxHeadBytes) {
    refuse(guest->second, {ProblemCode::tooLarge, "", "The request line and headers are too long.",
                           std::to_string(kMaxHeadBytes) + " bytes", ""});
  } else if (length) {
    guest->second.isReady = true;
    guest->second.client = clientOf(connection, *length);
    listenFor(poll_.get(), EPOLL_CTL_MOD, guest->first, 0);
    expectBy(guest->second, context_.limits.threadWait);
    ready_.push_back(guest->first);
  } else if (headBegins && !connection.isSilent()) {
    expectBy(guest->second, context_.limits.head);
  }
}

/// Gives a thread to each complete head, or an answer to those that have waited for one in vain.
void Lobby::placeReady() {
  std::vector<int> still;
  for (const int fd : std::exchange(ready_, {})) {
    const auto guest = guests_.find(fd);
    if (guest == guests_.end() || !guest->second.isReady) {
      continue;
    }
    const Place where = place(guest);
    if (where == Place::taken) {
      continue;
    }
    if (!guest->second.isWaiting || Clock::now() >= guest->second.deadline) {
      answer(guest->second, where);
    }
    if (guest->second.isReady) {
      still.push_back(fd);
    }
  }
  ready_ = std::move(still);
}

Lobby::Place Lobby::place(Guests::iterator guest) {
  const std::string network = guest->second.client.network;
  if (!pool_.hasIdle()) {
    return Place::noThread;
  }
  if (!shares_.take(network)) {
    return Place::noShare;
  }
  listenFor(poll_.get(), EPOLL_CTL_DEL, guest->first, 0);
  const auto connection = std::make_shared<OpenConnection>(std::move(guest->second.connection));
  guests_.erase(guest);
  pool_.tryRun([this, connection, network] {
    auto kept = serveConnection(std::move(*connection), context_);
    shares_.giveBack(network);
    if (kept) {
      adopt(*std::move(kept));
    }
  });
  return Place::taken;
}

/// For a head that found no thread: probes are answered, others go on waiting, and are refused when they are late.
void Lobby::answer(Guest& guest, Place why) {
  const std::string& received = guest.connection.received;
  const auto refusal = Clock::now() >= guest.deadline ? std::optional(noPlace(why == Place::noShare)) : std::nullopt;
  auto told = replyToUnserved(context_.service, std::string_view(received).substr(0, headLength(received).value_or(0)),
                              refusal);
  if (told) {
    sendLast(guest, told->record, told->reply, told->bodyless);
  }
  guest.isWaiting = !told;
}

void Lobby::refuse(Guest& guest, Problem problem) {
  RequestRecord record;
  record.id = requestId(std::nullopt);
  sendLast(guest, record, problemReply({std::move(problem)}, record.id, {.read = RequestPart::head}), false);
}

void Lobby::sendLast(Guest& guest, RequestRecord& record, HttpReply reply, bool bodyless) {
  OpenConnection& connection = guest.connection;
  record.start = connection.arrived;
  record.client = guest.isReady ? guest.client.text : connection.peer.text;
  record.proxy = record.client == connection.peer.text ? "" : connection.peer.text;
  addTrace(reply, record.trace);
  const std::string text = replyHead(reply, record.id, false) + (bodyless ? "" : reply.body);
  record.delivered = sendNow(connection.socket.get(), text); // it fits the socket's buffer, or the client reads nothing
  record.replyBytes = record.delivered && !bodyless ? reply.body.size() : 0;
  ::shutdown(connection.socket.get(), SHUT_WR);
  context_.ended(record, reply);
  connection.ending = true;
  connection.received = {};
  guest.isReady = false;
  listenFor(poll_.get(), EPOLL_CTL_MOD, connection.socket.get(), EPOLLIN);
  expectBy(guest, context_.limits.linger);
}

void Lobby::expectBy(Guest& guest, std::chrono::milliseconds patience) {
  guest.deadline = Clock::now() + patience;
  nextDeadline_ = std::min(nextDeadline_, guest.deadline);
}

void Lobby::dropLate() {
  const auto now = Clock::now();
  nextDeadline_ = Clock::time_point::max();
  for (auto at = guests_.begin(); at != guests_.end();) {
    Guest& guest = at->second;
    const bool isLate = !guest.isReady && now >= guest.deadline;
    if (isLate && (guest.connection.ending || guest.connection.isSilent())) {
      at = guests_.erase(at);
      continue;
    }
    if (isLate) {
      refuse(guest, {ProblemCode::deadlineExceeded, "", "The request line and headers arrived too slowly.", "", ""});
    }
    if (!guest.isReady) { // those are looked at anyway
      nextDeadline_ = std::min(nextDeadline_, guest.deadline);
    }
    ++at;
  }
}

/// The server ends: who has asked for nothing is let go, and who has its answer has little time to take it.
void Lobby::dropIdle() {
  std::erase_if(
      guests_, [](const auto& guest) { return !guest.second.connection.ending && guest.second.connection.isSilent(); });
  for (auto& [fd, guest] : guests_) {
    if (guest.connection.ending) {
      guest.deadline = std::min(guest.deadline, Clock::now() + kLastLinger);
      nextDeadline_ = std::min(nextDeadline_, guest.deadline);
    }
  }
}

/// The server does not wait for them any longer.
void Lobby::refuseWaiting() {
  for (auto& [fd, guest] : guests_) {
    if (guest.connection.ending) continue;
    refuse(guest, {ProblemCode::unavailable, "", "The server is shutting down.", "", ""});
    guest.deadline = std::min(guest.deadline, Clock::now() + kLastLinger);
    nextDeadline_ = std::min(nextDeadline_, guest.deadline);
  }
}

/// Of the client that has the most guests, the one that has waited longest; nothing where every head is complete.
Lobby::Guests::iterator Lobby::leastWanted() {
  std::map<std::string_view, std::size_t> counts;
  std::size_t most = 0;
  for (const auto& [fd, guest] : guests_) {
    if (!guest.isReady) {
      most = std::max(most, ++counts[guest.connection.peer.network]);
    }
  }
  auto oldest = guests_.end();
  for (auto at = guests_.begin(); at != guests_.end(); ++at) {
    const bool isOfMost = !at->second.isReady && counts[at->second.connection.peer.network] == most;
    if (isOfMost && (oldest == guests_.end() || at->second.since < oldest->second.since)) {
      oldest = at;
    }
  }
  return oldest;
}

/// Makes room for one. Whoever is chosen is heard first: its whole head may have come in this moment.
void Lobby::dropOne() {
  for (auto chosen = leastWanted(); chosen != guests_.end(); chosen = leastWanted()) {
    const int fd = chosen->first;
    hear(fd, false);
    chosen = guests_.find(fd);
    if (chosen == guests_.end()) {
      return;
    }
    if (!chosen->second.isReady) {
      guests_.erase(chosen);
      return;
    }
  }
}

} // namespace gnomon
