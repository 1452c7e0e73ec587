#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "server/http/connection.h"
#include "server/http/connection_set.h"
#include "server/http/request_log.h"
#include "server/http/waiting_replies.h"
#include "server/http/worker_pool.h"
#include "server/system/fair_shares.h"

namespace gnomon {

/// Holds every connection that has no request to serve: new ones, idle ones, slow ones whose head is still coming, and
/// those that only wait to be closed. One thread watches them all, so that an idle client holds up no other, and gives
/// each complete head, and each reply that goes on, to a thread of its own. Where none is free, it answers itself:
/// probes as ever, anything else with 503, and with 429 where this client alone takes too many. Replies that wait are
/// handed to another thread (WaitingReplies).
class PendingConnections {
 public:
  /// `threads` serve requests, at most `perClient` of them for one client; 0 = its share of them (FairShares). Throws
  /// std::system_error where the system refuses a thread.
  PendingConnections(ConnectionContext& context, std::size_t threads, std::size_t perClient);
  ~PendingConnections() { finish(); }

  /// Takes the connection over. Where too many wait, the client that has the most of them loses its oldest that has
  /// not asked for anything yet; if all have, its newest is refused.
  void adopt(OpenConnection connection) noexcept;

  /// The same for a new connection, and returns once this thread keeps up: until then others wait in the system's
  /// queue, where they take no descriptors.
  void admit(OpenConnection connection) noexcept;

  /// Closes one connection that waits: the system has no further descriptors. Takes effect a little later.
  void makeRoom() noexcept;

  /// The context's cutBodies was raised: heads that are incomplete, or have no thread yet, get 503.
  void cutOff() noexcept { wake_.raise(); }

  /// Closes what is idle, and returns when every request whose head has begun to come is answered. Once.
  void finish();

 private:
  enum class Place { taken, noThread, noShare };

  void watch();
  bool isOver();
  bool isSettled();
  void takeAdopted();
  void onReadable(int fd, bool lost);
  PeerAddress clientOf(const OpenConnection& connection, std::size_t headBytes) const;
  void checkHead(PendingConnection& pending, bool headBegins);
  void placeReady();
  Place place(int fd, const PendingConnection& pending);
  void answer(PendingConnection& pending, Place why);
  void lose(int fd, Delivery how);
  void noteThreads();
  void refuse(PendingConnection& pending, Problem problem);
  void sendLast(PendingConnection& pending, RequestRecord& record, HttpReply reply, bool bodyless);
  void refuseLate();
  void dropIdle();
  void refuseWaiting();
  void dropOne();

  ConnectionContext& context_;
  FairShares shares_;
  StopSignal wake_;
  std::atomic<bool> finishing_ = false;
  std::atomic<bool> roomWanted_ = false;
  std::mutex mutex_;
  std::vector<OpenConnection> adopted_;
  std::condition_variable taken_; ///< adopted_ was emptied
  // Of the watching thread alone:
  ConnectionSet connections_{wake_};
  std::vector<int> ready_; ///< descriptors of connections that wait for a thread, in order
  bool isDrained_ = false; ///< finishing, and no thread serves any longer
  bool isLacking_ = false; ///< some of `ready_` found no thread
  WorkerPool pool_;
  WaitingReplies waiting_;
  std::thread thread_;
};

} // namespace gnomon
