#pragma once

#include <optional>
#include <string>
#include <variant>

#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// How a request names the environment in `debug.light`.
inline constexpr const char* kEnvironmentName = "environment";

/// Stands for it where the index of a light is asked for.
inline constexpr int kEnvironmentLight = -2;

/// The index of the light that debug views are about; nothing where none is named, or the environment.
inline std::optional<int> debugLightIndex(const Debug& debug) {
  if (!debug.light) return std::nullopt;
  const int* index = std::get_if<int>(&*debug.light);
  return index != nullptr ? std::optional(*index) : std::nullopt;
}

/// Whether they are about the environment. REQUIRES: `debug` has passed protocol/validate.
inline bool showsEnvironment(const Debug& debug) {
  return debug.light && std::holds_alternative<std::string>(*debug.light);
}

} // namespace gnomon
