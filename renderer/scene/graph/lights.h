#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

/// KHR_lights_punctual.
namespace gnomon {

/// A light as it hangs on a node: not placed.
struct FileLight {
  SceneLight light;
  std::size_t source = 0; ///< index into the file's lights
};

/// Checks what the schema can't: that a spot light has a cone, wider outside than inside.
void checkLights(const std::vector<gltf::PunctualLight>& lights, Findings& findings);

/// One of the file's lights, without a place. It has passed checkLights().
Light lightFrom(const gltf::PunctualLight& source);

/// The light that hangs on a node, if there is one.
std::optional<FileLight> lightAt(const gltf::Model& model, std::size_t node, Findings& findings);

/// Nothing where it needs a direction and the matrix leaves it none.
std::optional<SceneLight> placedAt(const glm::dmat4& worldFromUnscaled, SceneLight light);

} // namespace gnomon
