#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon {

/// A bundle as one run of bytes, the same for the same bundle: what its id is the hash of, and what the store keeps.
///
/// A model alone is its own bytes. A model with files is
///   "gnomon bundle 1\n"
///   per entry, the model first under an empty name, then the files in ascending order of their names' bytes:
///     name length (4 bytes) · content length (8 bytes) · name · content
/// with lengths little-endian. No glTF or GLB begins with that first line, so the two forms can't be confused.
void writeBundle(const SceneBundle& bundle, const std::function<void(std::span<const std::uint8_t>)>& sink);

/// The bundle that writeBundle wrote.
Result<SceneBundle> readBundle(Bytes bytes, const Limits& limits = kLimits);

/// SHA-256 of those bytes: 64 lower-case hexadecimal digits.
std::string bundleId(const SceneBundle& bundle);

/// The number of those bytes.
std::uint64_t bundleBytes(const SceneBundle& bundle);

/// True for 64 lower-case hexadecimal digits.
bool isSceneId(std::string_view text);

/// Whether a file of a bundle may have this name: relative, no empty, "." or ".." segment, no backslash, no scheme, no
/// control characters, 1..255 bytes. Nothing of it ever reaches the file system; it is refused because it lies.
bool isBundleFileName(std::string_view name);

} // namespace gnomon
