#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon {

/// What became of a frame that this server took from the queue of jobs.
enum class FrameEnd {
  drawn,
  failed,    ///< and its job with it
  givenBack, ///< to be drawn later, or by another server
  unwanted,  ///< its job was removed or had failed, or another server was faster
};
inline constexpr std::array<std::string_view, 4> kFrameEndNames{"drawn", "failed", "givenBack", "unwanted"};

/// By FrameEnd. Any thread.
struct FrameEnds {
  std::array<std::atomic<std::uint64_t>, kFrameEndNames.size()> ends{};

  void add(FrameEnd end) { ++ends[static_cast<std::size_t>(end)]; }
};

} // namespace gnomon
