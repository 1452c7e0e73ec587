#pragma once

#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

/// KHR_materials_variants: other materials for the primitives of a file.
namespace gnomon {

/// Refuses a file whose variants and primitives give more choices than maxInstances.
void checkVariantCount(const gltf::Model& model, const Limits& limits, Findings& findings);

/// The materials of a primitive, as in Primitive::variantMaterials.
std::vector<int> variantMaterials(const gltf::Model& model, const gltf::Primitive& primitive);

/// The views again for each of scene.variants, with its materials.
std::vector<SceneView> variantViews(const Scene& scene, const std::vector<SceneView>& views);

/// Adds the scenes of the file again for each of scene.variants, with its materials. Refuses what would take the placed
/// primitives past maxInstances.
void addVariantScenes(const Limits& limits, Scene& scene, Findings& findings);

} // namespace gnomon
