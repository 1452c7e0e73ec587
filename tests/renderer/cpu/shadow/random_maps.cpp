#include "tests/renderer/cpu/shadow/random_maps.h"

#include <cmath>

#include "renderer/shaders/shared/functions.h"

namespace gnomon::cpu {

using glm::vec2;
using glm::vec3;
using glm::vec4;

float between(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<float> spread;
  return glm::normalize(vec3(spread(random), spread(random), spread(random)));
}

namespace {

constexpr float kNearest = 0.5f; // of a face
constexpr float kFarthest = 30.0f;

struct Axes {
  vec3 right, up, along;
};

Axes axesAlong(std::mt19937& random, const vec3& along) {
  const vec3 right = glm::normalize(glm::cross(along, randomDirection(random)));
  return {right, glm::cross(along, right), along};
}

DepthBuffer randomDepths(std::mt19937& random, int width, int height, int samples) {
  DepthBuffer buffer;
  buffer.width = width;
  buffer.height = height;
  buffer.samples = samples;
  buffer.depths.resize(buffer.blocks() * kBlockPlaces * static_cast<std::size_t>(samples));
  for (float& depth : buffer.depths) depth = glm::clamp(between(random, -0.1f, 1.1f), 0.0f, 1.0f);
  return buffer;
}

/// Blurred moments of random pairs of depths, by the definitions of shaders/shared/moments.h.
std::vector<vec4> randomMoments(std::mt19937& random, std::size_t count, int kind) {
  const auto of = [&](float depth) { return shared::momentsOf(depth, kind); };
  std::vector<vec4> moments(count);
  for (vec4& moment : moments) {
    moment = 0.4f * of(between(random, 0, 1)) + 0.35f * of(between(random, 0, 1)) + 0.25f * of(between(random, 0, 1));
  }
  return moments;
}

/// `across`: metres that the tile spans (parallel), or the same at 1 m from the light.
shared::TileData tileData(const Rect& rect, const Axes& axes, const vec3& origin, float across, bool perspective) {
  shared::TileData tile{};
  const vec2 size(rect.width, rect.height);
  const vec2 atlas(kTestAtlas);
  const vec2 middle = (vec2(rect.x, rect.y) + 0.5f * size) / atlas;
  const auto row = [&](const vec3& way, float scale) { return scale * vec4(way, -glm::dot(way, origin)); };
  const vec4 last = perspective ? row(axes.along, 1) : vec4(0, 0, 0, 1);
  tile.atlasFromRelative[0] = row(axes.right, 2 / across) * (0.5f * size.x / atlas.x) + last * middle.x;
  tile.atlasFromRelative[1] = row(axes.up, 2 / across) * (0.5f * size.y / atlas.y) + last * middle.y;
  tile.atlasFromRelative[2] = row(axes.along, 1.0f / 40) + vec4(0, 0, 0, 0.5f);
  const float perspectiveDepth = kFarthest / (kFarthest - kNearest);
  if (perspective) tile.atlasFromRelative[2] = last * perspectiveDepth - vec4(0, 0, 0, kNearest * perspectiveDepth);
  tile.atlasFromRelative[3] = last;
  tile.perspective = perspective ? 1 : 0;
  tile.lowest = (vec2(rect.x, rect.y) + 4.0f) / atlas;
  tile.highest = (vec2(rect.x, rect.y) + size - 4.0f) / atlas;
  tile.near = kNearest;
  tile.far = kFarthest;
  tile.normalOffset = 0.01f;
  tile.depthBias = 1e-5f;
  tile.depthBiasNear = perspective ? 1e-6f : 0.0f;
  const vec2 texel = across / size;
  tile.atlasPerMetre = 1.0f / (texel * atlas);
  tile.axis = axes.along;
  const vec2 step = texel * (perspective ? -kNearest * perspectiveDepth : 1.0f / 40);
  tile.texelDepth = std::abs(step.x);
  tile.filterReach = 0.06f * across;
  tile.right = axes.right * step.x;
  tile.up = axes.up * step.y;
  return tile;
}

shared::LightData lightData(const MapsOptions& options) {
  shared::LightData light{};
  light.type = options.lightType;
  light.radiance = vec3(1);
  light.strength = 0.9f;
  light.filterKind = options.filterKind;
  light.filterSize = options.filterSize;
  light.filterRadius = 0.2f;
  light.fadesOut = options.fadesOut ? 1 : 0;
  light.litGroups = ~0u;
  light.shadowedGroups = ~0u << 1;
  light.hasManualBias = options.manualBias ? 1 : 0;
  light.manualDepthBias = 0.02f;
  light.manualSlopeBias = 0.01f;
  light.manualNormalOffset = 0.03f;
  return light;
}

void addTile(std::mt19937& random, RandomMaps& maps, const MapsOptions& options, const Rect& rect,
             const shared::TileData& tile) {
  maps.tiles.push_back(tile);
  maps.depths.push_back(randomDepths(random, rect.width, rect.height, options.samples));
  const auto texels = static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
  maps.moments.push_back(GNOMON_READS_MOMENTS(options.filterKind) ? randomMoments(random, texels, options.filterKind)
                                                                  : std::vector<vec4>());
  maps.maps.push_back({rect, nullptr, {}});
}

} // namespace

ShadowMaps RandomMaps::view() const {
  return {lights, tiles, maps, vec2(kTestAtlas)};
}

RandomMaps randomMaps(std::mt19937& random, const MapsOptions& options) {
  RandomMaps maps;
  shared::LightData light = lightData(options);
  const bool perspective = options.lightType != GNOMON_DIRECTIONAL;
  const vec3 way = randomDirection(random);
  light.direction = perspective ? way : -way;
  light.position = vec3(1, -2, 3);
  light.tileCount = 4;
  const float splits[5] = {1, 6, 15, 26, 40};
  for (int i = 0; i < 4; ++i) {
    const Rect rect{512 * (i % 2) + 3, 512 * (i / 2) + 6, 330 + 31 * i, 410 - 23 * i};
    const Axes axes = axesAlong(random, perspective && i > 0 ? randomDirection(random) : way);
    shared::TileData tile = tileData(rect, axes, perspective ? light.position : vec3(0),
                                     perspective ? 1.8f : 12.0f + static_cast<float>(i), perspective);
    if (!perspective) {
      tile.near = splits[i];
      tile.far = splits[i + 1];
      tile.blendNear = i == 1 ? tile.far : splits[i + 1] - 2; // one that does not blend
    }
    addTile(random, maps, options, rect, tile);
  }
  maps.lights.push_back(light);
  for (std::size_t i = 0; i < maps.maps.size(); ++i) {
    maps.maps[i].depths = &maps.depths[i];
    maps.maps[i].moments = maps.moments[i];
  }
  return maps;
}

std::vector<AskedPoint> randomPoints(std::mt19937& random, const RandomMaps& maps, int count) {
  const shared::LightData& light = maps.lights[0];
  std::vector<AskedPoint> points;
  for (int i = 0; i < count; ++i) {
    AskedPoint point;
    const float reach = 7;
    point.relative =
        vec3(between(random, -reach, reach), between(random, -reach, reach), between(random, -reach, reach));
    point.toLight =
        light.type == GNOMON_DIRECTIONAL ? light.direction : glm::normalize(light.position - point.relative);
    point.normal = glm::normalize(randomDirection(random) + between(random, -0.5f, 2) * point.toLight);
    if (i % 7 == 0) { // along the light, nearly
      point.normal =
          glm::normalize(glm::cross(point.toLight, point.normal) + between(random, 0, 0.02f) * point.toLight);
    }
    point.viewDepth = between(random, 0.5f, 45);
    point.groupBit = i % 11 == 0 ? 1u : 2u;
    point.place = vec2(static_cast<float>(i % 640) + 0.5f, static_cast<float>(i / 640) + 0.5f);
    points.push_back(point);
  }
  return points;
}

} // namespace gnomon::cpu
