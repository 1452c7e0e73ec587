#include "renderer/passes/views/light_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>

#include "protocol/spec/limits.h"
#include "renderer/core/light.h"
#include "renderer/core/vec3.h"
#include "renderer/shadow/bias.h"

namespace gnomon {

static_assert(kLimits.maxCascades <= GNOMON_LIGHT_TILES);
// As std140 and std430 lay them out: whole vec4s, one after the other.
static_assert(sizeof(shared::LightData) == 8 * 16 && offsetof(shared::LightData, groups) == 7 * 16);
static_assert(sizeof(shared::TileData) == 10 * 16 && offsetof(shared::TileData, up) == 9 * 16);
static_assert(sizeof(shared::FrameData) == 11 * 16 && offsetof(shared::FrameData, depthRange) == 10 * 16);
static_assert(sizeof(shared::MaterialData) == 15 * 16);

namespace {

float typeOf(LightType type) {
  switch (type) {
    case LightType::directional:
      return GNOMON_DIRECTIONAL;
    case LightType::spot:
      return GNOMON_SPOT;
    case LightType::point:
      return GNOMON_POINT;
  }
  return GNOMON_DIRECTIONAL;
}

/// Angular falloff as KHR_lights_punctual recommends: 1 inside the inner cone, 0 outside the outer one.
glm::vec2 coneFalloff(const Light& light) {
  const double inner = std::cos(glm::radians(light.innerConeDegrees));
  const double outer = std::cos(glm::radians(light.outerConeDegrees));
  const double scale = 1.0 / std::max(1e-3, inner - outer);
  return {scale, -outer * scale};
}

glm::dvec3 colorOf(const Light& light) {
  if (light.temperatureKelvin) return blackBodyColor(*light.temperatureKelvin);
  return toVector(light.color.value_or(Vec3{1, 1, 1}));
}

/// Texels a side that the shader's filter compares.
unsigned filterTexels(const Filter& filter) {
  return filterKind(filter) == GNOMON_FILTER_KERNEL && filter.type != FilterType::hard
             ? static_cast<unsigned>(filter.size)
             : 1u;
}

glm::vec4 manualBias(const Bias& bias) {
  const auto offset = manualOffset(bias);
  if (!offset) return glm::vec4(0.0f);
  return {bias.depth.value_or(0.0), bias.slope.value_or(0.0), *offset, 1.0};
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
  out.bounds = glm::vec4((corner + inset) / atlas, (corner + size - inset) / atlas);
  out.interval = glm::vec4(tile.near, tile.blendNear, tile.far, tile.space.fit.normalOffset);
  const glm::dvec2 texel = tile.rect.width > 0 ? tile.space.fit.texelSize : glm::dvec2(1.0);
  out.bias = glm::vec4(tile.depthBias, tile.depthBiasNear, 1.0 / (texel * atlas));
  out.axis = glm::vec4(tile.space.basis.direction, 0.0);
  const Fit& fit = tile.space.fit;
  const double depths = fit.perspective ? -tile.near * tile.far / (tile.far - tile.near) : 1.0 / fit.depthExtent;
  const glm::dvec2 step = tile.rect.width > 0 ? texel * depths : glm::dvec2(0.0);
  out.right = glm::vec4(tile.space.basis.right * step.x, std::abs(step.x));
  out.up = glm::vec4(tile.space.basis.up * step.y, std::abs(step.y));
  return out;
}

} // namespace

int filterKind(const Filter& filter) {
  switch (filter.type) {
    case FilterType::hard:
      return GNOMON_FILTER_KERNEL;
    case FilterType::pcf:
      return filter.radius ? GNOMON_FILTER_DISC : GNOMON_FILTER_KERNEL;
    case FilterType::vsm:
      return GNOMON_FILTER_VSM;
    case FilterType::evsm:
      return GNOMON_FILTER_EVSM;
    case FilterType::msm:
      return GNOMON_FILTER_MSM;
  }
  return GNOMON_FILTER_KERNEL;
}

std::vector<shared::LightData> lightData(std::span<const Light> lights, const ShadowPlan& plan, const glm::dvec3& eye,
                                         std::span<const LitGroups> groups, std::span<const int> layered) {
  std::vector<shared::LightData> data;
  for (const Light& light : lights) {
    shared::LightData out{};
    const glm::dvec3 direction = directionOf(light);
    out.direction = glm::vec4(light.type == LightType::directional ? -direction : direction, typeOf(light.type));
    if (light.position) out.position = glm::vec4(toVector(*light.position) - eye, light.range.value_or(0.0));
    out.radiance = glm::vec4(colorOf(light) * light.intensity, 0.0);
    if (light.type == LightType::spot) out.cone = glm::vec4(coneFalloff(light), 0.0f, 0.0f);
    const LitGroups lit = groups.empty() ? LitGroups{} : groups[data.size()];
    out.groups = {lit.lit, lit.shadowed, 0, 0};
    data.push_back(out);
  }
  for (const PlannedLight& planned : plan.lights) {
    shared::LightData& out = data[static_cast<std::size_t>(planned.light)];
    const Shadow& shadow = *lights[static_cast<std::size_t>(planned.light)].shadow;
    out.tiles = {planned.tileCount, filterTexels(shadow.filter), planned.firstTile, 0};
    out.sampling = {filterKind(shadow.filter), shadow.filter.radius.value_or(0.0), 0, 0};
    out.bias = manualBias(shadow.bias);
    out.cone.z = static_cast<float>(shadow.strength);
    out.cone.w = planned.fadeOut ? 1.0f : 0.0f;
  }
  for (std::size_t layer = 0; layer < layered.size(); ++layer) {
    const auto light = static_cast<std::size_t>(layered[layer]);
    data[light].tiles.w = static_cast<unsigned>(layer) + 1;
    data[light].cone.z = static_cast<float>(lights[light].shadow->strength);
    data[light].sampling.z = lights[light].shadow->technique == ShadowTechnique::shadowVolume ? 1.0f : 0.0f;
  }
  return data;
}

std::vector<shared::TileData> tileData(const ShadowPlan& plan) {
  std::vector<shared::TileData> data;
  const glm::dvec2 atlas(plan.atlasWidth, plan.atlasHeight);
  std::transform(plan.tiles.begin(), plan.tiles.end(), std::back_inserter(data),
                 [&](const ShadowTile& tile) { return tileData(tile, atlas); });
  return data;
}

} // namespace gnomon
