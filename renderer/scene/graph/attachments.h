#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

/// Cameras, lights (KHR_lights_punctual) and copies of meshes (EXT_mesh_gpu_instancing) on the nodes of a file.
namespace gnomon {

struct AccessorView;
struct LoadContext;

/// A camera as it hangs on a node: not placed.
struct FileCamera {
  SceneCamera camera;
  std::size_t source = 0; ///< index into the file's cameras
};

/// Checks that the lens of the type exists and that far is beyond near; marks faulty cameras, with a repair.
void checkCameras(std::vector<gltf::Camera>& cameras, Findings& findings);

/// `camera` with the lens of one of the file's cameras, which has passed checkCameras().
SceneCamera withLens(const gltf::Camera& source, SceneCamera camera);

/// The camera that hangs on a node, if there is one that is sound.
std::optional<FileCamera> cameraAt(const gltf::Model& model, std::size_t node, Findings& findings);

/// Those that hang on a node and are faulty.
std::vector<LeftOutCamera> leftOutCameras(const gltf::Model& model);

/// Nothing where the matrix leaves it no direction.
std::optional<SceneCamera> placedAt(const glm::dmat4& worldFromUnscaled, SceneCamera camera);

/// A light as it hangs on a node: not placed.
struct FileLight {
  SceneLight light;
  std::size_t source = 0; ///< index into the file's lights
};

/// Checks that a spot light has a cone, no wider inside than outside; marks faulty lights, with a repair.
void checkLights(std::vector<gltf::PunctualLight>& lights, Findings& findings);

/// One of the file's lights, without a place. It has passed checkLights().
Light lightFrom(const gltf::PunctualLight& source);

/// The light that hangs on a node, if there is one that is sound.
std::optional<FileLight> lightAt(const gltf::Model& model, std::size_t node, Findings& findings);

/// Nothing where it needs a direction and the matrix leaves it none.
std::optional<SceneLight> placedAt(const glm::dmat4& worldFromUnscaled, SceneLight light);

/// The copies that EXT_mesh_gpu_instancing makes of a node's mesh.
struct Instancing {
  std::uint64_t count = 0;
  const AccessorView* translations = nullptr; ///< nullptr = none
  const AccessorView* rotations = nullptr;
  const AccessorView* scales = nullptr;

  /// Relative to the node; nothing where a number is not finite or the rotation has no direction.
  std::optional<glm::dmat4> nodeFromCopy(std::size_t copy) const;
};

/// The instancing of a node; nothing, and perhaps a repair, otherwise. The accessors outlive the result.
std::optional<Instancing> instancingOf(const LoadContext& load, std::size_t node);

} // namespace gnomon
