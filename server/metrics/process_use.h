#pragma once

#include <cstdint>

namespace gnomon::metrics {

/// What this process takes, by proc(5); 0 where that is unknown.
struct ProcessUse {
  std::uint64_t residentBytes = 0;
  std::uint64_t virtualBytes = 0;
  std::uint64_t openFiles = 0; ///< descriptors
  std::uint64_t mostFiles = 0; ///< descriptors that it may have
  std::uint64_t threads = 0;
  double processorSeconds = 0; ///< user and system, of all its threads
  double startSeconds = 0;     ///< since 1970
};

ProcessUse processUse();

} // namespace gnomon::metrics
