#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/report/replies.h"
#include "protocol/spec/scene_options.h"
#include "renderer/core/aabb.h"
#include "renderer/core/vectors.h"
#include "renderer/environment/environment_file.h"
#include "renderer/scene/scene_image.h"

namespace gnomon {

/// What shading needs of a vertex besides its position; uploaded as it stands.
struct VertexAttributes {
  glm::vec3 normal{0, 0, 1};
  glm::vec4 tangent{1, 0, 0, 1}; ///< w = sign of the bitangent
  glm::vec2 uv0{0};
  glm::vec2 uv1{0};
  glm::u16vec4 color{65535, 65535, 65535, 65535}; ///< linear RGBA, 0..65535
};

/// Triangles in a cluster. Every cluster of a primitive but its last has exactly this many.
inline constexpr std::uint32_t kClusterTriangles = 1024;

/// A run of neighbouring triangles: the unit that is culled.
struct Cluster {
  Aabb bounds; ///< in the primitive's own space
};

/// One indexed triangle list with one material.
struct Primitive {
  int material = 0;                    ///< index into Scene::materials
  std::vector<int> variantMaterials{}; ///< one a variant of the file, -1 = `material`; empty = none differs
  std::uint32_t baseVertex = 0;        ///< added to each index
  std::uint32_t vertexCount = 0;
  std::uint32_t firstIndex = 0; ///< into Scene::indices
  std::uint32_t indexCount = 0;
  std::uint32_t firstCluster = 0; ///< into Scene::clusters; cluster k holds triangles [k, k+1) * kClusterTriangles
  std::uint32_t clusterCount = 0;
  bool hasTangents = false;
  bool solid = false;    ///< its triangles bound solids, front faces outside (geometry/welding.h)
  Aabb bounds;           ///< in its own space
  std::string content{}; ///< SHA-256 of what its vertices and indices were made from; empty = not known
};

/// The numbers are those of glTF and OpenGL.
enum class Wrap { repeat = 10497, clampToEdge = 33071, mirroredRepeat = 33648 };

/// The minification filter, numbered as in OpenGL.
enum class MinFilter {
  nearest = 9728,
  linear = 9729,
  nearestMipmapNearest = 9984,
  linearMipmapNearest = 9985,
  nearestMipmapLinear = 9986,
  linearMipmapLinear = 9987
};

inline bool takesNearestTexel(MinFilter filter) {
  return filter == MinFilter::nearest || filter == MinFilter::nearestMipmapLinear ||
         filter == MinFilter::nearestMipmapNearest;
}

/// Whether it reads smaller levels at all, and whether it mixes two of them.
inline bool takesLevels(MinFilter filter) {
  return filter != MinFilter::linear && filter != MinFilter::nearest;
}
inline bool mixesLevels(MinFilter filter) {
  return filter == MinFilter::linearMipmapLinear || filter == MinFilter::nearestMipmapLinear;
}

/// KHR_texture_transform: from a vertex's coordinates to those that the texture is read at.
struct TextureTransform {
  glm::mat2 axes{1};
  glm::vec2 offset{0};

  bool operator==(const TextureTransform&) const = default;
};

/// A texture as a material uses it.
struct TextureUse {
  int image = -1;   ///< index into Scene::images
  int texCoord = 0; ///< 0 or 1
  Wrap wrapS = Wrap::repeat;
  Wrap wrapT = Wrap::repeat;
  bool nearest = false; ///< magnification filter
  MinFilter minFilter = MinFilter::linearMipmapLinear;
  std::optional<TextureTransform> transform{};

  bool operator==(const TextureUse&) const = default;
};

/// KHR_materials_pbrSpecularGlossiness; the diffuse color is Material::baseColorFactor, its texture baseColor.
struct SpecularGlossiness {
  glm::vec3 specularFactor{1}; ///< linear
  float glossinessFactor = 1;

  bool operator==(const SpecularGlossiness&) const = default;
};

/// glTF metallic-roughness, or specular-glossiness.
struct Material {
  std::string name;
  glm::vec4 baseColorFactor{1}; ///< linear
  glm::vec3 emissiveFactor{0};  ///< linear
  float metallicFactor = 1;
  float roughnessFactor = 1;
  float normalScale = 1;
  float occlusionStrength = 1;
  std::optional<float> cutoff{};       ///< where alpha is below it, nothing is there; nothing = it has no holes
  std::optional<float> lightOpacity{}; ///< share of the light that a dithered caster stops, times alpha where it has
                                       ///< holes; nothing = all of it
  float transmission = 0;              ///< share of the light that the eye sees pass where it is not reflected
  bool doubleSided = false;
  bool hasVertexColors = false;
  bool unlit = false;          ///< it shows its base color, whatever the light
  bool catchesShadows = false; ///< in view color it shows what is behind it, darkened by the shadows on it
  std::optional<SpecularGlossiness> specularGlossiness{}; ///< instead of metal and roughness
  /// metallicRoughness: with `specularGlossiness` its texture, sRGB specular and alpha glossiness.
  std::optional<TextureUse> baseColor, metallicRoughness, normal, occlusion, emissive;

  bool operator==(const Material&) const = default;
};

/// Whether there are places where nothing is, for the eye and for light.
inline bool hasHoles(const Material& material) {
  return material.cutoff.has_value();
}

/// Whether no light passes, however its caster is drawn.
inline bool stopsAllLight(const Material& material) {
  return !material.cutoff && !material.lightOpacity;
}

/// Every place in a material (const or not) where a texture may stand, in the order in which shaders number them.
template <class SomeMaterial>
auto texturesOf(SomeMaterial& material) {
  return std::array{&material.baseColor, &material.metallicRoughness, &material.normal, &material.occlusion,
                    &material.emissive};
}

/// A node of the file.
struct SceneNode {
  std::string name;
  int parent = -1; ///< index into Scene::nodes; -1 = a root
};

/// A node where the file or a pose puts it.
struct PlacedNode {
  glm::dmat4 worldFromNode{1};
  bool hidden = false; ///< it or a node above it is not visible (KHR_node_visibility)
};

/// A primitive placed in the world.
struct Instance {
  int node = 0;      ///< index into Scene::nodes
  int primitive = 0; ///< index into Scene::primitives
  int material = -1; ///< index into Scene::materials; -1 = the primitive's
  int copy = 0;      ///< which of those that EXT_mesh_gpu_instancing makes of the node's mesh
  glm::dmat4 worldFromLocal{1};
  Aabb bounds; ///< in the world
};

inline constexpr std::uint32_t kNoSurface = std::numeric_limits<std::uint32_t>::max();

/// One triangle of one instance.
struct PlacedTriangle {
  std::uint32_t instance = kNoSurface; ///< index into SceneView::instances; kNoSurface = none
  std::uint32_t triangle = 0;          ///< of its primitive
};

struct SceneCamera {
  int node = 0;
  std::string name;
  glm::dvec3 eye{0}, forward{0, 0, -1}, up{0, 1, 0}; ///< orthonormal directions, whatever the node's scale
  std::optional<Perspective> perspective;            ///< exactly one of the two
  std::optional<Orthographic> orthographic;
};

/// A camera of the file that is not drawn from.
struct LeftOutCamera {
  int node = 0;
  std::string name;
  std::string why;
};

struct SceneLight {
  int node = 0;
  std::string name;
  Light light; ///< position and direction in the world
};

/// One of the file's scenes, its node tree flattened.
struct SceneView {
  std::vector<int> roots; ///< indices into Scene::nodes
  std::vector<Instance> instances;
  std::vector<SceneCamera> cameras;
  std::vector<SceneLight> lights;
  int imageBasedLight = -1; ///< index into Scene::imageBasedLights; -1 = none
  Aabb bounds;              ///< in the world
  std::uint64_t triangles = 0;
};

/// The point that what casts is placed by on the device: it stands still while cameras move.
inline glm::dvec3 anchorOf(const SceneView& view) {
  return view.bounds.empty() ? glm::dvec3(0.0) : view.bounds.center();
}

/// A frame's ground as a part of its scene: the last node and the last material, and the last instance of each view.
/// Views' bounds don't count it.
struct GroundPlane {
  glm::dvec3 center{0};
  double size = 0; ///< length of its sides, metres
  bool catchesShadows = false;
  glm::vec3 color{0}; ///< linear
  float roughness = 1;

  bool operator==(const GroundPlane&) const = default;
};

struct Deformation;
struct Motion;
class PoseCache;

/// A loaded glTF file, shared between threads: immutable but for `poses`, `images` and `environmentFiles`, which lock
/// themselves.
struct Scene {
  SharedVector<glm::vec3> positions;         ///< of all primitives
  SharedVector<VertexAttributes> attributes; ///< parallel to positions
  SharedVector<std::uint32_t> indices;       ///< relative to the primitive's baseVertex, checked
  SharedVector<std::uint32_t> welded;        ///< parallel to indices, for what needs positions only (welding.h)
  std::vector<Cluster> clusters;
  std::vector<Primitive> primitives;
  std::vector<Material> materials;                           ///< at least one (the default material)
  SceneImages images;                                        ///< decoded when a frame needs them
  std::map<std::string, std::shared_ptr<const Bytes>> grids; ///< files of the bundle that hold volumes, by their names
  std::map<std::string, std::shared_ptr<const EnvironmentFile>>
      environmentFiles;                                                 ///< those that are .hdr or .exr, by their names
  std::vector<std::shared_ptr<const EnvironmentFile>> imageBasedLights; ///< as the file numbers them; null = left out
  std::vector<SceneNode> nodes;                                         ///< as the file numbers them
  std::vector<LeftOutCamera> leftOutCameras;
  std::vector<PlacedNode> placedNodes;            ///< parallel; empty where there are no grids
  std::shared_ptr<const Deformation> deformation; ///< of skins and morph targets; nullptr = nothing deforms
  std::shared_ptr<const Motion> motion;           ///< what poses are made from; nullptr in a pose
  std::shared_ptr<PoseCache> poses;               ///< the last poses asked for; beside motion
  std::vector<SceneView> scenes;                  ///< the file's, and then all of them again for each variant
  std::vector<std::string> variants;              ///< names of the file's material variants
  std::optional<Primitive> groundMesh;            ///< what a ground is made of: no primitive of the file
  std::optional<GroundPlane> ground;              ///< nothing in a file
  int defaultScene = 0;
  SceneSummary summary; ///< its id is empty unless the scene is kept somewhere
};

/// Nodes and materials without those of a ground.
inline std::size_t fileNodes(const Scene& scene) {
  return scene.nodes.size() - (scene.ground ? 1 : 0);
}
inline std::size_t fileMaterials(const Scene& scene) {
  return scene.materials.size() - (scene.ground ? 1 : 0);
}
inline bool isGround(const Scene& scene, const Instance& instance) {
  return scene.ground && static_cast<std::size_t>(instance.node) == fileNodes(scene);
}

/// How many scenes the file has.
inline int fileScenes(const Scene& scene) {
  return static_cast<int>(scene.scenes.size() / (scene.variants.size() + 1));
}

/// One of the file's scenes in one of its material variants.
struct SceneIndex {
  int file = 0;
  std::optional<int> variant; ///< index into Scene::variants; nothing = the materials of the primitives themselves
};

/// Index into Scene::scenes.
inline int indexOf(const Scene& scene, const SceneIndex& index) {
  return index.file + (index.variant ? (1 + *index.variant) * fileScenes(scene) : 0);
}

/// Index into Scene::materials.
inline int materialOf(const Scene& scene, const Instance& instance) {
  return instance.material >= 0 ? instance.material
                                : scene.primitives[static_cast<std::size_t>(instance.primitive)].material;
}

} // namespace gnomon
