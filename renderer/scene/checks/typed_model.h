#pragma once

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "protocol/base/result.h"

namespace gnomon {

/// The typed model of a document that has passed checkSchema(). tinygltf is given what the scene graph, the
/// meshes and the textures are made of, and nothing with bytes or extras: it has no file to open, nothing to decode and
/// no depth to recurse into. Primitives that Draco compresses have no indices in it.
Result<tinygltf::Model> typedModel(const nlohmann::json& document);

} // namespace gnomon
