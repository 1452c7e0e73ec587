#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/findings.h"

namespace gnomon {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

/// What EXT_meshopt_compression, or KHR_meshopt_compression, says of a buffer view.
struct MeshoptView {
  std::string pointer; ///< of the extension's object
  std::size_t buffer = 0;
  std::uint64_t byteOffset = 0;
  std::uint64_t byteLength = 0; ///< of the compressed bytes
  std::uint64_t byteStride = 0; ///< of an element; 1..256
  std::uint64_t count = 0;      ///< of elements; < 2^53
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;

  std::uint64_t decodedBytes() const { return byteStride * count; }
};

// The documents given here have passed checkSchema().

/// True for each buffer that only stands in for compressed bytes, so that its own are never read: marked by the
/// extension, or without bytes and with compressed views only. `hasBinary`: buffer 0 may be the GLB's BIN chunk.
std::vector<bool> meshoptFallbacks(const nlohmann::json& document, bool hasBinary);

bool hasMeshopt(const nlohmann::json& bufferView);

/// The extension of a buffer view that has it; nothing, and a problem, where its members contradict each other or the
/// buffer view. `pointer` is the buffer view's.
std::optional<MeshoptView> readMeshopt(const nlohmann::json& bufferView, const std::string& pointer,
                                       Findings& findings);

} // namespace gnomon
