#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/animation/property_target.h"
#include "renderer/scene/graph/attachments.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A value over time. At least one keyframe; at least two where it is a cubic spline.
struct Sampler {
  Interpolation interpolation = Interpolation::linear;
  std::size_t components = 1;
  bool isRotation = false;   ///< the values are quaternions x y z w, of length 1
  std::vector<float> times;  ///< seconds, >= 0, strictly increasing
  std::vector<float> values; ///< `components` a keyframe; of a cubic spline in-tangent, value and out-tangent
};

enum class ChannelPath { translation, rotation, scale, weights, visibility };

/// What a sampler moves of a node.
struct Channel {
  ChannelPath path = ChannelPath::translation;
  int node = 0;
  std::size_t sampler = 0; ///< index into Animation::samplers
};

/// What a sampler moves of a material, light or camera.
struct PropertyChannel {
  PropertyTarget target;
  std::size_t sampler = 0; ///< index into Animation::samplers
};

struct Animation {
  std::string name;
  std::vector<Sampler> samplers;
  std::vector<Channel> channels;           ///< no two move the same
  std::vector<PropertyChannel> properties; ///< no two move the same
  double durationSeconds = 0;              ///< time of the last keyframe
};

/// A primitive where the nodes of a scene put it, whether or not the rest pose shows it. What is hidden is there only
/// in a file whose animations might show it.
struct Placement {
  int node = 0;
  int primitive = 0;          ///< index into Scene::primitives
  int skin = -1;              ///< that it follows instead of its node
  int copy = 0;               ///< which of those that EXT_mesh_gpu_instancing makes of the node's mesh
  glm::dmat4 nodeFromCopy{1}; ///< of that
};

/// What one of the file's scenes holds, to be placed by a pose.
struct MovingView {
  std::vector<Placement> placements;
  std::vector<FileCamera> cameras;
  std::vector<FileLight> lights;
};

/// What it takes to pose a file anew.
struct Motion {
  std::vector<Animation> animations;
  std::vector<int> parents; ///< of the nodes; -1 for a root
  std::vector<int> order;   ///< the nodes, parents before children
  std::vector<LocalTransform> locals;
  std::vector<bool> visible;            ///< what KHR_node_visibility says of each node itself
  std::optional<Properties> properties; ///< of the file; nothing = no animation moves any
  std::vector<MovingView> views;        ///< one a scene
};

} // namespace gnomon
