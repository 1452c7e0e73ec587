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
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"

namespace gnomon {

/// Bytes that a file's compressed data may come to, counted before any of them is allocated.
class DecodeBudget {
 public:
  explicit DecodeBudget(std::uint64_t limit, std::uint64_t used = 0) : limit_(limit), used_(used) {}

  /// False, and a problem at `pointer`, where `bytes` more would pass the limit.
  bool take(std::uint64_t bytes, const std::string& pointer, Findings& findings) {
    if (bytes > left()) {
      findings.tooLarge(pointer, "The compressed data decodes to too many bytes.", std::to_string(limit_) + " bytes",
                        std::to_string(bytes) + " bytes after " + std::to_string(used_));
      return false;
    }
    used_ += bytes;
    return true;
  }

  std::uint64_t used() const { return used_; }
  std::uint64_t left() const { return limit_ - used_; }

 private:
  std::uint64_t limit_ = 0;
  std::uint64_t used_ = 0; ///< <= limit_
};

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

/// The bytes of a data: URI or of a file of the bundle, by the name that fileUri() gives it. `pointer`: the URI's
/// place, for the problem.
Result<ResourceBytes> resolveUri(std::string_view uri, const SceneBundle& bundle, const std::string& pointer);

// What could not be read is empty, with a problem in the findings.

/// The bytes of each buffer but fallbacks (meshoptFallbacks). `binary`: the GLB's BIN chunk.
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
