#pragma once

#include "protocol/base/scene_bundle.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The scene summary, without id and warnings.
SceneSummary summarize(const gltf::Model& model, const SceneBundle& bundle, const Scene& scene);

} // namespace gnomon
