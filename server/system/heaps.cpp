#include "server/system/heaps.h"

#include <cstdlib>
#include <malloc.h>

namespace gnomon {

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
