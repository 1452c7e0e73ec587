#pragma once

#include <span>
#include <string>
#include <sys/types.h>

namespace gnomon {

/// What a worker that was taken over could try.
struct Escape {
  enum Keeper { everySeal, fullSeal, landlock };

  const char* what;
  Keeper keeper; ///< what refuses it; landlock: of a worker with a driver, any seal without one
  /// As a system call: -1 with errno, or what it gives. `front`: the process that it is after; `secret`: a file that
  /// both may read and write, where they are the same user.
  long (*run)(pid_t front, const std::string& secret);
};

std::span<const Escape> escapes();

/// Whether it was not refused: a call that fails for another reason has reached the system.
bool succeeds(const Escape& escape, pid_t front, const std::string& secret);

} // namespace gnomon
