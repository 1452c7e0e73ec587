#pragma once

#include <nlohmann/json_fwd.hpp>

#include "renderer/scene/document/gltf_model.h"

namespace gnomon {

/// The typed values of a document that has passed checkSchema(). Takes the URIs, which may hold whole files, out of the
/// document instead of copying them.
gltf::Model readModel(nlohmann::json document);

} // namespace gnomon
