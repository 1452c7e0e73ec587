#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/scene.h"

/// What a file hangs on its nodes: cameras, lights (KHR_lights_punctual), and copies of meshes
/// (EXT_mesh_gpu_instancing).
namespace gnomon {

struct AccessorView;
struct LoadContext;

/// A camera as it hangs on a node: not placed.
struct FileCamera {
  SceneCamera camera;
  std::size_t source = 0; ///< index into the file's cameras
};

/// Checks what the schema can't: the lens that the type asks for, and far beyond near. Those that are faulty are
/// marked, with a repair.
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

/// Checks what the schema can't: that a spot light has a cone, which is not wider inside than outside. Those that are
/// faulty are marked, with a repair.
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

  /// Where the copy stands, relative to the node. Nothing where its rotation has no direction or a number is not
  /// finite.
  std::optional<glm::dmat4> nodeFromCopy(std::size_t copy) const;
};

/// The instancing of a node that has it; nothing, and perhaps a problem, otherwise. The
/// accessors must outlive the result.
std::optional<Instancing> instancingOf(const LoadContext& load, std::size_t node);

} // namespace gnomon
