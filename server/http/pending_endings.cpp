// How connections that no thread serves end: late ones, those that give room to others, and all of them with the
// server.
#include <algorithm>
#include <optional>
#include <utility>

#include "server/http/pending_connections.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kLastLinger{500}; ///< once the server ends

} // namespace

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

bool PendingConnections::isSettled() {
  if (pool_.isBusy() || !waiting_.isEmpty()) return false; // in the order in which they hand connections on
  const std::lock_guard lock(mutex_);
  const auto& connections = connections_.all();
  return adopted_.empty() && std::all_of(connections.begin(), connections.end(),
                                         [](const auto& pending) { return pending.second.connection.ending; });
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
  for (const int fd : std::exchange(ready_, {})) {
    const PendingConnection* const pending = connections_.find(fd);
    if (pending != nullptr && pending->connection.held) {
      lose(fd, Delivery::shutdown);
    } else {
      ready_.push_back(fd);
    }
  }
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
    lose(*chosen, Delivery::othersWaited);
  }
}

void PendingConnections::lose(int fd, Delivery how) {
  if (const PendingConnection* const pending = connections_.find(fd); pending != nullptr && pending->connection.held) {
    pending->connection.held->lose(context_, how);
  }
  connections_.drop(fd);
}

} // namespace gnomon
