#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/container/resource_bytes.h"
#include "renderer/scene/decode/decode_budget.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"

namespace gnomon {

// What could not be read is empty, with a problem in the findings.

/// The bytes of each buffer, exactly byteLength of them. `binary` is the GLB's BIN chunk.
/// Those of fallbacks (meshoptFallbacks) are not read.
std::vector<ResourceBytes> readBuffers(const gltf::Model& model, const std::vector<bool>& fallbacks,
                                       std::optional<std::span<const std::uint8_t>> binary, const SceneBundle& bundle,
                                       Findings& findings);

/// The bytes of each buffer view, inside its buffer or decoded.
struct BufferViews {
  std::vector<std::span<const std::uint8_t>> bytes;
  std::vector<Bytes> decoded; ///< what `bytes` points into where the file compresses it
};
BufferViews readBufferViews(const gltf::Model& model, const std::vector<ResourceBytes>& buffers,
                            const std::vector<bool>& fallbacks, DecodeBudget& budget, Findings& findings);

/// The encoded bytes of each image.
std::vector<ResourceBytes> readImages(const gltf::Model& model,
                                      const std::vector<std::span<const std::uint8_t>>& bufferViews,
                                      const SceneBundle& bundle, Findings& findings);

} // namespace gnomon
