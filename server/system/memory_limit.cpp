#include "server/system/memory_limit.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <unistd.h>

#include "renderer/core/control_groups.h"

namespace gnomon {
namespace {

std::optional<std::uint64_t> numberIn(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? std::optional(number) : std::nullopt; // "max" is no number
}

} // namespace

std::optional<std::uint64_t> memoryGranted(const std::vector<std::filesystem::path>& groups) {
  std::optional<std::uint64_t> least;
  for (const std::filesystem::path& group : groups) {
    for (const char* name : {"memory.max", "memory.limit_in_bytes"}) {
      if (const auto granted = numberIn(group / name)) least = std::min(*granted, least.value_or(*granted));
    }
  }
  return least;
}

std::uint64_t memoryLimit() {
  const auto machine =
      static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return std::min(machine, memoryGranted(controlGroups("memory")).value_or(machine));
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
