#include "tests/server/worker/escapes.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <linux/sched.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

namespace gnomon {
namespace {

constexpr std::size_t kPage = 4096;

/// A call by its number; what it gives is -1 with errno where it fails.
template <class... Arguments>
long call(long number, Arguments... arguments) {
  return ::syscall(number, arguments...);
}

long withPipe(long (*use)(int reading, pid_t front), pid_t front) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), 0) != 0) return -1;
  const long result = use(ends[0], front);
  const int error = errno;
  for (const int end : ends) ::close(end);
  errno = error;
  return result;
}

/// A child that is started goes at once.
long ended(long child) {
  if (child == 0) ::_exit(0);
  return child;
}

long opened(const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags, 0600);
  if (file >= 0) ::close(file);
  return file;
}

std::string of(pid_t process, const char* file) {
  return "/proc/" + std::to_string(process) + "/" + file;
}

long mapped(int protection) {
  void* memory = ::mmap(nullptr, kPage, protection, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return -1;
  ::munmap(memory, kPage);
  return 0;
}

const std::array kEscapes{
    // Programs and processes
    Escape{"execute a program", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_execve, "/nonexistent", nullptr, nullptr); }},
    Escape{"execute a file in memory", Escape::everySeal,
           [](pid_t, const std::string&) {
             return call(SYS_execveat, ::memfd_create("x", 0), "", nullptr, nullptr, AT_EMPTY_PATH);
           }},
    Escape{"start a process", Escape::everySeal,
           [](pid_t, const std::string&) { return ended(call(SYS_clone, SIGCHLD, 0, 0, 0, 0)); }},
    Escape{"start a process by clone3", Escape::everySeal,
           [](pid_t, const std::string&) {
             clone_args arguments{};
             arguments.exit_signal = SIGCHLD;
             return ended(call(SYS_clone3, &arguments, sizeof arguments));
           }},
    // Signals
    Escape{"signal", Escape::everySeal, [](pid_t front, const std::string&) { return call(SYS_kill, front, 0); }},
    Escape{"signal a thread", Escape::everySeal,
           [](pid_t front, const std::string&) { return call(SYS_tgkill, front, front, 0); }},
    Escape{"signal by a descriptor", Escape::everySeal,
           [](pid_t front, const std::string&) { return call(SYS_pidfd_open, front, 0); }},
    Escape{"own a file's signals", Escape::everySeal,
           [](pid_t front, const std::string&) {
             return withPipe([](int end, pid_t owner) -> long { return ::fcntl(end, F_SETOWN, owner); }, front);
           }},
    Escape{"choose a file's signal", Escape::everySeal,
           [](pid_t front, const std::string&) {
             return withPipe([](int end, pid_t) -> long { return ::fcntl(end, F_SETSIG, SIGKILL); }, front);
           }},
    Escape{"have a file send signals", Escape::everySeal,
           [](pid_t front, const std::string&) {
             return withPipe([](int end, pid_t) -> long { return ::fcntl(end, F_SETFL, O_ASYNC); }, front);
           }},
    Escape{"have a file send signals by ioctl", Escape::everySeal,
           [](pid_t front, const std::string&) {
             return withPipe(
                 [](int end, pid_t) -> long {
                   int on = 1;
                   return ::ioctl(end, FIOASYNC, &on);
                 },
                 front);
           }},
    Escape{"own a socket's signals", Escape::everySeal,
           [](pid_t front, const std::string&) {
             std::array<int, 2> ends{};
             if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) return -1L;
             return static_cast<long>(::ioctl(ends[0], FIOSETOWN, &front));
           }},
    Escape{"type into a terminal", Escape::everySeal,
           [](pid_t, const std::string&) {
             char letter = 'x';
             return static_cast<long>(::ioctl(STDIN_FILENO, TIOCSTI, &letter));
           }},
    Escape{"lease a file", Escape::everySeal,
           [](pid_t, const std::string&) {
             return static_cast<long>(::fcntl(::memfd_create("x", 0), F_SETLEASE, F_WRLCK));
           }},
    // Other processes
    Escape{"trace", Escape::everySeal,
           [](pid_t, const std::string&) { return ::ptrace(PTRACE_PEEKDATA, 0, nullptr, nullptr); }},
    Escape{"read memory", Escape::everySeal,
           [](pid_t front, const std::string&) {
             return static_cast<long>(::process_vm_readv(front, nullptr, 0, nullptr, 0, 0));
           }},
    Escape{"compare files", Escape::everySeal,
           [](pid_t front, const std::string&) { return call(SYS_kcmp, ::getpid(), front, 0, 0, 0); }},
    Escape{"bind to a processor", Escape::everySeal,
           [](pid_t front, const std::string&) {
             cpu_set_t own{};
             if (::sched_getaffinity(0, sizeof own, &own) != 0) return 0L;
             return static_cast<long>(::sched_setaffinity(front, sizeof own, &own));
           }},
    Escape{"schedule", Escape::everySeal,
           [](pid_t front, const std::string&) {
             const sched_param usual{};
             return call(SYS_sched_setscheduler, front, SCHED_OTHER, &usual);
           }},
    Escape{"set a priority", Escape::everySeal,
           [](pid_t front, const std::string&) { return call(SYS_setpriority, PRIO_PROCESS, front, 0); }},
    Escape{"set the user's priority", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_setpriority, PRIO_USER, 0, 0); }},
    Escape{"read limits", Escape::everySeal,
           [](pid_t front, const std::string&) {
             rlimit value{};
             return call(SYS_prlimit64, front, RLIMIT_CORE, nullptr, &value);
           }},
    // Itself
    Escape{"become dumpable", Escape::everySeal,
           [](pid_t, const std::string&) { return static_cast<long>(::prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)); }},
    Escape{"choose who may trace it", Escape::everySeal,
           [](pid_t, const std::string&) {
             return static_cast<long>(::prctl(PR_SET_PTRACER, PR_SET_PTRACER_ANY, 0, 0, 0));
           }},
    Escape{"have every page be code", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_personality, 0xffffffff); }},
    Escape{"map code", Escape::fullSeal, [](pid_t, const std::string&) { return mapped(PROT_READ | PROT_EXEC); }},
    Escape{"make memory code", Escape::fullSeal,
           [](pid_t, const std::string&) {
             void* memory = ::mmap(nullptr, kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
             return static_cast<long>(::mprotect(memory, kPage, PROT_READ | PROT_EXEC));
           }},
    // Sockets and shared memory
    Escape{"open a socket", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_socket, AF_INET, SOCK_STREAM, 0); }},
    Escape{"open a local socket", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_socket, AF_UNIX, SOCK_STREAM, 0); }},
    Escape{"make a socket that sends to any name", Escape::everySeal,
           [](pid_t, const std::string&) {
             std::array<int, 2> ends{};
             return call(SYS_socketpair, AF_UNIX, SOCK_DGRAM, 0, ends.data());
           }},
    Escape{"connect", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_connect, STDIN_FILENO, nullptr, 0); }},
    Escape{"share memory by a key", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_shmctl, 0, SHM_INFO, nullptr); }},
    Escape{"queue calls", Escape::everySeal,
           [](pid_t, const std::string&) { return call(SYS_io_uring_setup, 0, nullptr); }},
    // Files
    Escape{"make a file", Escape::everySeal,
           [](pid_t, const std::string& secret) { return opened(secret + ".new", O_WRONLY | O_CREAT); }},
    Escape{"empty a file", Escape::everySeal,
           [](pid_t, const std::string& secret) { return opened(secret, O_WRONLY | O_TRUNC); }},
    Escape{"make a folder", Escape::everySeal,
           [](pid_t, const std::string& secret) { return call(SYS_mkdirat, AT_FDCWD, secret.c_str(), 0700); }},
    Escape{
        "rename a file", Escape::everySeal,
        [](pid_t, const std::string& secret) { return static_cast<long>(::rename(secret.c_str(), secret.c_str())); }},
    Escape{"remove a file", Escape::everySeal,
           [](pid_t, const std::string& secret) { return call(SYS_unlinkat, AT_FDCWD, (secret + ".no").c_str(), 0); }},
    Escape{"read a file", Escape::landlock, [](pid_t, const std::string& secret) { return opened(secret, O_RDONLY); }},
    Escape{"change a file", Escape::landlock, [](pid_t, const std::string& secret) { return opened(secret, O_RDWR); }},
    Escape{"list a folder", Escape::landlock, [](pid_t, const std::string&) { return opened("/tmp", O_RDONLY); }},
    Escape{"read who the users are", Escape::landlock,
           [](pid_t, const std::string&) { return opened("/etc/passwd", O_RDONLY); }},
    Escape{"read command lines", Escape::landlock,
           [](pid_t front, const std::string&) { return opened(of(front, "cmdline"), O_RDONLY); }},
    Escape{"read variables", Escape::landlock,
           [](pid_t front, const std::string&) { return opened(of(front, "environ"), O_RDONLY); }},
    Escape{"change memory", Escape::landlock,
           [](pid_t front, const std::string&) { return opened(of(front, "mem"), O_RDWR); }},
    Escape{"read a library", Escape::fullSeal, [](pid_t, const std::string&) { return opened("/usr/lib", O_RDONLY); }},
};

} // namespace

std::span<const Escape> escapes() {
  return kEscapes;
}

bool succeeds(const Escape& escape, pid_t front, const std::string& secret) {
  errno = 0;
  const bool isRefused = escape.run(front, secret) == -1 && (errno == EPERM || errno == EACCES || errno == ENOSYS);
  return !isRefused;
}

} // namespace gnomon
