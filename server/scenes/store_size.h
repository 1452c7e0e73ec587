#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon {

/// How much is stored.
struct StoreSize {
  std::size_t scenes = 0;
  std::uint64_t bytes = 0; ///< of their bundles; in memory with their summaries
};

} // namespace gnomon
