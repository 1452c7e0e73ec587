#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "server/http/connection.h"

namespace gnomon {

/// Serves the connections for which no worker thread is free. One thread watches them all, so that a silent client
/// delays nobody: probes are answered, every other request gets 503 with Retry-After, and each connection ends after
/// one reply.
class OverflowLane {
 public:
  explicit OverflowLane(ConnectionContext& context);
  ~OverflowLane();
  OverflowLane(const OverflowLane&) = delete;
  OverflowLane& operator=(const OverflowLane&) = delete;

  /// Takes the connection over; closes it at once where too many wait already.
  void adopt(FileDescriptor socket) noexcept;

 private:
  struct Client {
    FileDescriptor socket;
    std::string received;
    Clock::time_point deadline;
    bool answered = false; ///< only waits for the client to close
  };

  void watch();
  void takeAdopted(std::vector<Client>& clients);
  bool stays(Client& client, short events);
  void answer(Client& client, std::size_t headBytes);

  ConnectionContext& context_;
  StopSignal wake_;
  std::atomic<bool> stopping_ = false;
  std::mutex mutex_;
  std::vector<FileDescriptor> adopted_;
  std::size_t count_ = 0; ///< adopted and watched connections
  std::thread thread_;
};

} // namespace gnomon
