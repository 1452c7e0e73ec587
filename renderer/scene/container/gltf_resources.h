#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/container/resource_bytes.h"
#include "renderer/scene/findings.h"

namespace gnomon {

// The documents given here have passed checkSchema(). What could not be read is empty and told in the findings.

/// The bytes of each buffer, exactly byteLength of them. `binary` is the GLB's BIN chunk.
std::vector<ResourceBytes> readBuffers(const nlohmann::json& document,
                                       std::optional<std::span<const std::uint8_t>> binary, const SceneBundle& bundle,
                                       Findings& findings);

/// The bytes of each buffer view, which lie inside its buffer.
std::vector<std::span<const std::uint8_t>> readBufferViews(const nlohmann::json& document,
                                                           const std::vector<ResourceBytes>& buffers,
                                                           Findings& findings);

/// The encoded bytes of each image.
std::vector<ResourceBytes> readImages(const nlohmann::json& document,
                                      const std::vector<std::span<const std::uint8_t>>& bufferViews,
                                      const SceneBundle& bundle, Findings& findings);

} // namespace gnomon
