#include "tests/support/cpu_grant.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include "renderer/core/control_groups.h"

namespace gnomon {
namespace {

constexpr const char* kMounted = "/sys/fs/cgroup"; // where systems and containers have them

/// Puts a folder over the mounted control groups, for this process alone, in which its own grants `cores`.
bool mountGrant(int cores) {
  const bool root = geteuid() == 0;
  if (unshare(root ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0) return false;
  if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  if (mount("none", kMounted, "tmpfs", 0, nullptr) != 0) return false;
  bool any = false;
  for (const std::filesystem::path& group : controlGroups("cpu")) {
    if (!group.string().starts_with(kMounted)) continue;
    std::filesystem::create_directories(group);
    std::ofstream(group / "cpu.max") << cores * 100000 << " 100000\n";
    std::ofstream(group / "cpu.cfs_quota_us") << cores * 100000 << '\n';
    std::ofstream(group / "cpu.cfs_period_us") << "100000\n";
    any = true;
  }
  return any;
}

} // namespace

bool canGrantCores() {
  const pid_t child = fork();
  if (child == 0) _exit(mountGrant(1) ? 0 : 1);
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void grantCores(int cores) {
  if (mountGrant(cores)) return;
  std::perror("grantCores");
  std::abort();
}

int threadCount() {
  int count = 0;
  for ([[maybe_unused]] const auto& task : std::filesystem::directory_iterator("/proc/self/task")) ++count;
  return count;
}

} // namespace gnomon
