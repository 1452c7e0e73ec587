#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "server/http/connection.h"

namespace gnomon {

/// Where connections go when every worker is taken. One thread watches them all, so that silent ones hold up nobody:
/// probes are answered, everything else is told to come again, and each connection ends after one reply.
class OverflowLane {
 public:
  explicit OverflowLane(ConnectionContext& context);
  ~OverflowLane();
  OverflowLane(const OverflowLane&) = delete;
  OverflowLane& operator=(const OverflowLane&) = delete;

  /// Takes the connection over; closes it at once when too many wait already.
  void adopt(FileDescriptor socket) noexcept;

 private:
  struct Guest {
    FileDescriptor socket;
    std::string received;
    Clock::time_point deadline;
    bool answered = false; ///< only waits for the client to leave
  };

  void watch();
  void takeNewcomers(std::vector<Guest>& guests);
  bool stays(Guest& guest, short events);
  void answer(Guest& guest, std::size_t headBytes);

  ConnectionContext& context_;
  StopSignal wake_;
  std::atomic<bool> stopping_ = false;
  std::mutex mutex_;
  std::vector<FileDescriptor> newcomers_;
  std::size_t count_ = 0; ///< newcomers and guests
  std::thread thread_;
};

} // namespace gnomon
