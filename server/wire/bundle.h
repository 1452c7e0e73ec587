#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"

namespace gnomon {

/// A bundle as one run of bytes, the same for equal bundles: the store keeps these bytes, and the id is their hash.
///
/// A model alone is its own bytes. A model with files is
///   "gnomon bundle 1\n"
///   per entry, the model first under an empty name, then the files in ascending order of their names' bytes:
///     name length (4 bytes) · content length (8 bytes) · name · content
/// with lengths little-endian. No glTF or GLB begins with that first line, so the two forms can't be confused.
void writeBundle(const SceneBundle& bundle, const std::function<void(std::span<const std::uint8_t>)>& sink);

/// The bundle that writeBundle wrote.
Result<SceneBundle> readBundle(Bytes bytes, const Limits& limits = kLimits);

/// Whether a file of a bundle may have this name: relative, no empty, "." or ".." segment, no backslash, no scheme, no
/// control characters, 1..255 bytes. No part of it ever reaches the file system; other names are refused as misleading.
bool isBundleFileName(std::string_view name);

} // namespace gnomon
