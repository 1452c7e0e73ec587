#pragma once

namespace gnomon {

/// What a process does from now on, and so the system calls that it keeps (seccomp(2)).
enum class Duty {
  compute, ///< the threads and the memory that it has, and reading and writing of the files that are open
  work,    ///< that with more threads, files in memory, pipes and pairs of connected sockets
  draw,    ///< that with a graphics driver: opens files that exist, controls devices, runs code that it makes
  start    ///< computes, opens files to read, and starts the program that is open as kProgram
};

/// The descriptor by which Duty::start has its program. No call of such a process puts another file there.
inline constexpr int kProgram = 100;

/// Gives up every other call, for good and for all threads of the process and all that it starts: a call fails with
/// EPERM. Whatever names a process names this one: none is signalled, traced, scheduled or limited, and no file sends a
/// signal. Memory holds code that is made only with Duty::draw, or Duty::start, whose program loads libraries.
/// A filter can't read text: with Duty::start a program of another path is kept off by file_access.h alone, and any
/// duty may ask whether a file exists. 0, or an error number.
int keepSystemCalls(Duty duty);

/// Gives up all capabilities (capabilities(7)) and whatever a program could bring with it (no_new_privs), for good.
/// 0, or an error number.
int dropPrivileges();

} // namespace gnomon
