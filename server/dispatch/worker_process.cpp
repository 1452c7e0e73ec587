#include "server/dispatch/worker_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

#include "server/system/memory_limit.h"

namespace gnomon {
namespace {

constexpr int kChannelOfWorker = 3; ///< where `gnomon worker` looks for it

/// This process's, but for the addresses of the store and of jobs, which may hold a password, and with huge pages.
std::vector<std::string> workerVariables() {
  const char* tunables = std::getenv("GLIBC_TUNABLES");
  std::vector<std::string> variables{hugePagesVariable(tunables == nullptr ? "" : tunables)};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const bool leftOut =
        text.starts_with("GNOMON_STORE=") || text.starts_with("GNOMON_JOBS=") || text.starts_with("GLIBC_TUNABLES=");
    if (!leftOut) variables.emplace_back(text);
  }
  return variables;
}

/// posix_spawn(3)'s arguments: the channel's end, no blocked signals, and a process group of its own, so that a Ctrl-C
/// meets the server alone.
class Spawning {
 public:
  explicit Spawning(int channel) {
    ::posix_spawn_file_actions_init(&files_);
    ::posix_spawn_file_actions_adddup2(&files_, channel, kChannelOfWorker);
    ::posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~Spawning() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&files_);
  }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;

  /// The new process; nothing, with errno, where the system refused.
  std::optional<pid_t> spawn(const std::string& program) {
    std::string name = "gnomon", command = "worker";
    const std::array<char*, 3> arguments{name.data(), command.data(), nullptr};
    pid_t pid = 0;
    std::vector<std::string> variables = workerVariables();
    std::vector<char*> pointers(variables.size() + 1);
    std::transform(variables.begin(), variables.end(), pointers.begin(), [](std::string& text) { return text.data(); });
    const int error = ::posix_spawn(&pid, program.c_str(), &files_, &attributes_, arguments.data(), pointers.data());
    errno = error;
    return error == 0 ? std::optional(pid) : std::nullopt;
  }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

/// Of a process that waits for its first message. It begins as closed as this one is, until its program is there, and
/// the system may hide it so long.
FileDescriptor openMemory(pid_t pid) {
  const std::string path = "/proc/" + std::to_string(pid) + "/statm";
  FileDescriptor file;
  constexpr int kMostTries = 200;
  for (int tries = 0; !file && tries < kMostTries; ++tries) {
    if (tries > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    file = FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  }
  return file;
}

Problem refused() {
  return {ProblemCode::unavailable, "", "The system refused to start a worker.", "",
          std::error_code(errno, std::generic_category()).message()};
}

} // namespace

Result<std::shared_ptr<WorkerProcess>> WorkerProcess::start(const std::string& program) {
  auto ends = Channel::pair();
  if (!ends) return refused();
  const auto pid = Spawning(ends->second.get()).spawn(program);
  if (!pid) return refused();
  return std::shared_ptr<WorkerProcess>(new WorkerProcess(*pid, std::move(ends->first)));
}

WorkerProcess::WorkerProcess(pid_t pid, FileDescriptor channel)
    : pid_(pid), memory_(openMemory(pid)), channel_(std::move(channel)) {}

WorkerProcess::~WorkerProcess() {
  kill();
  if (!ended_) end();
}

void WorkerProcess::kill() noexcept {
  const std::lock_guard lock(ending_);
  if (!ended_) ::kill(pid_, SIGKILL);
}

WorkerProcess::Ending WorkerProcess::end() {
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  const std::lock_guard lock(ending_); // its id is free for others from here on
  ::kill(-pid_, SIGKILL);              // the processes that it has started are of its group
  int status = 0;
  ::waitpid(pid_, &status, 0);
  ended_ = true;
  while (::waitpid(-pid_, nullptr, 0) > 0 || errno == EINTR) { // ours, where this process is the first of a container
  }
  if (!WIFSIGNALED(status)) return {"exit status " + std::to_string(WEXITSTATUS(status))};
  return {"signal " + std::to_string(WTERMSIG(status)), WTERMSIG(status) == SIGKILL};
}

std::uint64_t WorkerProcess::residentBytes() const {
  std::array<char, 128> text{}; // proc(5): pages, in all and resident
  if (::pread(memory_.get(), text.data(), text.size() - 1, 0) <= 0) return 0;
  unsigned long long all = 0, resident = 0;
  if (std::sscanf(text.data(), "%llu %llu", &all, &resident) != 2) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

} // namespace gnomon
