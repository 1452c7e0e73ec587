#include "server/http/pending_connections.h"

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
#include "server/http/unserved_reply.h"
#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr std::size_t kMostUnseen = 32;           ///< connections that the watching thread has not seen yet
constexpr std::chrono::seconds kLongestUnseen{1}; ///< that a new one waits for it at most

Problem noPlace(bool clientHasItsShare) {
  if (clientHasItsShare) {
    return {ProblemCode::busy, "", "Other requests from this address take all the threads that it may have.", "", ""};
  }
  return {ProblemCode::unavailable, "", "The server already serves as many requests as it can.", "", ""};
}

} // namespace

PendingConnections::PendingConnections(ConnectionContext& context, std::size_t threads, std::size_t perClient)
    : context_(context),
      shares_(threads, perClient),
      pool_(threads),
      waiting_(context, [this](OpenConnection connection) { adopt(std::move(connection)); }),
      thread_([this] { watch(); }) {}

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

void PendingConnections::watch() {
  constexpr std::chrono::milliseconds kRetry{2}; // while a head waits for a thread, or all is to end
  while (true) {
    try {
      if (isOver()) return;
      const bool isSoon = !ready_.empty() || finishing_;
      for (const auto& [fd, isLost] : connections_.wait(isSoon ? Clock::now() + kRetry : Clock::time_point::max())) {
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
    if (own.held) {
      pending->isReady = true;
      pending->client = {own.held->record.client, own.held->holder.client};
      pending->deadline = Clock::time_point::max(); // its beginning may be sent: nothing else can be said
      connections_.stopReading(*pending);
      ready_.push_back(own.socket.get());
      continue;
    }
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
    if (lost) lose(fd, Delivery::clientLeft);
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
  if (!isLacking_) noteThreads();
  isLacking_ = false;
  std::vector<int> still;
  for (const int fd : std::exchange(ready_, {})) {
    PendingConnection* const pending = connections_.find(fd);
    if (pending == nullptr || !pending->isReady) continue;
    const Place where = place(fd, *pending);
    if (where == Place::taken) continue;
    isLacking_ = isLacking_ || where == Place::noThread;
    if (!pending->isWaiting || Clock::now() >= pending->deadline) answer(*pending, where);
    if (pending->isReady) still.push_back(fd);
  }
  ready_ = std::move(still);
  noteThreads();
}

/// Since when a request that comes finds no thread, for probes.
void PendingConnections::noteThreads() {
  if (!isLacking_ && pool_.hasIdle()) {
    context_.lackingThreads.end();
  } else {
    context_.lackingThreads.begin();
  }
}

PendingConnections::Place PendingConnections::place(int fd, const PendingConnection& pending) {
  const ClientIdentity client = pending.client.identity;
  if (!pool_.hasIdle()) return Place::noThread;
  if (!shares_.take(client)) return Place::noShare;
  const auto connection = std::make_shared<OpenConnection>(connections_.release(fd));
  pool_.tryRun([this, connection, client] {
    auto kept = serveConnection(std::move(*connection), context_, [this] { return pool_.hasIdle(); });
    shares_.giveBack(client);
    if (!kept) return;
    if (kept->held) {
      waiting_.adopt(*std::move(kept));
    } else {
      adopt(*std::move(kept));
    }
  });
  return Place::taken;
}

/// For a head that found no thread: probes are answered, others go on waiting, and are refused when they are late.
void PendingConnections::answer(PendingConnection& pending, Place why) {
  if (pending.connection.held) return;
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

} // namespace gnomon
