#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon {

/// How much is stored.
struct StoreSize {
  std::size_t scenes = 0;
  std::uint64_t bytes = 0; ///< of their bundles; in memory with their summaries
};

/// How a store that is elsewhere does; of any other, the defaults.
struct StoreState {
  bool isReachable = true;
  std::size_t connections = 0;
  std::uint64_t calls = 0;    ///< since the start
  std::uint64_t failures = 0; ///< of those: without an answer
  StoreSize inMemory{};       ///< scenes that need no call
  std::uint64_t hits = 0;     ///< bundles that were asked for, since the start: in memory
  std::uint64_t misses = 0;   ///< and read from the store
};

} // namespace gnomon
