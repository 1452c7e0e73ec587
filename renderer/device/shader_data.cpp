#include "renderer/device/shader_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>

#include "protocol/spec/limits.h"
#include "protocol/spec/traits.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/prepare/lit_light.h"
#include "renderer/resolve/studio_radiance.h"

namespace gnomon {

static_assert(kLimits.maxCascades <= GNOMON_LIGHT_TILES);
// What shaders share with what is decided without them.
static_assert(std::ranges::equal(std::array{GNOMON_DIRECTIONAL, GNOMON_SPOT, GNOMON_POINT}, kLightTraits, {}, {},
                                 [](const LightTraits& light) { return static_cast<int>(light.type); }));
static_assert(GNOMON_BLOCK_SIZE == kSurveyBlock);
static_assert(GNOMON_REGION_SIZE == kLightListSquare && GNOMON_REGION_SIZE % GNOMON_BLOCK_SIZE == 0);
// As std140 and std430 lay them out: a vec3 and the scalar behind it share 16 bytes. Each offset is compared with the
// driver's by a test (shared_structs_gl_test.cpp).
static_assert(sizeof(shared::LightData) == 9 * 16 && offsetof(shared::LightData, manualDepthBias) == 6 * 16);
static_assert(sizeof(shared::TileData) == 10 * 16 && offsetof(shared::TileData, up) == 9 * 16);
static_assert(sizeof(shared::FrameData) == 13 * 16 && offsetof(shared::FrameData, environmentTurn) == 11 * 16 + 8);
static_assert(sizeof(shared::MaterialData) == 15 * 16);

namespace {

/// The narrowest falloff, between two cosines: a sharp edge, where both cones are the same.
constexpr double kSharpEdge = 1e-5;

/// Angular falloff as KHR_lights_punctual recommends: 1 inside the inner cone, 0 outside the outer one.
glm::vec2 coneFalloff(const LitLight& light) {
  const double inner = std::cos(light.innerCone);
  const double outer = std::cos(light.outerCone);
  const double scale = 1.0 / std::max(kSharpEdge, inner - outer);
  return {scale, -outer * scale};
}

shared::LightData packed(const LitLight& light) {
  shared::LightData out{};
  out.direction = glm::vec3(traitsOf(light.type).parallel ? -light.direction : light.direction);
  out.type = static_cast<int>(light.type);
  out.position = glm::vec3(light.position);
  out.range = static_cast<float>(light.range);
  out.radiance = glm::vec3(light.radiance);
  out.strength = static_cast<float>(light.strength);
  out.shadowColor = glm::vec3(light.shadowColor);
  out.hasShadowColor = light.shadowColor != glm::dvec3(0) ? 1 : 0;
  if (traitsOf(light.type).hasCone) {
    const glm::vec2 falloff = coneFalloff(light);
    out.coneScale = falloff.x;
    out.coneOffset = falloff.y;
  }
  out.filterRadius =
      static_cast<float>(light.filter.kind == MapReadingKind::pcss ? light.filter.lightRadius : light.filter.radius);
  out.fadesOut = light.fadesOut ? 1 : 0;
  out.firstTile = static_cast<unsigned>(light.firstTile);
  out.tileCount = static_cast<unsigned>(light.tileCount);
  out.filterKind = filterKind(light.filter);
  out.filterSize = light.filter.size;
  out.visibilityLayer = static_cast<unsigned>(light.visibilityLayer + 1);
  out.layerOmitsTurnedFaces = light.layerOmitsTurnedFaces ? 1 : 0;
  out.litGroups = light.groups.lit;
  out.shadowedGroups = light.groups.shadowed;
  out.smoothTerminator = light.smoothTerminator ? 1 : 0;
  if (light.manualBias) {
    out.manualDepthBias = static_cast<float>(light.manualBias->depth);
    out.manualSlopeBias = static_cast<float>(light.manualBias->slope);
    out.manualNormalOffset = static_cast<float>(light.manualBias->normalOffset);
    out.hasManualBias = 1;
  }
  return out;
}

shared::TileData tileData(const ShadowTile& tile, const glm::dvec2& atlas) {
  shared::TileData out{};
  const glm::dvec2 corner(tile.rect.x, tile.rect.y);
  const glm::dvec2 size(tile.rect.width, tile.rect.height);
  const auto row = [&](int r) {
    const glm::dmat4& m = tile.clipFromRelative;
    return glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]);
  };
  for (int axis = 0; axis < 2; ++axis) {
    const double middle = (corner[axis] + 0.5 * size[axis]) / atlas[axis];
    out.atlasFromRelative[axis] = glm::vec4(row(axis) * (0.5 * size[axis] / atlas[axis]) + row(3) * middle);
  }
  out.atlasFromRelative[2] = glm::vec4(row(2));
  out.atlasFromRelative[3] = glm::vec4(row(3));
  // A filter reaches no farther than the border's width less one texel. A tile without texels has lowest above highest:
  // every lookup falls outside and is lit.
  const double inset = std::max(tile.border - 1, 1);
  out.lowest = glm::vec2((corner + inset) / atlas);
  out.highest = glm::vec2((corner + size - inset) / atlas);
  out.near = static_cast<float>(tile.near);
  out.blendNear = static_cast<float>(tile.blendNear);
  out.far = static_cast<float>(tile.far);
  const Fit& fit = tile.space.fit;
  out.normalOffset = static_cast<float>(fit.normalOffset);
  out.depthBias = static_cast<float>(tile.depthBias);
  out.depthBiasNear = static_cast<float>(tile.depthBiasNear);
  const glm::dvec2 texel = tile.rect.width > 0 ? fit.texelSize : glm::dvec2(1.0);
  out.atlasPerMetre = glm::vec2(1.0 / (texel * atlas));
  out.axis = glm::vec3(tile.space.basis.direction);
  const double depths = fit.perspective ? -tile.near * tile.far / (tile.far - tile.near) : 1.0 / fit.depthExtent;
  const glm::dvec2 step = tile.rect.width > 0 ? texel * depths : glm::dvec2(0.0);
  out.texelDepth = static_cast<float>(std::abs(step.x));
  out.right = glm::vec3(tile.space.basis.right * step.x);
  out.up = glm::vec3(tile.space.basis.up * step.y);
  out.filterReach = static_cast<float>(fit.radius);
  out.perspective = fit.perspective ? 1 : 0;
  return out;
}

/// Of the surroundings behind the scene; less than 0 = they are not seen.
float shownRoughness(EnvironmentBackground background) {
  switch (background) {
    case EnvironmentBackground::none:
      return -1;
    case EnvironmentBackground::environment:
      return 0;
    case EnvironmentBackground::blurred:
      return 0.4f;
  }
  return -1;
}

} // namespace

int filterKind(const FilterKernel& filter) {
  static_assert(kMapReadingKinds == std::array{MapReadingKind{GNOMON_FILTER_KERNEL}, MapReadingKind{GNOMON_FILTER_DISC},
                                               MapReadingKind{GNOMON_FILTER_VSM}, MapReadingKind{GNOMON_FILTER_EVSM},
                                               MapReadingKind{GNOMON_FILTER_MSM}, MapReadingKind{GNOMON_FILTER_PCSS}});
  return static_cast<int>(filter.kind);
}

int toneOf(ToneMapping toneMapping, bool encoded) {
  if (!encoded) return GNOMON_TONE_NONE;
  switch (toneMapping) {
    case ToneMapping::aces:
      return GNOMON_TONE_ACES;
    case ToneMapping::neutral:
      return GNOMON_TONE_NEUTRAL;
    case ToneMapping::agx:
      return GNOMON_TONE_AGX;
    case ToneMapping::none:
      return GNOMON_TONE_CLIP;
  }
  return GNOMON_TONE_CLIP;
}

std::vector<shared::LightData> lightData(std::span<const LitLight> lights) {
  std::vector<shared::LightData> data;
  std::transform(lights.begin(), lights.end(), std::back_inserter(data), packed);
  return data;
}

std::vector<shared::TileData> tileData(const ShadowPlan& plan) {
  std::vector<shared::TileData> data;
  const glm::dvec2 atlas(plan.atlasWidth, plan.atlasHeight);
  std::transform(plan.tiles.begin(), plan.tiles.end(), std::back_inserter(data),
                 [&](const ShadowTile& tile) { return tileData(tile, atlas); });
  return data;
}

shared::FrameData frameData(const ResolvedFrame& frame) {
  const CameraView& view = frame.view;
  shared::FrameData data{};
  data.clipFromRelative = glm::mat4(clipFromView(view) * viewFromRelative(view));
  const glm::dmat4 clip = clipFromView(view);
  const Background& background = frame.spec.background;
  data.forward = glm::vec3(view.forward);
  data.perspective = view.perspective ? 1 : 0;
  data.middle = glm::vec3(wayToMiddle(view));
  data.right = glm::vec3(view.right * view.halfSize.x);
  data.up = glm::vec3(view.up * view.halfSize.y);
  data.pixelHeight = static_cast<float>(2.0 * view.halfSize.y / frame.spec.height);
  data.depthTerms = glm::vec2(clip[2][2], clip[3][2]);
  data.pixelStep = glm::vec2(2.0 / frame.spec.width, 2.0 / frame.spec.height);
  data.background = glm::vec4(toVector(background.color), background.alpha);
  data.ambient = glm::vec3(studioRadiance(frame.spec));
  data.environmentTurn = glm::vec2(1, 0);
  data.exposureScale = static_cast<float>(std::exp2(frame.spec.exposure));
  data.ahead = static_cast<float>(view.ahead);
  data.shownRoughness = shownRoughness(frame.spec.environment.background);
  return data;
}

void setEnvironment(const FrameEnvironment& environment, shared::FrameData& data) {
  data.environmentIntensity = static_cast<float>(environment.intensity);
  data.studioLamps = environment.studioLamps ? 1 : 0;
  data.environmentTurn = glm::vec2(environment.mapFromWorld[0][0], environment.mapFromWorld[2][0]);
}

shared::MaterialData materialData(const Material& material) {
  shared::MaterialData data{};
  data.baseColorFactor =
      glm::vec4(glm::vec3(material.baseColorFactor), hasHoles(material) ? material.baseColorFactor.a : 1.0f);
  data.emissiveFactor = material.emissiveFactor;
  data.alphaCutoff = material.cutoff.value_or(0.0f);
  data.metallicFactor = material.metallicFactor;
  data.roughnessFactor = material.roughnessFactor;
  data.normalScale = material.normalScale;
  data.occlusionStrength = material.occlusionStrength;
  data.transmission = material.transmission;
  if (const auto& glossy = material.specularGlossiness) {
    data.specularFactor = glossy->specularFactor;
    data.glossinessFactor = glossy->glossinessFactor;
  }
  const auto uses = texturesOf(material);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const TextureTransform transform =
        *uses[i] ? (*uses[i])->transform.value_or(TextureTransform{}) : TextureTransform{};
    data.uvAxes[i] = glm::vec4(transform.axes[0], transform.axes[1]);
    data.uvOffsets[i] = glm::vec4(transform.offset, 0, 0);
  }
  return data;
}

shared::InstanceData instanceData(const PlacedInstance& instance) {
  shared::InstanceData data{};
  const glm::dmat4 place = glm::transpose(instance.relativeFromLocal);
  const glm::dmat3 normals = glm::transpose(instance.normalFromLocal);
  for (int row = 0; row < 3; ++row) {
    data.relativeFromLocal[row] = glm::vec4(place[row]);
    data.normalFromLocal[row] = glm::vec4(normals[row], 0.0);
  }
  data.receiverGroup() = instance.group;
  data.node() = static_cast<float>(instance.node); // exact: there are no more than kLimits.maxNodes
  return data;
}

std::vector<shared::InstanceData> instanceData(const FrameGeometry& geometry) {
  std::vector<shared::InstanceData> data;
  data.reserve(geometry.instances.size());
  for (const PlacedInstance& instance : geometry.instances) data.push_back(instanceData(instance));
  return data;
}

} // namespace gnomon
