#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "renderer/scene/decode/decode_budget.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"

namespace gnomon {

/// Bytes that either lie in the bundle, which must outlive this, or were decoded from a data: URI.
class ResourceBytes {
 public:
  ResourceBytes() = default;
  explicit ResourceBytes(std::span<const std::uint8_t> borrowed) : bytes_(borrowed) {}
  explicit ResourceBytes(Bytes owned) : bytes_(std::move(owned)) {}

  std::span<const std::uint8_t> view() const;

 private:
  std::variant<std::span<const std::uint8_t>, Bytes> bytes_;
};

/// What a glTF's `uri` stands for: a data: URI or a file of the bundle, by the name that fileUri() gives it. Nothing
/// else is ever opened. `pointer` is the URI's place in the glTF, for the problem.
Result<ResourceBytes> resolveUri(std::string_view uri, const SceneBundle& bundle, const std::string& pointer);

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
