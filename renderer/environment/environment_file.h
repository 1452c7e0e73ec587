#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <variant>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "protocol/spec/environment_options.h"
#include "renderer/environment/cube_light.h"
#include "renderer/environment/environment_map.h"

namespace gnomon {

/// What a frame must know of an environment before it is drawn.
struct EnvironmentFacts {
  int width = 0; ///< texels
  int height = 0;
  double meanRadiance = 0;         ///< luminance, over all directions, sun included
  std::optional<FoundSun> sun{};   ///< nothing = none, or it stays in the picture
  double irradianceDifference = 0; ///< greatestDifference of what a light states and its picture; a file states nothing
};

/// A file that was read, its sun taken out of the map if the facts say so.
struct SplitEnvironment {
  EnvironmentMap map;
  EnvironmentFacts facts;
};

/// A file of an upload, or an image-based light of a glTF, that frames may have as their environment. Hostile until it
/// is read; then it is known what is in it, or what is wrong with it. Any thread.
class EnvironmentFile {
 public:
  explicit EnvironmentFile(Bytes bytes) : content_(std::move(bytes)) {}
  explicit EnvironmentFile(CubeLight light) : content_(std::move(light)) {}

  std::uint64_t size() const; ///< bytes of its file, or of a light's faces

  /// The most that its file and its map take, by its header.
  std::uint64_t memory() const;

  /// As readEnvironment, or readCube.
  Result<SplitEnvironment> read(SunExtraction extraction) const;

  /// What an earlier read found; nothing = it was not read yet.
  std::optional<Result<EnvironmentFacts>> facts(SunExtraction extraction) const;

 private:
  /// Whether the sun stays in the picture.
  static std::size_t slotOf(SunExtraction extraction) { return extraction == SunExtraction::none ? 1 : 0; }

  std::variant<Bytes, CubeLight> content_;
  mutable std::mutex mutex_;
  mutable std::array<std::optional<Result<EnvironmentFacts>>, 2> facts_;
};

} // namespace gnomon
