#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <sys/types.h>

#include "protocol/base/result.h"
#include "server/wire/channel.h"

namespace gnomon {

/// A worker: another process of this program, at the other end of a channel. It ends when the channel is closed.
class WorkerProcess {
 public:
  /// `program`: a path; it is started as "PROGRAM worker", with its end of the channel as descriptor 3. A worker has
  /// none of this process's other files, and no signal that is meant for this process reaches it.
  static Result<std::shared_ptr<WorkerProcess>> start(const std::string& program);

  ~WorkerProcess(); ///< kills it

  Channel& channel() { return channel_; }
  pid_t pid() const { return pid_; }

  /// Any thread, any time.
  void kill() noexcept;

  struct Ending {
    std::string how;       ///< "exit status 0", "signal 9"
    bool isKilled = false; ///< by SIGKILL, from any process
  };

  /// Waits until it has ended, and ends what it has started. Once, by one thread.
  Ending end();

  /// Bytes of memory that it has now; 0 where that is unknown.
  std::uint64_t residentBytes() const;

 private:
  WorkerProcess(pid_t pid, FileDescriptor channel);

  pid_t pid_;
  FileDescriptor
      memory_; ///< its /proc/PID/statm, opened while it is visible: a process that none may look into may not be
  std::mutex ending_;
  bool ended_ = false; ///< its id may be another process's now
  Channel channel_;
};

} // namespace gnomon
