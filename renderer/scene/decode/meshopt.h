#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/scene/decode/decode_budget.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"

/// EXT_meshopt_compression and KHR_meshopt_compression.
namespace gnomon {

/// True for each buffer that only stands in for compressed bytes, so that its own are never read: marked by the
/// extension, or without bytes and with compressed views only. `hasBinary`: buffer 0 may be the GLB's BIN chunk.
std::vector<bool> meshoptFallbacks(const gltf::Model& model, bool hasBinary);

/// Whether the members of a buffer view's extension fit each other and the buffer view; a problem if not. `pointer` is
/// the extension's. REQUIRES: the buffer view has the extension.
bool isSoundMeshopt(const gltf::BufferView& view, const std::string& pointer, Findings& findings);

/// The elements of a buffer view that has passed isSoundMeshopt(), decoded and filtered. Nothing is allocated before
/// the claims fit the compressed bytes and the budget. Empty, with a problem, where they do not or the bytes can't be
/// decoded.
Bytes decodeMeshopt(const gltf::Meshopt& view, const std::string& pointer, std::span<const std::uint8_t> compressed,
                    DecodeBudget& budget, Findings& findings);

} // namespace gnomon
