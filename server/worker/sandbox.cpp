#include "server/worker/sandbox.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <linux/capability.h>
#include <memory>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <system_error>
#include <unistd.h>

#include "server/worker/worker.h"

namespace gnomon {
namespace {

/// Memory, threads, clocks, signals to itself, and what descriptors that it has are good for.
constexpr std::array kAlways{SCMP_SYS(brk),
                             SCMP_SYS(mmap),
                             SCMP_SYS(munmap),
                             SCMP_SYS(mprotect),
                             SCMP_SYS(mremap),
                             SCMP_SYS(madvise),
                             SCMP_SYS(membarrier),
                             SCMP_SYS(memfd_create),
                             SCMP_SYS(mincore),
                             SCMP_SYS(pkey_alloc),
                             SCMP_SYS(pkey_free),
                             SCMP_SYS(futex),
                             SCMP_SYS(set_robust_list),
                             SCMP_SYS(get_robust_list),
                             SCMP_SYS(rseq),
                             SCMP_SYS(set_tid_address),
                             SCMP_SYS(sched_yield),
                             SCMP_SYS(sched_getaffinity),
                             SCMP_SYS(sched_setaffinity),
                             SCMP_SYS(sched_getparam),
                             SCMP_SYS(sched_getscheduler),
                             SCMP_SYS(get_mempolicy),
                             SCMP_SYS(set_mempolicy),
                             SCMP_SYS(getcpu),
                             SCMP_SYS(exit),
                             SCMP_SYS(exit_group),
                             SCMP_SYS(restart_syscall),
                             SCMP_SYS(gettid),
                             SCMP_SYS(getpid),
                             SCMP_SYS(getppid),
                             SCMP_SYS(getuid),
                             SCMP_SYS(geteuid),
                             SCMP_SYS(getgid),
                             SCMP_SYS(getegid),
                             SCMP_SYS(uname),
                             SCMP_SYS(sysinfo),
                             SCMP_SYS(getrusage),
                             SCMP_SYS(getrandom),
                             SCMP_SYS(times),
                             SCMP_SYS(clock_gettime),
                             SCMP_SYS(clock_getres),
                             SCMP_SYS(clock_nanosleep),
                             SCMP_SYS(nanosleep),
                             SCMP_SYS(gettimeofday),
                             SCMP_SYS(time),
                             SCMP_SYS(rt_sigaction),
                             SCMP_SYS(rt_sigprocmask),
                             SCMP_SYS(rt_sigreturn),
                             SCMP_SYS(rt_sigtimedwait),
                             SCMP_SYS(sigaltstack),
                             SCMP_SYS(read),
                             SCMP_SYS(readv),
                             SCMP_SYS(pread64),
                             SCMP_SYS(write),
                             SCMP_SYS(writev),
                             SCMP_SYS(pwrite64),
                             SCMP_SYS(lseek),
                             SCMP_SYS(close),
                             SCMP_SYS(fstat),
                             SCMP_SYS(ftruncate),
                             SCMP_SYS(fcntl),
                             SCMP_SYS(dup),
                             SCMP_SYS(poll),
                             SCMP_SYS(ppoll),
                             SCMP_SYS(eventfd2),
                             SCMP_SYS(pipe2),
                             SCMP_SYS(recvmsg),
                             SCMP_SYS(sendmsg)};

/// What Mesa and other drivers do beside it while they draw.
constexpr std::array kOfDrivers{SCMP_SYS(openat),
                                SCMP_SYS(open),
                                SCMP_SYS(access),
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
                                SCMP_SYS(mkdir),
                                SCMP_SYS(mkdirat),
                                SCMP_SYS(rename),
                                SCMP_SYS(renameat),
                                SCMP_SYS(unlink),
                                SCMP_SYS(unlinkat),
                                SCMP_SYS(flock),
                                SCMP_SYS(fallocate),
                                SCMP_SYS(fsync),
                                SCMP_SYS(utimensat),
                                SCMP_SYS(ioctl),
                                SCMP_SYS(kcmp),
                                SCMP_SYS(epoll_create1),
                                SCMP_SYS(epoll_ctl),
                                SCMP_SYS(epoll_wait),
                                SCMP_SYS(epoll_pwait),

                                SCMP_SYS(timerfd_create),
                                SCMP_SYS(timerfd_settime),
                                SCMP_SYS(sched_get_priority_max),
                                SCMP_SYS(sched_get_priority_min),
                                SCMP_SYS(sched_setscheduler),
                                SCMP_SYS(sched_setattr),
                                SCMP_SYS(setpriority),
                                SCMP_SYS(getpriority),
                                SCMP_SYS(shmget),
                                SCMP_SYS(shmat),
                                SCMP_SYS(shmdt),
                                SCMP_SYS(shmctl)};

Problem refused(int error) {
  return {ProblemCode::unavailable, "", "The system refused to seal a worker.", "",
          std::error_code(error, std::generic_category()).message()};
}

/// libseccomp's own macros are C's.
scmp_arg_cmp where(unsigned argument, scmp_compare compare, scmp_datum_t a, scmp_datum_t b = 0) {
  return {argument, compare, a, b};
}

/// 0, or an error number.
int allow(scmp_filter_ctx filter, Seal kind) {
  int error = 0;
  const auto add = [&](auto... rule) {
    if (error == 0) error = ::seccomp_rule_add(filter, rule...);
  };
  for (const int call : kAlways) add(SCMP_ACT_ALLOW, call, 0u);
  if (kind == Seal::drivers) {
    for (const int call : kOfDrivers) add(SCMP_ACT_ALLOW, call, 0u);
  } else { // glibc's fstat()
    add(SCMP_ACT_ALLOW, SCMP_SYS(newfstatat), 1u, where(3, SCMP_CMP_EQ, AT_EMPTY_PATH));
  }
  // Threads, not processes. The flags of clone3 lie in memory, where a filter can't see them: glibc then uses clone.
  add(SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0u);
  add(SCMP_ACT_ALLOW, SCMP_SYS(clone), 1u, where(0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, CLONE_THREAD));
  // Signals to itself, which abort() needs.
  add(SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1u, where(0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(::getpid())));
  add(SCMP_ACT_ALLOW, SCMP_SYS(socketpair), 1u, where(0, SCMP_CMP_EQ, AF_UNIX));
  add(SCMP_ACT_ALLOW, SCMP_SYS(prctl), 1u, where(0, SCMP_CMP_EQ, PR_SET_NAME));
  // Reads its limits; only its own, and sets none.
  add(SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), 2u, where(0, SCMP_CMP_EQ, 0), where(2, SCMP_CMP_EQ, 0));
  return -error;
}

int dropCapabilities() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> none{};
  return ::syscall(SYS_capset, &header, none.data()) == 0 ? 0 : errno;
}

/// Never more than it has.
int limit(__rlimit_resource resource, rlim_t most) {
  rlimit value{};
  if (::getrlimit(resource, &value) != 0) return errno;
  value = {std::min(value.rlim_max, most), std::min(value.rlim_max, most)};
  return ::setrlimit(resource, &value) == 0 ? 0 : errno;
}

} // namespace

bool allocationsAreBounded() {
#ifdef __SANITIZE_ADDRESS__
  return false;
#else
  return true;
#endif
}

void closeInherited() {
  const FileDescriptor nothing(::open("/dev/null", O_RDWR | O_CLOEXEC));
  ::dup2(nothing.get(), STDIN_FILENO);
  ::dup2(nothing.get(), STDOUT_FILENO);
  ::syscall(SYS_close_range, kWorkerChannel + 1, ~0u, 0);
}

Status seal(Seal kind, std::uint64_t memoryBytes) {
  constexpr rlim_t kMostFiles = 256; // bundles, requests and replies in hand
  if (const int error = limit(RLIMIT_CORE, 0)) return refused(error);
  if (const int error = limit(RLIMIT_NOFILE, kMostFiles)) return refused(error);
  if (memoryBytes > 0 && allocationsAreBounded()) {
    if (const int error = limit(RLIMIT_DATA, memoryBytes + memoryBytes / 4)) return refused(error);
  }
  if (const int error = dropCapabilities()) return refused(error);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return refused(errno);
  const std::unique_ptr<void, decltype(&::seccomp_release)> filter(::seccomp_init(SCMP_ACT_ERRNO(EPERM)),
                                                                   &::seccomp_release);
  if (!filter) return refused(ENOMEM);
  if (const int error = ::seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1)) return refused(-error);
  if (const int error = allow(filter.get(), kind)) return refused(error);
  if (const int error = ::seccomp_load(filter.get())) return refused(-error);
  return Done{};
}

} // namespace gnomon
