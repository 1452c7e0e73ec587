#include "server/http/pending_connections.h"

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
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kLastLinger{500}; ///< once the server ends
constexpr std::size_t kMostUnseen = 32;               ///< connections that the watching thread has not seen yet
constexpr std::chrono::seconds kLongestUnseen{1};     ///< that a new one waits for it at most

Problem noPlace(bool clientHasItsShare) {
  if (clientHasItsShare) {
    return {ProblemCode::busy, "", "Other requests from this address take all the threads that it may have.", "", ""};
  }
  return {ProblemCode::unavailable, "", "The server already serves as many requests as it can.", "", ""};
}

} // namespace

PendingConnections::PendingConnections(ConnectionContext& context, std::size_t threads, std::size_t perClient)
    : context_(context), shares_(perClient), pool_(threads), thread_([this] { watch(); }) {}

void PendingConnections::finish() {
  finishing_ = true;
  wake_.raise();
  if (thread_.joinable()) thread_.join();
}

void PendingConnections::adopt(OpenConnection connection) noexcept {
  try {
    const std::lock_guard lock(mutex_);
    adopted_.push_back(std::move(connection));
  } catch (const std::exception& error) {
    logEvent("connection", error.what());
  }
  wake_.raise();
}

void PendingConnections::admit(OpenConnection connection) noexcept {
  adopt(std::move(connection));
  std::unique_lock lock(mutex_);
  taken_.wait_for(lock, kLongestUnseen, [this] { return adopted_.size() < kMostUnseen; });
}

void PendingConnections::makeRoom() noexcept {
  roomWanted_ = true;
  wake_.raise();
}

bool PendingConnections::isSettled() {
  const std::lock_guard lock(mutex_);
  const auto& connections = connections_.all();
  return adopted_.empty() && std::all_of(connections.begin(), connections.end(),
                                         [](const auto& pending) { return pending.second.connection.ending; });
}

void PendingConnections::watch() {
  constexpr std::chrono::milliseconds kRetry{2}; // while a head waits for a thread
  while (true) {
    try {
      if (isOver()) return;
      for (const auto& [fd, isLost] :
           connections_.wait(ready_.empty() ? Clock::time_point::max() : Clock::now() + kRetry)) {
        onReadable(fd, isLost);
      }
      placeReady();
      if (roomWanted_.exchange(false)) dropOne();
      refuseLate();
    } catch (const std::exception& error) {
      logEvent("connection", error.what()); // out of memory: the connection that met it is dropped at its deadline
    }
  }
}

/// Finishing goes in order: heads, the threads that answer them, what these hand back.
bool PendingConnections::isOver() {
  takeAdopted();
  if (!finishing_) return false;
  dropIdle();
  if (context_.cutBodies.raised()) refuseWaiting();
  if (!isDrained_ && isSettled()) {
    pool_.shutdown();
    isDrained_ = true;
    takeAdopted();
    dropIdle();
  }
  return isDrained_ && connections_.all().empty();
}

void PendingConnections::takeAdopted() {
  std::vector<OpenConnection> adopted;
  {
    const std::lock_guard lock(mutex_);
    adopted.swap(adopted_);
  }
  taken_.notify_all();
  for (OpenConnection& connection : adopted) {
    if (connections_.all().size() >= context_.limits.maxWaiting) dropOne();
    PendingConnection* const pending = connections_.admit(std::move(connection));
    if (pending == nullptr) continue;
    const OpenConnection& own = pending->connection;
    connections_.setDeadline(*pending, own.ending          ? context_.limits.linger
                                       : own.requests == 0 ? context_.limits.firstByte
                                                           : context_.limits.idle);
    if (!own.ending && !own.isSilent()) checkHead(*pending, true);
  }
}

/// Takes what a pending has sent.
void PendingConnections::onReadable(int fd, bool lost) {
  PendingConnection* const pending = connections_.find(fd);
  if (pending == nullptr) return;
  if (pending->isReady) { // its body waits in the socket
    if (lost) connections_.drop(fd);
    return;
  }
  OpenConnection& connection = pending->connection;
  std::array<char, 16 * 1024> bytes;
  const ssize_t count = ::recv(fd, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return;
  if (connection.ending) {
    if (count <= 0) connections_.drop(fd);
    return;
  }
  const bool wasSilent = connection.isSilent();
  if (count > 0) {
    if (wasSilent) connection.arrived = Clock::now();
    connection.received.append(bytes.data(), static_cast<std::size_t>(count));
    checkHead(*pending, wasSilent);
  } else if (wasSilent) {
    connections_.drop(fd);
  } else {
    refuse(*pending, {ProblemCode::malformed, "", "The connection ended before the headers did.", "", ""});
  }
}

/// The client that sent a complete head. It is parsed here only where a proxy may have passed it on.
PeerAddress PendingConnections::clientOf(const OpenConnection& connection, std::size_t headBytes) const {
  if (context_.trustedProxies.empty()) return connection.peer;
  const auto head = parseRequestHead(std::string_view(connection.received).substr(0, headBytes));
  return head ? clientAddress(connection.peer, head->headers, context_.trustedProxies) : connection.peer;
}

/// What has come of a head decides what becomes of its sender.
void PendingConnections::checkHead(PendingConnection& pending, bool headBegins) {
  const OpenConnection& connection = pending.connection;
  const auto length = headLength(connection.received);
  if (length.value_or(connection.received.size()) > kMaxHeadBytes) {
    refuse(pending, {ProblemCode::tooLarge, "", "The request line and headers are too long.",
                     std::to_string(kMaxHeadBytes) + " bytes", ""});
  } else if (length) {
    pending.isReady = true;
    pending.client = clientOf(connection, *length);
    connections_.stopReading(pending);
    connections_.setDeadline(pending, context_.limits.threadWait);
    ready_.push_back(connection.socket.get());
  } else if (headBegins && !connection.isSilent()) {
    connections_.setDeadline(pending, context_.limits.head);
  }
}

/// Gives a thread to each complete head, or an answer to those that have waited for one in vain.
void PendingConnections::placeReady() {
  std::vector<int> still;
  for (const int fd : std::exchange(ready_, {})) {
    PendingConnection* const pending = connections_.find(fd);
    if (pending == nullptr || !pending->isReady) continue;
    const Place where = place(fd, *pending);
    if (where == Place::taken) continue;
    if (!pending->isWaiting || Clock::now() >= pending->deadline) answer(*pending, where);
    if (pending->isReady) still.push_back(fd);
  }
  ready_ = std::move(still);
}

PendingConnections::Place PendingConnections::place(int fd, const PendingConnection& pending) {
  const std::string network = pending.client.identity.name;
  if (!pool_.hasIdle()) return Place::noThread;
  if (!shares_.take(network)) return Place::noShare;
  const auto connection = std::make_shared<OpenConnection>(connections_.release(fd));
  pool_.tryRun([this, connection, network] {
    auto kept = serveConnection(std::move(*connection), context_, [this] { return pool_.hasIdle(); });
    shares_.giveBack(network);
    if (kept) adopt(*std::move(kept));
  });
  return Place::taken;
}

/// For a head that found no thread: probes are answered, others go on waiting, and are refused when they are late.
void PendingConnections::answer(PendingConnection& pending, Place why) {
  const std::string& received = pending.connection.received;
  const auto refusal = Clock::now() >= pending.deadline ? std::optional(noPlace(why == Place::noShare)) : std::nullopt;
  auto unserved = replyToUnserved(context_.service,
                                  std::string_view(received).substr(0, headLength(received).value_or(0)), refusal);
  if (unserved) sendLast(pending, unserved->record, unserved->reply, unserved->bodyless);
  pending.isWaiting = !unserved;
}

void PendingConnections::refuse(PendingConnection& pending, Problem problem) {
  RequestRecord record;
  record.id = requestId(std::nullopt);
  record.note(excerptOf(pending.connection.received));
  sendLast(pending, record, problemReply({std::move(problem)}, record.id, {.read = RequestPart::head}), false);
}

void PendingConnections::sendLast(PendingConnection& pending, RequestRecord& record, HttpReply reply, bool bodyless) {
  OpenConnection& connection = pending.connection;
  record.start = connection.arrived;
  record.client = pending.isReady ? pending.client.text : connection.peer.text;
  record.proxy = record.client == connection.peer.text ? "" : connection.peer.text;
  addTrace(reply, record.trace);
  const std::string text = replyHead(reply, record.id, false) + std::string(bodyless ? "" : reply.body.view());
  const bool isSent =
      sendNow(connection.socket.get(), text); // it fits the socket's buffer, or the client reads nothing
  record.delivery = isSent ? Delivery::whole : Delivery::clientLeft;
  record.replyBytes = isSent && !bodyless ? reply.body.size() : 0;
  ::shutdown(connection.socket.get(), SHUT_WR);
  context_.ended(record, reply);
  connection.ending = true;
  connection.received = {};
  pending.isReady = false;
  connections_.resumeReading(pending);
  connections_.setDeadline(pending, context_.limits.linger);
}

void PendingConnections::refuseLate() {
  for (PendingConnection* const pending : connections_.takeExpired()) {
    refuse(*pending, {ProblemCode::deadlineExceeded, "", "The request line and headers arrived too slowly.", "", ""});
  }
}

/// The server ends: connections without a request are closed, and those with their reply get little time to take it.
void PendingConnections::dropIdle() {
  auto& connections = connections_.all();
  std::erase_if(connections, [](const auto& pending) {
    return !pending.second.connection.ending && pending.second.connection.isSilent();
  });
  for (auto& [fd, pending] : connections) {
    if (pending.connection.ending) connections_.shortenDeadline(pending, kLastLinger);
  }
}

/// The server does not wait for them any longer.
void PendingConnections::refuseWaiting() {
  for (auto& [fd, pending] : connections_.all()) {
    if (pending.connection.ending) continue;
    refuse(pending, {ProblemCode::unavailable, "", "The server is shutting down.", "", ""});
    connections_.shortenDeadline(pending, kLastLinger);
  }
}

/// Makes room for one. The chosen one is read first: its whole head may have come in this moment.
void PendingConnections::dropOne() {
  while (const auto chosen = connections_.evictionCandidate()) {
    onReadable(*chosen, false);
    const PendingConnection* const pending = connections_.find(*chosen);
    if (pending == nullptr) return;
    if (!pending->isReady) {
      connections_.drop(*chosen);
      return;
    }
  }
  if (const auto chosen = connections_.newestReady()) {
    PendingConnection& pending = *connections_.find(*chosen);
    pending.deadline = Clock::now();
    answer(pending, Place::noThread);
    connections_.drop(*chosen);
  }
}

} // namespace gnomon
