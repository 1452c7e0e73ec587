#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/spec/limits.h"
#include "renderer/scene/container/resources.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"

namespace gnomon {

/// A glTF whose schema, indices and byte ranges hold. The bundle that it was read from must outlive it.
struct GltfDocument {
  gltf::Model model;
  std::vector<ResourceBytes> buffers;
  std::vector<ResourceBytes> images;                      ///< encoded
  std::vector<std::span<const std::uint8_t>> bufferViews; ///< bytes of each, inside its buffer or decoded
  std::vector<Bytes> decodedViews;                        ///< what bufferViews points into where the file compresses it
  std::uint64_t decodedBytes = 0;                         ///< of them together
};

/// Reads the model and every file that it names; `findings` gets the warnings.
Result<GltfDocument> readGltf(const SceneBundle& bundle, const Limits& limits, Findings& findings);

struct AccessorView;

/// What every step of loading after readGltf() works with.
struct LoadContext {
  const GltfDocument& document;
  const std::vector<AccessorView>& accessors; ///< one an accessor of the document, checked
  const Limits& limits;
  Findings& findings;
};

} // namespace gnomon
