#pragma once

#include "protocol/base/scene_bundle.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Everything that an upload is told about its scene, but for the id and the warnings.
SceneSummary summarize(const gltf::Model& model, const SceneBundle& bundle, const Scene& scene);

} // namespace gnomon
