#include "renderer/core/system_calls.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <initializer_list>
#include <linux/capability.h>
#include <linux/sched.h>
#include <memory>
#include <seccomp.h>
#include <span>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace gnomon {
namespace {

constexpr std::array kComputing{
    // Memory
    SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(mincore), SCMP_SYS(membarrier),
    // The thread and its end
    SCMP_SYS(futex), SCMP_SYS(set_robust_list), SCMP_SYS(get_robust_list), SCMP_SYS(rseq), SCMP_SYS(set_tid_address),
    SCMP_SYS(gettid), SCMP_SYS(getpid), SCMP_SYS(sched_yield), SCMP_SYS(sched_getaffinity), SCMP_SYS(getcpu),
    SCMP_SYS(exit), SCMP_SYS(exit_group), SCMP_SYS(restart_syscall),
    // What the system says of itself and of the process
    SCMP_SYS(getppid), SCMP_SYS(getuid), SCMP_SYS(geteuid), SCMP_SYS(getgid), SCMP_SYS(getegid), SCMP_SYS(uname),
    SCMP_SYS(sysinfo), SCMP_SYS(getrusage), SCMP_SYS(getrandom), SCMP_SYS(times), SCMP_SYS(clock_gettime),
    SCMP_SYS(clock_getres), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep), SCMP_SYS(gettimeofday), SCMP_SYS(time),
    // Its signals
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(rt_sigtimedwait),
    SCMP_SYS(sigaltstack),
    // Open files
    SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(write), SCMP_SYS(writev), SCMP_SYS(pwrite64),
    SCMP_SYS(lseek), SCMP_SYS(fstat), SCMP_SYS(poll), SCMP_SYS(ppoll)};

constexpr std::array kWorking{SCMP_SYS(memfd_create), SCMP_SYS(ftruncate),     SCMP_SYS(pkey_alloc),
                              SCMP_SYS(pkey_free),    SCMP_SYS(get_mempolicy), SCMP_SYS(set_mempolicy),
                              SCMP_SYS(dup),          SCMP_SYS(eventfd2),      SCMP_SYS(pipe2),
                              SCMP_SYS(recvmsg),      SCMP_SYS(sendmsg)};

/// What Mesa and other drivers do beside it while they draw.
constexpr std::array kDrawing{SCMP_SYS(access),
                              SCMP_SYS(faccessat),
                              SCMP_SYS(faccessat2),
                              SCMP_SYS(stat),
                              SCMP_SYS(lstat),
                              SCMP_SYS(newfstatat),
                              SCMP_SYS(statx),
                              SCMP_SYS(statfs),
                              SCMP_SYS(fstatfs),
                              SCMP_SYS(readlink),
                              SCMP_SYS(readlinkat),
                              SCMP_SYS(getcwd),
                              SCMP_SYS(getdents64),
                              SCMP_SYS(fallocate),
                              SCMP_SYS(epoll_create1),
                              SCMP_SYS(epoll_ctl),
                              SCMP_SYS(epoll_wait),
                              SCMP_SYS(epoll_pwait),
                              SCMP_SYS(timerfd_create),
                              SCMP_SYS(timerfd_settime),
                              SCMP_SYS(sched_get_priority_max),
                              SCMP_SYS(sched_get_priority_min)};

/// What starting a program takes, and what the program does until it seals itself.
constexpr std::array kStarting{SCMP_SYS(access),  SCMP_SYS(faccessat), SCMP_SYS(readlink), SCMP_SYS(readlinkat),
                               SCMP_SYS(wait4),   SCMP_SYS(waitid),    SCMP_SYS(pipe2),    SCMP_SYS(recvmsg),
                               SCMP_SYS(seccomp), SCMP_SYS(capset),    SCMP_SYS(capget),   SCMP_SYS(arch_prctl)};

/// The kinds of ioctl(2) that graphics devices have, by the second byte of the request: GEM and KMS, buffers and fences
/// that are shared, NVIDIA (both), the paravirtual GPU, Mali, and NVIDIA's memory, which has none. Not
/// those of terminals and sockets, which send signals and type into terminals.
constexpr std::array<scmp_datum_t, 8> kDeviceControls{'d', 'b', '>', 'F', 'm', 'G', 0x80, 0};

/// libseccomp's own macros are C's.
scmp_arg_cmp is(unsigned argument, scmp_datum_t value) {
  return {argument, SCMP_CMP_EQ, value, 0};
}
scmp_arg_cmp hasBits(unsigned argument, scmp_datum_t mask, scmp_datum_t value) {
  return {argument, SCMP_CMP_MASKED_EQ, mask, value};
}

/// The rules of a filter. Each call is allowed where all conditions of one of its rules hold.
class Rules {
 public:
  explicit Rules(scmp_filter_ctx filter) : filter_(filter) {}

  void allow(int call, std::initializer_list<scmp_arg_cmp> conditions = {}) {
    if (error_ != 0) return;
    error_ = -::seccomp_rule_add_array(filter_, SCMP_ACT_ALLOW, call, static_cast<unsigned>(conditions.size()),
                                       conditions.begin());
  }
  void allowAll(std::span<const int> calls) {
    for (const int call : calls) allow(call);
  }
  void isMissing(int call) {
    if (error_ == 0) error_ = -::seccomp_rule_add_array(filter_, SCMP_ACT_ERRNO(ENOSYS), call, 0, nullptr);
  }
  int error() const { return error_; }

 private:
  scmp_filter_ctx filter_;
  int error_ = 0;
};

void allowComputing(Rules& rules, bool mayMakeCode, bool hasProgram) {
  rules.allowAll(kComputing);
  if (hasProgram) {
    rules.allow(SCMP_SYS(close), {{0, SCMP_CMP_NE, kProgram, 0}});
  } else {
    rules.allow(SCMP_SYS(close));
  }
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)}) {
    if (mayMakeCode) {
      rules.allow(call);
    } else {
      rules.allow(call, {hasBits(2, PROT_EXEC, 0)});
    }
  }
  rules.allow(SCMP_SYS(tgkill), {is(0, static_cast<scmp_datum_t>(::getpid()))}); // abort()
  rules.allow(SCMP_SYS(prctl), {is(0, PR_SET_NAME)});
  // The flags of clone3 lie in memory, where a filter can't see them: glibc then uses clone.
  rules.isMissing(SCMP_SYS(clone3));
  // Owners and signals of files are not among them: F_SETOWN and F_SETSIG kill any process of the user.
  for (const scmp_datum_t command : {F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL, F_ADD_SEALS, F_GET_SEALS}) {
    rules.allow(SCMP_SYS(fcntl), {is(1, command)});
  }
  rules.allow(SCMP_SYS(fcntl), {is(1, F_SETFL), hasBits(2, O_ASYNC, 0)});
}

void allowWorking(Rules& rules) {
  rules.allowAll(kWorking);
  rules.allow(SCMP_SYS(clone), {hasBits(0, CLONE_THREAD, CLONE_THREAD)});
  rules.allow(SCMP_SYS(sched_setaffinity), {is(0, 0)});
  rules.allow(SCMP_SYS(prlimit64), {is(0, 0), is(2, 0)}); // reads its limits
  // Not datagrams: each names whom it goes to, as the system's log or its service manager.
  constexpr scmp_datum_t kType = 0xf;
  rules.allow(SCMP_SYS(socketpair), {is(0, AF_UNIX), hasBits(1, kType, SOCK_STREAM)});
}

void allowDrawing(Rules& rules) {
  rules.allowAll(kDrawing);
  rules.allow(SCMP_SYS(open), {hasBits(1, O_CREAT | O_TRUNC, 0)});
  rules.allow(SCMP_SYS(openat), {hasBits(2, O_CREAT | O_TRUNC, 0)});
  constexpr scmp_datum_t kKind = 0xff00;
  for (const scmp_datum_t kind : kDeviceControls) rules.allow(SCMP_SYS(ioctl), {hasBits(1, kKind, kind << 8)});
  const auto self = static_cast<scmp_datum_t>(::getpid());
  rules.allow(SCMP_SYS(kcmp), {is(0, self), is(1, self)});
  for (const int call : {SCMP_SYS(sched_setscheduler), SCMP_SYS(sched_setattr), SCMP_SYS(sched_getscheduler)}) {
    rules.allow(call, {is(0, 0)});
  }
  for (const int call : {SCMP_SYS(setpriority), SCMP_SYS(getpriority)}) {
    rules.allow(call, {is(0, PRIO_PROCESS), is(1, 0)});
  }
}

void allowStarting(Rules& rules) {
  rules.allowAll(kStarting);
  constexpr scmp_datum_t kChanges = O_ACCMODE | O_CREAT | O_TRUNC;
  rules.allow(SCMP_SYS(open), {hasBits(1, kChanges, O_RDONLY)});
  rules.allow(SCMP_SYS(openat), {hasBits(2, kChanges, O_RDONLY)});
  rules.allow(SCMP_SYS(clone), {is(0, CLONE_CHILD_CLEARTID | CLONE_CHILD_SETTID | SIGCHLD)}); // fork()
  rules.allow(SCMP_SYS(clone), {hasBits(0, CLONE_THREAD, CLONE_THREAD)}); // of libraries, as they are loaded
  rules.allow(SCMP_SYS(execveat), {is(0, kProgram), is(4, AT_EMPTY_PATH)});
  for (const scmp_datum_t standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    rules.allow(SCMP_SYS(dup2), {is(1, standard)});
    rules.allow(SCMP_SYS(dup3), {is(1, standard)});
  }
  rules.allow(SCMP_SYS(prlimit64), {is(0, 0)});
  for (const scmp_datum_t option : {PR_SET_PDEATHSIG, PR_SET_NO_NEW_PRIVS}) {
    rules.allow(SCMP_SYS(prctl), {is(0, option)});
  }
  rules.allow(SCMP_SYS(prctl), {is(0, PR_SET_DUMPABLE), is(1, 0)});
}

} // namespace

int keepSystemCalls(Duty duty) {
  const std::unique_ptr<void, decltype(&::seccomp_release)> filter(::seccomp_init(SCMP_ACT_ERRNO(EPERM)),
                                                                   &::seccomp_release);
  if (!filter) return ENOMEM;
  if (const int error = ::seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1)) return -error;
  Rules rules(filter.get());
  allowComputing(rules, duty == Duty::draw || duty == Duty::start, duty == Duty::start);
  if (duty == Duty::work || duty == Duty::draw) allowWorking(rules);
  if (duty == Duty::draw) {
    allowDrawing(rules);
  } else { // glibc's fstat()
    rules.allow(SCMP_SYS(newfstatat), {is(3, AT_EMPTY_PATH)});
  }
  if (duty == Duty::start) allowStarting(rules);
  return rules.error() != 0 ? rules.error() : -::seccomp_load(filter.get());
}

int dropPrivileges() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> none{};
  if (::syscall(SYS_capset, &header, none.data()) != 0) return errno;
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 ? 0 : errno;
}

} // namespace gnomon
