#pragma once

#include <optional>
#include <string>
#include <variant>

#include "protocol/spec/limits.h"

namespace gnomon {

/// Layers are bits: 1 is the first, 2 the second, 4 the third. This is all of them.
inline constexpr int kAllLayers = (1 << kLimits.maxLayers) - 1;

/// Switches of a node of the scene and of all below it, as far as no entry for a node further down says otherwise.
struct NodeOptions {
  std::optional<std::variant<int, std::string>> node{}; ///< index into the file's nodes, or the name of some; needed
  std::optional<bool> visible{};                        ///< false = the camera doesn't see it
  std::optional<bool> castShadow{};                     ///< absent = as visible: what isn't seen throws no shadow
  std::optional<bool> receiveShadow{};                  ///< false = it is lit as if nothing threw a shadow on it
  std::optional<int> layers{};                          ///< one bit a layer, at least one; absent = the first, 1

  bool operator==(const NodeOptions&) const = default;
};

} // namespace gnomon
