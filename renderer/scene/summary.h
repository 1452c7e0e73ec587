#pragma once

#include <cstdint>

#include "protocol/base/scene_bundle.h"
#include "protocol/report/replies.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The scene summary, without id and warnings.
SceneSummary summarize(const gltf::Model& model, const SceneBundle& bundle, const Scene& scene);

/// What a scene takes in memory, with the poses that are kept of it. Images count as if all were decoded.
MemorySummary memoryOf(const Scene& scene);

/// All of it.
std::uint64_t bytesIn(const MemorySummary& memory);

} // namespace gnomon
