#include "server/worker/sandbox.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "renderer/core/file_access.h"
#include "renderer/core/system_calls.h"
#include "server/system/file_descriptor.h"
#include "server/system/memory_limit.h"
#include "server/worker/worker.h"

namespace gnomon {
namespace {

Problem refused(int error) {
  return {ProblemCode::unavailable, "", "The system refused to seal a worker.", "",
          std::error_code(error, std::generic_category()).message()};
}

/// Never more than it has.
int limit(__rlimit_resource resource, rlim_t most) {
  rlimit value{};
  if (::getrlimit(resource, &value) != 0) return errno;
  value = {std::min(value.rlim_max, most), std::min(value.rlim_max, most)};
  return ::setrlimit(resource, &value) == 0 ? 0 : errno;
}

/// What the dynamic linker, drivers and the C library read. Not /etc and /proc as a whole: keys lie in the one, and
/// command lines of other processes in the other.
constexpr const char* kReadFiles[] = {"/usr",
                                      "/lib",
                                      "/lib64",
                                      "/sys",
                                      "/etc/ld.so.cache",
                                      "/etc/ld.so.preload",
                                      "/etc/drirc",
                                      "/etc/glvnd",
                                      "/etc/egl",
                                      "/etc/nvidia",
                                      "/dev/random",
                                      "/dev/urandom",
                                      "/proc/self",
                                      "/proc/stat",
                                      "/proc/meminfo",
                                      "/proc/cpuinfo",
                                      "/proc/devices",
                                      "/proc/modules",
                                      "/proc/version",
                                      "/proc/driver",
                                      "/proc/filesystems",
                                      "/proc/sys/vm"};

constexpr const char* kDevices[] = {"/dev/null", "/dev/zero", "/dev/dri", "/dev/dxg", "/dev/mali0"};

std::vector<FileGrant> filesOfDrawing() {
  std::vector<FileGrant> grants;
  for (const char* path : kReadFiles) grants.push_back({path, FileUse::read});
  for (const char* path : kDevices) grants.push_back({path, FileUse::change});
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", none)) {
    if (entry.path().filename().string().starts_with("nvidia")) grants.push_back({entry.path(), FileUse::change});
  }
  // Where the operator says that libraries are.
  const char* folders = std::getenv("LD_LIBRARY_PATH");
  for (std::string_view left = folders == nullptr ? "" : folders; !left.empty();) {
    const std::size_t end = std::min(left.find(':'), left.size());
    if (end > 0) grants.push_back({std::string(left.substr(0, end)), FileUse::read});
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return grants;
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

Result<bool> confineFiles() {
  if (::prctl(PR_SET_DUMPABLE, 0) != 0) return refused(errno);
  if (const int error = dropPrivileges()) return refused(error);
  for (const auto& [name, value] : {std::pair{"MESA_SHADER_CACHE_DISABLE", "true"}, {"__GL_SHADER_DISK_CACHE", "0"}}) {
    ::setenv(name, value, 1);
  }
  const int error = keepFiles(filesOfDrawing());
  if (error == ENOSYS || error == EOPNOTSUPP) return false;
  if (error != 0) return refused(error);
  return true;
}

Status seal(Seal kind, std::uint64_t memoryBytes) {
  constexpr rlim_t kMostFiles = 256; // bundles, requests and replies in hand
  if (const int error = limit(RLIMIT_CORE, 0)) return refused(error);
  if (const int error = limit(RLIMIT_NOFILE, kMostFiles)) return refused(error);
  if (memoryBytes > 0 && allocationsAreBounded()) {
    std::ostringstream status;
    status << std::ifstream("/proc/self/status").rdbuf();
    if (const int error = limit(RLIMIT_DATA, dataWithin(memoryBytes, status.str()))) return refused(error);
  }
  if (const int error = dropPrivileges()) return refused(error);
  if (const int error = keepSystemCalls(kind == Seal::drivers ? Duty::draw : Duty::work)) return refused(error);
  return Done{};
}

} // namespace gnomon
