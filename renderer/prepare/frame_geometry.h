#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// An instance as it is seen from the eye.
struct PlacedInstance {
  glm::dmat4 relativeFromLocal{1};
  glm::dmat3 normalFromLocal{1}; ///< turns normals, whatever the scale; its longest column has length 1
  int node = -1;                 ///< of the file
  std::uint8_t group = 0;        ///< receiver group
};

/// Where a scene's instances and clusters are, seen from one eye: every position is relative to it.
/// A slot is one cluster of one instance; the slots of instance i are firstSlot[i] .. firstSlot[i + 1] - 1.
struct FrameGeometry {
  std::vector<PlacedInstance> instances;
  std::vector<std::uint32_t> firstSlot; ///< one more than there are instances
  std::vector<Aabb> slotBounds;

  std::size_t slotCount() const { return slotBounds.size(); }
};

/// `groups`: the receiver group of each instance (node_switches.h); none = 0 for all.
FrameGeometry frameGeometry(const Scene& scene, const SceneView& view, const glm::dvec3& eye,
                            std::span<const std::uint8_t> groups = {});

/// Clears the slots (a byte each) of the nodes that don't pass. `nodes`: one a node of the file; empty = every node has
/// the defaults.
void keepNodes(std::span<const NodeSwitches> nodes, const SceneView& view, const FrameGeometry& geometry,
               const std::function<bool(const NodeSwitches&)>& pass, std::vector<std::uint8_t>& slots);

} // namespace gnomon
