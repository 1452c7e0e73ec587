#pragma once

#include <compare>
#include <cstddef>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "renderer/scene/document/gltf_model.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/geometry/accessor_view.h"
#include "renderer/scene/graph/attachments.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/scene.h"

namespace gnomon {

struct LoadContext;

/// The numbers of a property in what it belongs to; empty where the object that it stands in is missing.
template <class Holder>
using NumbersIn = std::span<double> (*)(Holder&);

/// What KHR_animation_pointer moves of a material, camera or light, found in a file.
struct PropertyTarget {
  std::string pointer; ///< into the file's JSON (RFC 6901)
  std::variant<NumbersIn<gltf::Material>, NumbersIn<gltf::TextureTransform>, NumbersIn<gltf::Camera>,
               NumbersIn<gltf::PunctualLight>>
      numbers{};
  std::size_t index = 0;                                 ///< of the material, camera or light
  std::size_t texture = 0;                               ///< of a texture's transform: which of the material's textures
  std::size_t components = 1;                            ///< 1 to 4
  double min = -std::numeric_limits<double>::infinity(); ///< what glTF allows of each number
  double max = std::numeric_limits<double>::infinity();
  bool minExcluded = false;
};

/// The parts of a file that properties lie in.
struct Properties {
  std::vector<gltf::Material> materials;
  std::vector<gltf::Camera> cameras;
  std::vector<gltf::PunctualLight> lights;
};

/// The property that a pointer names; nothing where the file lacks the object, but for pbrMetallicRoughness, or where
/// it names no number that is read.
std::optional<PropertyTarget> propertyAt(const gltf::Model& model, const std::string& pointer);

/// The numbers of a target that was found in these.
std::span<double> numbersOf(Properties& properties, const PropertyTarget& target);

/// A token of a JSON pointer as an index below `size`; it has no sign and no leading zero (RFC 6901).
std::optional<std::size_t> indexIn(std::string_view token, std::size_t size);

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

/// A primitive on its node, also where the rest pose hides it and an animation might show it.
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

/// All that a pose of a file is made from.
struct Motion {
  std::vector<Animation> animations;
  std::vector<int> parents; ///< of the nodes; -1 for a root
  std::vector<int> order;   ///< the nodes, parents before children
  std::vector<LocalTransform> locals;
  std::vector<bool> visible;            ///< what KHR_node_visibility says of each node itself
  std::optional<Properties> properties; ///< of the file; nothing = no animation moves any
  std::vector<MovingView> views;        ///< one a scene
};

/// Of what kind a sampler's values are, and so of what type their accessor may be (glTF 2.0, 3.11).
enum class ValueKind {
  vector,   ///< floats
  rotation, ///< quaternions; floats, or what normalized integers come to
  numbers,  ///< floats, or what normalized integers come to
  boolean   ///< unsigned bytes, in steps
};

/// What a sampler's values are: it may serve several.
struct SamplerUse {
  ValueKind kind = ValueKind::vector;
  std::size_t components = 3; ///< of an element of the accessor
  std::size_t elements = 1;   ///< a keyframe

  auto operator<=>(const SamplerUse&) const = default;
};

/// Reads a sampler, at most `mostNumbers` of them; without times, and with a problem, where it breaks a rule.
Sampler buildSampler(const gltf::AnimationSampler& source, const std::string& pointer,
                     const std::vector<AccessorView>& accessors, const SamplerUse& use, std::size_t mostNumbers,
                     Findings& findings);

/// The numbers of a keyframe, `components` of them: of a cubic spline the middle row of three.
const float* valueOf(const Sampler& sampler, std::size_t keyframe);

/// The value at a time, `components` numbers; beyond the keyframes that of the nearest (glTF 2.0, 3.11 and appendix C).
/// Rotations have length 1.
void sample(const Sampler& sampler, double timeSeconds, std::span<double> value);

/// Nodes whose weights an animation changes.
std::set<std::size_t> nodesWithMovingWeights(const gltf::Model& model);

/// The animations of the file, in its order. Channels that move what is not animated here are left out with a warning.
std::vector<Animation> readAnimations(const LoadContext& load);

} // namespace gnomon
