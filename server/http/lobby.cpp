#include "server/http/lobby.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <utility>

#include "server/http/reply.h"
#include "server/http/socket_io.h"
#include "server/http/trace_context.h"
#include "server/http/unserved_head.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kLastLinger{500}; ///< once the server ends
constexpr std::size_t kMostUnseen = 32;               ///< connections that the watching thread has not seen yet
constexpr std::chrono::seconds kLongestUnseen{1};     ///< that a new one waits for it, whatever keeps it

Problem noPlace(bool clientHasItsShare) {
  if (clientHasItsShare) {
    return {ProblemCode::busy, "", "Other requests from this address take all the threads that it may have.", "", ""};
  }
  return {ProblemCode::unavailable, "", "The server already serves as many requests as it can.", "", ""};
}

} // namespace

Lobby::Lobby(ConnectionContext& context, std::size_t threads, std::size_t perClient)
    : context_(context), shares_(perClient), pool_(threads), thread_([this] { watch(); }) {}

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

void Lobby::admit(OpenConnection connection) noexcept {
  adopt(std::move(connection));
  std::unique_lock lock(mutex_);
  taken_.wait_for(lock, kLongestUnseen, [this] { return adopted_.size() < kMostUnseen; });
}

void Lobby::makeRoom() noexcept {
  roomWanted_ = true;
  wake_.raise();
}

bool Lobby::isSettled() {
  const std::lock_guard lock(mutex_);
  const auto& guests = guests_.all();
  return adopted_.empty() &&
         std::all_of(guests.begin(), guests.end(), [](const auto& guest) { return guest.second.connection.ending; });
}

void Lobby::watch() {
  constexpr std::chrono::milliseconds kRetry{2}; // while a head waits for a thread
  while (true) {
    try {
      if (isOver()) {
        return;
      }
      for (const auto& [fd, isLost] :
           guests_.listen(ready_.empty() ? Clock::time_point::max() : Clock::now() + kRetry)) {
        hear(fd, isLost);
      }
      placeReady();
      if (roomWanted_.exchange(false)) {
        dropOne();
      }
      refuseLate();
    } catch (const std::exception& error) {
      logEvent("connection", error.what()); // out of memory: whom it hit is dropped when late
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
  return isDrained_ && guests_.all().empty();
}

void Lobby::takeAdopted() {
  std::vector<OpenConnection> adopted;
  {
    const std::lock_guard lock(mutex_);
    adopted.swap(adopted_);
  }
  taken_.notify_all();
  for (OpenConnection& connection : adopted) {
    if (guests_.all().size() >= context_.limits.maxWaiting) {
      dropOne();
    }
    Guest* const guest = guests_.admit(std::move(connection));
    if (guest == nullptr) {
      continue;
    }
    const OpenConnection& own = guest->connection;
    guests_.expectBy(*guest, own.ending          ? context_.limits.linger
                             : own.requests == 0 ? context_.limits.firstByte
                                                 : context_.limits.idle);
    if (!own.ending && !own.isSilent()) {
      weigh(*guest, true);
    }
  }
}

/// Takes what a guest has sent.
void Lobby::hear(int fd, bool lost) {
  Guest* const guest = guests_.find(fd);
  if (guest == nullptr) {
    return;
  }
  if (guest->isReady) { // its body waits in the socket
    if (lost) guests_.drop(fd);
    return;
  }
  OpenConnection& connection = guest->connection;
  std::array<char, 16 * 1024> bytes;
  const ssize_t count = ::recv(fd, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) {
    return;
  }
  if (connection.ending) {
    if (count <= 0) guests_.drop(fd);
    return;
  }
  const bool wasSilent = connection.isSilent();
  if (count > 0) {
    if (wasSilent) connection.arrived = Clock::now();
    connection.received.append(bytes.data(), static_cast<std::size_t>(count));
    weigh(*guest, wasSilent);
  } else if (wasSilent) {
    guests_.drop(fd);
  } else {
    refuse(*guest, {ProblemCode::malformed, "", "The connection ended before the headers did.", "", ""});
  }
}

/// Who sent a complete head. It is parsed here only where a proxy may have passed it on.
PeerAddress Lobby::clientOf(const OpenConnection& connection, std::size_t headBytes) const {
  if (context_.trustedProxies.empty()) return connection.peer;
  const auto head = parseRequestHead(std::string_view(connection.received).substr(0, headBytes));
  return head ? clientAddress(connection.peer, head->headers, context_.trustedProxies) : connection.peer;
}

/// What has come of a head decides what becomes of its sender.
void Lobby::weigh(Guest& guest, bool headBegins) {
  const OpenConnection& connection = guest.connection;
  const auto length = headLength(connection.received);
  if (length.value_or(connection.received.size()) > kMaxHeadBytes) {
    refuse(guest, {ProblemCode::tooLarge, "", "The request line and headers are too long.",
                   std::to_string(kMaxHeadBytes) + " bytes", ""});
  } else if (length) {
    guest.isReady = true;
    guest.client = clientOf(connection, *length);
    guests_.ignore(guest);
    guests_.expectBy(guest, context_.limits.threadWait);
    ready_.push_back(connection.socket.get());
  } else if (headBegins && !connection.isSilent()) {
    guests_.expectBy(guest, context_.limits.head);
  }
}

/// Gives a thread to each complete head, or an answer to those that have waited for one in vain.
void Lobby::placeReady() {
  std::vector<int> still;
  for (const int fd : std::exchange(ready_, {})) {
    Guest* const guest = guests_.find(fd);
    if (guest == nullptr || !guest->isReady) {
      continue;
    }
    const Place where = place(fd, *guest);
    if (where == Place::taken) {
      continue;
    }
    if (!guest->isWaiting || Clock::now() >= guest->deadline) {
      answer(*guest, where);
    }
    if (guest->isReady) {
      still.push_back(fd);
    }
  }
  ready_ = std::move(still);
}

Lobby::Place Lobby::place(int fd, const Guest& guest) {
  const std::string network = guest.client.network;
  if (!pool_.hasIdle()) {
    return Place::noThread;
  }
  if (!shares_.take(network)) {
    return Place::noShare;
  }
  const auto connection = std::make_shared<OpenConnection>(guests_.release(fd));
  pool_.tryRun([this, connection, network] {
    auto kept = serveConnection(std::move(*connection), context_, [this] { return pool_.hasIdle(); });
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
  const std::string text = replyHead(reply, record.id, false) + std::string(bodyless ? "" : reply.body.view());
  record.delivered = sendNow(connection.socket.get(), text); // it fits the socket's buffer, or the client reads nothing
  record.replyBytes = record.delivered && !bodyless ? reply.body.size() : 0;
  ::shutdown(connection.socket.get(), SHUT_WR);
  context_.ended(record, reply);
  connection.ending = true;
  connection.received = {};
  guest.isReady = false;
  guests_.heed(guest);
  guests_.expectBy(guest, context_.limits.linger);
}

void Lobby::refuseLate() {
  for (Guest* const guest : guests_.takeLate()) {
    refuse(*guest, {ProblemCode::deadlineExceeded, "", "The request line and headers arrived too slowly.", "", ""});
  }
}

/// The server ends: who has asked for nothing is let go, and who has its answer has little time to take it.
void Lobby::dropIdle() {
  auto& guests = guests_.all();
  std::erase_if(
      guests, [](const auto& guest) { return !guest.second.connection.ending && guest.second.connection.isSilent(); });
  for (auto& [fd, guest] : guests) {
    if (guest.connection.ending) guests_.hurry(guest, kLastLinger);
  }
}

/// The server does not wait for them any longer.
void Lobby::refuseWaiting() {
  for (auto& [fd, guest] : guests_.all()) {
    if (guest.connection.ending) continue;
    refuse(guest, {ProblemCode::unavailable, "", "The server is shutting down.", "", ""});
    guests_.hurry(guest, kLastLinger);
  }
}

/// Makes room for one. Whoever is chosen is heard first: its whole head may have come in this moment.
void Lobby::dropOne() {
  while (const auto chosen = guests_.leastWanted()) {
    hear(*chosen, false);
    const Guest* const guest = guests_.find(*chosen);
    if (guest == nullptr) {
      return;
    }
    if (!guest->isReady) {
      guests_.drop(*chosen);
      return;
    }
  }
  if (const auto chosen = guests_.lastToAsk()) {
    Guest& guest = *guests_.find(*chosen);
    guest.deadline = Clock::now();
    answer(guest, Place::noThread);
    guests_.drop(*chosen);
  }
}

} // namespace gnomon
