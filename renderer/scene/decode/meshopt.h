#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"

/// EXT_meshopt_compression and KHR_meshopt_compression.
namespace gnomon {

class DecodeBudget;

/// Buffers whose own bytes are never read: marked by the extension, or without bytes and with compressed views only.
/// `hasBinary`: buffer 0 may be the GLB's BIN chunk.
std::vector<bool> meshoptFallbacks(const gltf::Model& model, bool hasBinary);

/// Whether the members of the extension at `pointer` fit each other and the buffer view; a problem if not. REQUIRES:
/// the view has it.
bool isSoundMeshopt(const gltf::BufferView& view, const std::string& pointer, Findings& findings);

/// The elements of a view that passed isSoundMeshopt(), decoded and filtered within the budget; empty, with a problem,
/// on failure.
Bytes decodeMeshopt(const gltf::Meshopt& view, const std::string& pointer, std::span<const std::uint8_t> compressed,
                    DecodeBudget& budget, Findings& findings);

} // namespace gnomon
