#pragma once

#include <string>
#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/gltf_document.h"
#include "renderer/scene/scene.h"

/// KHR_materials_variants: other materials for the primitives of a file.
namespace gnomon {

/// Refuses a file whose variants and primitives give more choices than maxInstances.
void checkVariantCount(const GltfDocument& document, const Limits& limits, Findings& findings);

std::vector<std::string> variantNames(const GltfDocument& document);

/// The materials of a primitive, as in Primitive::variantMaterials.
std::vector<int> variantMaterials(const GltfDocument& document, std::size_t mesh, std::size_t primitive);

/// The views again for each of scene.variants, with its materials.
std::vector<SceneView> variantViews(const Scene& scene, const std::vector<SceneView>& views);

/// Adds the scenes of the file again for each of scene.variants, with its materials. Refuses what would take the placed
/// primitives past maxInstances.
void addVariantScenes(const Limits& limits, Scene& scene, Findings& findings);

} // namespace gnomon
