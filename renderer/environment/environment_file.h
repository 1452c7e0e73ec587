#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "protocol/spec/environment_options.h"
#include "renderer/environment/environment_map.h"

namespace gnomon {

/// What a frame must know of an environment before it is drawn.
struct EnvironmentFacts {
  int width = 0; ///< texels
  int height = 0;
  double meanRadiance = 0;       ///< luminance, over all directions, sun included
  std::optional<FoundSun> sun{}; ///< nothing = none, or it stays in the picture
};

/// A file that was read, its sun taken out of the map if the facts say so.
struct SplitEnvironment {
  EnvironmentMap map;
  EnvironmentFacts facts;
};

/// A file of an upload that frames may name as their environment. Hostile until it is read; then it is known what is
/// in it, or what is wrong with it. Any thread.
class EnvironmentFile {
 public:
  explicit EnvironmentFile(Bytes bytes) : bytes_(std::move(bytes)) {}

  std::size_t size() const { return bytes_.size(); }

  /// The most that its file and its map take, by its header.
  std::uint64_t memory() const;

  /// As readEnvironment.
  Result<SplitEnvironment> read(SunExtraction extraction) const;

  /// What an earlier read found; nothing = it was not read yet.
  std::optional<Result<EnvironmentFacts>> facts(SunExtraction extraction) const;

 private:
  /// Whether the sun stays in the picture.
  static std::size_t slotOf(SunExtraction extraction) { return extraction == SunExtraction::none ? 1 : 0; }

  Bytes bytes_;
  mutable std::mutex mutex_;
  mutable std::array<std::optional<Result<EnvironmentFacts>>, 2> facts_;
};

} // namespace gnomon
