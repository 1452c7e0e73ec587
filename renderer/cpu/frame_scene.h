#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/device/shader_data.h"
#include "renderer/prepare/frame_geometry.h"

namespace gnomon::cpu {

/// A slot of the frame's geometry, a cluster of an instance: where its triangles stand.
struct Slot {
  std::uint32_t instance = 0;
  std::uint32_t firstIndex = 0; ///< into Scene::indices, of its first triangle's first corner
  std::uint32_t triangles = 0;  ///< at most kClusterTriangles
  std::uint32_t baseVertex = 0;
  int material = 0; ///< index into Scene::materials
};

/// What is asked of the curved surfaces that shading shows (renderer/shaders/shared/smooth_surface.h), by the lights
/// that look up maps.
struct SmoothAsked {
  bool asked = false;
  /// Where those lights are that are far away: toward them, and the cosine of a plane up to which it leaves some of the
  /// light behind it. Empty = they are, or may be, anywhere.
  std::vector<glm::vec4> suns;
};

/// What a frame's kernels read: the scene, and how it is placed as seen from the eye. All positions are floats relative
/// to the eye. A triangle's number is slot * kClusterTriangles + its place in the slot; kNoNumber is none.
struct FrameScene {
  const Scene& scene;
  const SceneView& view;
  const FrameGeometry& geometry;
  std::vector<Slot> slots;
  std::vector<shared::InstanceData> instances;
  std::vector<shared::MaterialData> materials;
  shared::FrameData frame;
  int width = 0; ///< of the picture, pixels
  int height = 0;
  SmoothAsked smooth;
  const glm::vec4* environment = nullptr; ///< its atlas, as shared::EnvironmentTexels; null = the studio
};

FrameScene frameScene(const Scene& scene, const SceneView& view, const FrameGeometry& geometry,
                      const ResolvedFrame& frame);

} // namespace gnomon::cpu
