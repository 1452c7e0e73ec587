#include "server/system/memory_limit.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <sstream>
#include <unistd.h>

namespace gnomon {
namespace {

std::optional<std::uint64_t> numberIn(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? std::optional(number) : std::nullopt; // "max" is no number
}

/// The least number in files of this name, from a group up to the root.
std::optional<std::uint64_t> leastUpwards(const std::filesystem::path& root, std::filesystem::path group,
                                          const char* name) {
  std::optional<std::uint64_t> least;
  while (true) {
    const auto granted = numberIn(root / group.relative_path() / name);
    if (granted) least = std::min(*granted, least.value_or(*granted));
    if (!group.has_relative_path()) return least;
    group = group.parent_path();
  }
}

} // namespace

std::optional<std::uint64_t> memoryGranted(const std::filesystem::path& root, const std::string& ownGroups) {
  std::optional<std::uint64_t> least;
  std::istringstream lines(ownGroups);
  for (std::string line; std::getline(lines, line);) { // "0::/path", or "9:memory:/path" of version 1
    const std::size_t controllers = line.find(':');
    const std::size_t path = line.find(':', controllers + 1);
    if (path == std::string::npos) continue;
    const bool isFirst = line.substr(controllers + 1, path - controllers - 1) == "memory";
    if (!isFirst && path != controllers + 1) continue;
    const auto granted = isFirst ? leastUpwards(root / "memory", line.substr(path + 1), "memory.limit_in_bytes")
                                 : leastUpwards(root, line.substr(path + 1), "memory.max");
    if (granted) least = std::min(*granted, least.value_or(*granted));
  }
  return least;
}

std::uint64_t memoryLimit() {
  const auto machine =
      static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  std::ostringstream ownGroups;
  ownGroups << std::ifstream("/proc/self/cgroup").rdbuf();
  return std::min(machine, memoryGranted("/sys/fs/cgroup", ownGroups.str()).value_or(machine));
}

std::uint64_t dataWithin(std::uint64_t memoryBytes, const std::string& status) {
  const auto bytesOf = [&](const std::string& name) -> std::uint64_t {
    const std::size_t found = status.find("\n" + name + ":");
    if (found == std::string::npos) return 0;
    return std::strtoull(status.c_str() + found + name.size() + 2, nullptr, 10) * 1024;
  };
  const std::uint64_t data = bytesOf("VmData");
  const std::uint64_t untouched = data - std::min(data, bytesOf("RssAnon"));
  const std::uint64_t apart = bytesOf("RssFile") + bytesOf("RssShmem") + memoryBytes / 16;
  return memoryBytes - std::min(apart, memoryBytes) + untouched;
}

void boundHeaps(int heaps) {
  const auto unlessSet = [](const char* variable, int parameter, int value) {
    if (std::getenv(variable) == nullptr) mallopt(parameter, value);
  };
  unlessSet("MALLOC_ARENA_MAX", M_ARENA_MAX, heaps);
  unlessSet("MALLOC_MMAP_THRESHOLD_", M_MMAP_THRESHOLD, 4 << 20); // bytes
  unlessSet("MALLOC_TRIM_THRESHOLD_", M_TRIM_THRESHOLD, 16 << 20);
}

std::string hugePagesVariable(std::string_view own) {
  constexpr std::string_view kTunable = "glibc.malloc.hugetlb";
  std::string variable = "GLIBC_TUNABLES=" + std::string(own);
  if (own.find(kTunable) != std::string_view::npos) return variable;
  return variable + (own.empty() ? "" : ":") + std::string(kTunable) + "=1";
}

} // namespace gnomon
