#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The numbers are glTF's own.
enum class ComponentType { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };
enum class ElementType { scalar, vec2, vec3, vec4, mat2, mat3, mat4 };
enum class PrimitiveMode { points, lines, lineLoop, lineStrip, triangles, triangleStrip, triangleFan };
enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential, color };
enum class Interpolation { linear, step, cubicSpline };

/// All that Gnomon reads of a glTF 2.0 file, with glTF's defaults; indices are the file's own, -1 = none.
namespace gltf {

// Materials, cameras and lights: what animations may change.

enum class AlphaMode { opaque, mask, blend };

/// KHR_texture_transform.
struct TextureTransform {
  glm::dvec2 offset{0};
  double rotation = 0; ///< radians
  glm::dvec2 scale{1};
};

/// A textureInfo.
struct TextureInfo {
  int texture = 0;
  int texCoord = 0; ///< that of KHR_texture_transform where it says one
  std::optional<TextureTransform> transform;
};

/// KHR_materials_pbrSpecularGlossiness.
struct SpecularGlossiness {
  glm::dvec4 diffuseFactor{1};
  glm::dvec3 specularFactor{1};
  double glossinessFactor = 1;
  std::optional<TextureInfo> diffuseTexture;
  std::optional<TextureInfo> specularGlossinessTexture;
};

/// KHR_materials_transmission.
struct Transmission {
  double factor = 0;
  std::optional<TextureInfo> texture;
};

struct Material {
  std::string name;
  glm::dvec4 baseColorFactor{1};
  double metallicFactor = 1;
  double roughnessFactor = 1;
  std::optional<TextureInfo> baseColorTexture;
  std::optional<TextureInfo> metallicRoughnessTexture;
  std::optional<TextureInfo> normalTexture;
  double normalScale = 1;
  std::optional<TextureInfo> occlusionTexture;
  double occlusionStrength = 1;
  std::optional<TextureInfo> emissiveTexture;
  glm::dvec3 emissiveFactor{0};
  std::optional<double> emissiveStrength; ///< KHR_materials_emissive_strength
  AlphaMode alphaMode = AlphaMode::opaque;
  double alphaCutoff = 0.5;
  bool doubleSided = false;
  bool unlit = false; ///< KHR_materials_unlit
  std::optional<SpecularGlossiness> specularGlossiness;
  std::optional<Transmission> transmission;
};

struct PerspectiveLens {
  double yfov = 0; ///< radians
  double znear = 0;
  double zfar = std::numeric_limits<double>::infinity();
};

struct OrthographicLens {
  double xmag = 0;
  double ymag = 0;
  double znear = 0;
  double zfar = 0;
};

struct Camera {
  std::string name;
  std::string fault; ///< why it is left out; empty = it is sound
  bool isPerspective = true;
  std::optional<PerspectiveLens> perspective;
  std::optional<OrthographicLens> orthographic;
};

struct SpotCone {
  double inner = 0; ///< radians, from the axis
  double outer = std::numbers::pi / 4;
};

/// Of KHR_lights_punctual.
struct PunctualLight {
  std::string name;
  std::string fault; ///< why it is left out; empty = it is sound
  LightType type = LightType::directional;
  std::optional<glm::dvec3> color;
  double intensity = 1;
  double range = std::numeric_limits<double>::infinity();
  std::optional<SpotCone> spot;
};

using Attributes = std::map<std::string, int>; ///< accessors by name

/// Of EXT_lights_image_based.
struct ImageBasedLight {
  std::string name;
  std::string fault; ///< why it is left out; empty = it is sound
  glm::dvec4 rotation{0, 0, 0, 1};
  double intensity = 1;
  std::array<glm::dvec3, 9> irradianceCoefficients{};
  std::vector<std::array<int, 6>> specularImages; ///< images of each level
  double specularImageSize = 0;
};

struct Scene {
  std::vector<int> nodes;
  int imageBasedLight = -1;
};

struct Node {
  std::string name;
  std::vector<int> children;
  int mesh = -1;
  int camera = -1;
  int skin = -1;
  int light = -1; ///< KHR_lights_punctual
  std::optional<glm::dmat4> matrix;
  std::optional<glm::dvec3> translation;
  std::optional<glm::dvec4> rotation; ///< x y z w
  std::optional<glm::dvec3> scale;
  std::optional<std::vector<double>> weights;
  std::optional<Attributes> instancing; ///< EXT_mesh_gpu_instancing
  bool visible = true;                  ///< KHR_node_visibility
};

/// KHR_draco_mesh_compression.
struct Draco {
  std::size_t bufferView = 0;
  std::map<std::string, std::uint32_t> attributes; ///< ids within the stream
};

/// KHR_materials_variants: the material in some of the file's variants.
struct VariantMapping {
  int material = 0;
  std::vector<std::size_t> variants;
};

struct Primitive {
  Attributes attributes;
  int indices = -1;
  int material = -1;
  PrimitiveMode mode = PrimitiveMode::triangles;
  std::vector<Attributes> targets;
  std::optional<Draco> draco;
  std::vector<VariantMapping> variantMappings;
};

struct Mesh {
  std::vector<Primitive> primitives;
  std::optional<std::vector<double>> weights;
};

struct Sparse {
  std::size_t count = 0;
  int indexView = 0;
  std::size_t indexOffset = 0;
  ComponentType indexType = ComponentType::uint32;
  int valueView = 0;
  std::size_t valueOffset = 0;
};

struct Accessor {
  int bufferView = -1;
  std::size_t byteOffset = 0;
  ComponentType componentType = ComponentType::float32;
  ElementType type = ElementType::scalar;
  bool normalized = false;
  std::size_t count = 0;
  std::optional<Sparse> sparse;
  std::vector<double> min; ///< one a component, as the file states it; empty = it does not
  std::vector<double> max;
  bool faulty = false; ///< it is left out, and the rest of it means nothing
};

/// EXT_meshopt_compression, or KHR_meshopt_compression.
struct Meshopt {
  std::string_view extension; ///< which of the two
  std::size_t buffer = 0;
  std::uint64_t byteOffset = 0;
  std::uint64_t byteLength = 0; ///< of the compressed bytes
  std::uint64_t byteStride = 0; ///< of an element; 1..256
  std::uint64_t count = 0;      ///< of elements; < 2^53
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;

  std::uint64_t decodedBytes() const { return byteStride * count; }
};

struct BufferView {
  std::size_t buffer = 0;
  std::uint64_t byteOffset = 0;
  std::uint64_t byteLength = 0;
  std::optional<std::uint64_t> byteStride{}; ///< none = tightly packed
  std::optional<Meshopt> meshopt;
  bool faulty = false; ///< it is left out, and the rest of it means nothing
};

struct Buffer {
  std::optional<std::string> uri;
  std::uint64_t byteLength = 0;
  bool fallback = false; ///< marked so by the meshopt extension
  bool faulty = false;   ///< it is left out, and the rest of it means nothing
};

struct Image {
  std::optional<std::string> name;
  std::optional<std::string> uri;
  int bufferView = -1;
};

struct Texture {
  int source = -1;
  int webp = -1;       ///< EXT_texture_webp
  bool basisu = false; ///< KHR_texture_basisu
  int sampler = -1;
};

struct TextureSampler {
  Wrap wrapS = Wrap::repeat;
  Wrap wrapT = Wrap::repeat;
  bool nearest = false; ///< magnification filter
  MinFilter minFilter = MinFilter::linearMipmapLinear;
};

struct Skin {
  std::vector<int> joints;
  int inverseBindMatrices = -1;
};

struct AnimationChannel {
  std::size_t sampler = 0;
  int node = -1;
  std::string path;
  std::optional<std::string> pointer; ///< KHR_animation_pointer
};

struct AnimationSampler {
  std::size_t input = 0;
  std::size_t output = 0;
  Interpolation interpolation = Interpolation::linear;
  bool faulty = false; ///< it is left out, and the rest of it means nothing
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
  std::vector<AnimationSampler> samplers;
};

struct Model {
  int scene = -1; ///< the default one
  std::vector<Scene> scenes;
  std::vector<Node> nodes;
  glm::dvec3 center{0}; ///< CESIUM_RTC: the root nodes are moved by it
  std::vector<Mesh> meshes;
  std::vector<Accessor> accessors;
  std::vector<BufferView> bufferViews;
  std::vector<Buffer> buffers;
  std::vector<Image> images;
  std::vector<Texture> textures;
  std::vector<TextureSampler> samplers;
  std::vector<Material> materials;
  std::vector<Camera> cameras;
  std::vector<PunctualLight> lights;
  std::vector<ImageBasedLight> imageBasedLights;
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  std::vector<std::string> variants; ///< names, KHR_materials_variants
  std::vector<std::string> extensionsUsed;
};

} // namespace gltf
} // namespace gnomon
