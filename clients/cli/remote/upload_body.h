#pragma once

#include <string>

#include "renderer/scene/scene_bundle.h"

namespace gnomon::cli {

/// What POST /v1/scenes takes.
struct UploadBody {
  std::string contentType;
  std::string bytes;
};

/// A model alone is its own bytes; with files it is multipart/form-data: `scene`, then a `file` for each.
UploadBody uploadBody(const SceneBundle& bundle);

/// The id that the server gives to a model without files: the SHA-256 of its bytes in hexadecimal.
std::string modelId(const Bytes& model);

} // namespace gnomon::cli
