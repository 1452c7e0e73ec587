#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "protocol/spec/scene_options.h"
#include "renderer/scene/scene.h"

/// Materials, cameras and lights as a glTF file states them: the parts of gltf::Model that animations may change.
namespace gnomon::gltf {

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

} // namespace gnomon::gltf
