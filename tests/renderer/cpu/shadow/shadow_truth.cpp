#include "tests/renderer/cpu/shadow/shadow_truth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "renderer/shaders/shared/functions.h"

namespace gnomon::cpu::truth {

using glm::abs;
using glm::clamp;
using glm::dot;
using glm::floor;
using glm::fract;
using glm::ivec2;
using glm::max;
using glm::min;
using glm::mix;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using shared::LightData;
using shared::TileData;

namespace {

/// The atlas, and the tile that is read.
struct Reading {
  const ShadowMaps& maps;
  const TileData& tile;
  const TileMap& map;
  vec2 slope;

  float depth(ivec2 texel, int sample = 0) const {
    return map.depths->depths[map.depths->at(texel.x - map.rect.x, texel.y - map.rect.y, sample)];
  }
  /// Of one texel, for a plane whose depth at `place` (texels of the atlas) is `plane`.
  float lit(ivec2 texel, vec2 place, float plane) const {
    const float held = plane + dot(slope, vec2(texel) + 0.5f - place);
    return depth(texel) < min(held, 1.0f) ? 0.0f : 1.0f;
  }
  float bilinear(vec2 place, float plane) const {
    const vec2 corner = floor(place - 0.5f) + 1.0f;
    const vec2 fraction = place + 0.5f - corner;
    const ivec2 high(corner);
    const float low = mix(lit(high - ivec2(1, 1), place, plane), lit(high - ivec2(0, 1), place, plane), fraction.x);
    return mix(low, mix(lit(high - ivec2(1, 0), place, plane), lit(high, place, plane), fraction.x), fraction.y);
  }
  float square(vec2 place, float plane, int size) const {
    const ivec2 middle(place);
    float sum = 0;
    for (int y = -(size / 2); y <= size / 2; ++y) {
      for (int x = -(size / 2); x <= size / 2; ++x) {
        const ivec2 texel = middle + ivec2(x, y);
        const float held = plane + dot(slope, vec2(texel) + 0.5f - place) - 0.5f * (abs(slope.x) + abs(slope.y));
        for (int i = 0; i < 4; ++i) sum += depth(texel, i) < min(held, 1.0f) ? 0.0f : 0.25f;
      }
    }
    return sum / static_cast<float>(size * size);
  }
  float kernel(vec2 place, float plane, int size) const {
    if (map.depths->samples > 1) return square(place, plane, size);
    if (size <= 1) return bilinear(place, plane);
    const float kernels[3][7] = {{1, 2, 1}, {1, 3, 4, 3, 1}, {1, 5, 12, 16, 12, 5, 1}};
    const float* weights = kernels[size / 2 - 1];
    float sum = 0;
    float all = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const vec2 step = vec2(x, y) - static_cast<float>(size / 2);
        // Neighbours of a bilinear comparison: the texels stay the same whichever comparison weighs them.
        sum += weights[x] * weights[y] * bilinear(place + step, plane + dot(slope, step));
        all += weights[x] * weights[y];
      }
    }
    return sum / all;
  }
  /// The mean z from the receiver to what stands before the light's disc, or else before the receiver's plane; negative
  /// where nothing does.
  float casterHeight(const Lookup& at, float radius, float perDepth, vec2 pixel) const {
    const vec2 texels = maps.atlasTexels;
    const float turn = 6.2831853f * fract(52.9829189f * fract(dot(pixel, vec2(0.06711056f, 0.00583715f))));
    const float lowered = map.depths->samples > 1 ? 0.5f * (abs(slope.x) + abs(slope.y)) : 0.0f;
    const vec2 perLength = tile.atlasPerMetre * texels;
    const float twoTexels = 2.0f / max(perLength.x, perLength.y);
    std::vector<float> covering, standing;
    for (int i = 0; i < 32; ++i) {
      const float angle = turn + static_cast<float>(i) * 2.39996323f;
      const float away = radius * static_cast<float>(i * i) / (31.0f * 31.0f);
      const vec2 step = vec2(std::cos(angle), std::sin(angle)) * away;
      const vec2 place = vec2(at.coordinate) + step * tile.atlasPerMetre;
      if (glm::any(glm::lessThan(place, tile.lowest)) || glm::any(glm::greaterThan(place, tile.highest))) continue;
      const ivec2 texel(place * texels);
      const float plane = at.coordinate.z + dot(slope, vec2(texel) + 0.5f - vec2(at.coordinate) * texels) - lowered;
      const float seen = depth(texel, i % map.depths->samples);
      if (seen >= min(plane, 1.0f)) continue;
      const float height = max(at.coordinate.z - seen, 0.0f);
      standing.push_back(height);
      if (away <= perDepth * height + twoTexels) covering.push_back(height);
    }
    const std::vector<float>& heights = covering.empty() ? standing : covering;
    if (heights.empty()) return -1.0f;
    return std::accumulate(heights.begin(), heights.end(), 0.0f) / static_cast<float>(heights.size());
  }
  /// `radius`: a length across the light; `height`: the disc's before the receiver, z.
  float disc(const Lookup& at, float radius, float height, vec2 pixel) const {
    const vec2 texels = maps.atlasTexels;
    const float turn = 6.2831853f * fract(52.9829189f * fract(dot(pixel, vec2(0.06711056f, 0.00583715f))));
    float sum = 0;
    int above = 0;
    for (int i = 0; i < 32; ++i) {
      const float angle = turn + static_cast<float>(i) * 2.39996323f;
      const vec2 step =
          vec2(std::cos(angle), std::sin(angle)) * (radius * std::sqrt((static_cast<float>(i) + 0.5f) / 32.0f));
      const vec2 place = vec2(at.coordinate) + step * tile.atlasPerMetre;
      const bool outside =
          glm::any(glm::lessThan(place, tile.lowest)) || glm::any(glm::greaterThan(place, tile.highest));
      const float rise = dot(slope, (place - vec2(at.coordinate)) * texels);
      if (rise < -height) continue;
      ++above;
      sum += outside ? 1.0f : kernel(place * texels, at.coordinate.z + rise, 1);
    }
    return sum / static_cast<float>(std::max(above, 1));
  }
  vec4 moments(vec2 place) const {
    const auto texel = [&](ivec2 at) {
      return map.moments[static_cast<std::size_t>((at.y - map.rect.y) * map.rect.width + at.x - map.rect.x)];
    };
    const vec2 base = floor(place - 0.5f);
    const vec2 fraction = place - 0.5f - base;
    const ivec2 low(base);
    return mix(mix(texel(low), texel(low + ivec2(1, 0)), fraction.x),
               mix(texel(low + ivec2(0, 1)), texel(low + ivec2(1, 1)), fraction.x), fraction.y);
  }
};

/// The share of a disc that stands above the receiver's plane.
float shareAbovePlane(const LightData& light, const AskedPoint& receiver) {
  const float cosine = dot(receiver.normal, receiver.toLight);
  const float away = light.type == GNOMON_DIRECTIONAL ? 1.0f : glm::length(light.position - receiver.relative);
  const float x =
      clamp(cosine * away / (std::sqrt(max(1.0f - cosine * cosine, 1e-12f)) * light.filterRadius), -1.0f, 1.0f);
  return 0.5f + (std::asin(x) + x * std::sqrt(1.0f - x * x)) / 3.14159265f;
}

float tileVisibility(const ShadowMaps& maps, const LightData& light, std::size_t index, const AskedPoint& receiver) {
  const TileData& tile = maps.tiles[index];
  Lookup at = lookupIn(light, tile, receiver);
  if (!at.inside) return 1.0f;
  const vec2 slope = shared::comparedSlope(light, tile, receiver.relative, receiver.normal);
  const Reading reading{maps, tile, maps.maps[index], slope};
  const vec2 place = vec2(at.coordinate) * maps.atlasTexels;
  if (GNOMON_READS_MOMENTS(light.filterKind)) {
    return shared::visibilityFrom(reading.moments(place), shared::momentDepth(tile, at.coordinate.z, at.divisor),
                                  light.filterKind);
  }
  if (light.filterKind == GNOMON_FILTER_DISC) {
    const vec2 reach = light.filterRadius * tile.atlasPerMetre * maps.atlasTexels / at.divisor;
    at.coordinate.z -= shared::bendRoom(light, tile, at.divisor, slope, 1.0f + max(reach.x, reach.y));
    const float radius = shared::discRadius(tile, light.filterRadius, at.divisor);
    return reading.disc(at, radius, HUGE_VALF, receiver.place);
  }
  if (light.filterKind == GNOMON_FILTER_PCSS) {
    const vec2 perLength = tile.atlasPerMetre * maps.atlasTexels;
    const float widest = max(perLength.x, perLength.y);
    const float perDepth = light.filterRadius / (tile.texelDepth * perLength.x);
    const float reach = min(perDepth * max(at.coordinate.z, 0.0f), tile.filterReach);
    Lookup searched = at;
    searched.coordinate.z -= shared::bendRoom(light, tile, at.divisor, slope, 1.0f + reach * widest);
    const float height = reading.casterHeight(searched, reach, perDepth, receiver.place);
    const float above = shareAbovePlane(light, receiver);
    if (height < 0.0f) return above;
    const float radius = min(perDepth * height, reach);
    at.coordinate.z -= shared::bendRoom(light, tile, at.divisor, slope, 1.0f + radius * widest);
    return above * reading.disc(at, radius, radius / perDepth, receiver.place);
  }
  at.coordinate.z -= shared::bendRoom(light, tile, at.divisor, slope, 0.5f * static_cast<float>(light.filterSize + 1));
  return reading.kernel(place, at.coordinate.z, light.filterSize);
}

TileChoice chooseCascade(const ShadowMaps& maps, const LightData& light, float viewDepth) {
  const int last = static_cast<int>(light.tileCount) - 1;
  int index = 0;
  const auto tile = [&](int i) -> const TileData& { return maps.tiles[light.firstTile + static_cast<unsigned>(i)]; };
  while (index < last && viewDepth > tile(index).far) ++index;
  const bool begun = viewDepth >= tile(0).near;
  const float blendNear = tile(index).blendNear;
  const float far = tile(index).far;
  const float zone = far > blendNear ? glm::smoothstep(blendNear, far, viewDepth) : 0.0f;
  const bool fades = light.fadesOut != 0u;
  if (index < last) return {index, zone > 0.0f ? index + 1 : index, zone, 0.0f, begun};
  return {index, index, 0.0f, fades ? zone : 0.0f, begun && (!fades || viewDepth <= far)};
}

float layerValue(const Layer& layer, const AskedPoint& receiver) {
  const auto pixel = static_cast<std::size_t>(receiver.place.y) * static_cast<std::size_t>(layer.width) +
                     static_cast<std::size_t>(receiver.place.x);
  if (layer.samples == 1) return static_cast<float>(layer.values[pixel]) / 65535.0f;
  float sum = 0;
  float count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if ((receiver.samples >> i & 1u) == 0) continue;
    sum += static_cast<float>(layer.values[4 * pixel + i]) / 65535.0f;
    count += 1;
  }
  return sum / count;
}

} // namespace

Lookup lookupIn(const LightData& light, const TileData& tile, const AskedPoint& receiver) {
  const vec4 p(shared::movedReceiver(light, tile, receiver.relative, receiver.normal, receiver.toLight), 1.0f);
  Lookup at;
  at.coordinate =
      vec3(dot(tile.atlasFromRelative[0], p), dot(tile.atlasFromRelative[1], p), dot(tile.atlasFromRelative[2], p));
  at.divisor = dot(tile.atlasFromRelative[3], p);
  if (at.divisor <= 0.0f) return {vec3(0.0f), 1.0f, false};
  at.coordinate /= at.divisor;
  at.coordinate.z -= tile.depthBias + tile.depthBiasNear / (at.divisor * at.divisor);
  at.inside = glm::all(glm::greaterThanEqual(vec2(at.coordinate), tile.lowest)) &&
              glm::all(glm::lessThanEqual(vec2(at.coordinate), tile.highest));
  return at;
}

TileChoice chooseTile(const ShadowMaps& maps, int light, const AskedPoint& receiver) {
  const LightData& data = maps.lights[static_cast<std::size_t>(light)];
  if (data.type == GNOMON_DIRECTIONAL) return chooseCascade(maps, data, receiver.viewDepth);
  int best = 0;
  float most = -2.0f;
  for (unsigned i = 0; i < data.tileCount; ++i) {
    const float along = -dot(maps.tiles[data.firstTile + i].axis, receiver.toLight);
    if (along > most) {
      most = along;
      best = static_cast<int>(i);
    }
  }
  return {best, best, 0.0f, 0.0f, true};
}

float shadowVisibility(const ShadowMaps& maps, int light, const AskedPoint& receiver) {
  const LightData& data = maps.lights[static_cast<std::size_t>(light)];
  const bool turnedAway = dot(receiver.normal, receiver.toLight) <= 1e-4f;
  const bool receives = (data.shadowedGroups & receiver.groupBit) != 0u;
  if (data.visibilityLayer > 0u) {
    if (!receives) return 1.0f;
    float visibility = layerValue(maps.layers[data.visibilityLayer - 1], receiver);
    if (data.layerOmitsTurnedFaces != 0u && turnedAway) visibility = 0.0f;
    return mix(1.0f, visibility, data.strength);
  }
  if (data.tileCount == 0u || !receives) return 1.0f;
  const TileChoice choice = chooseTile(maps, light, receiver);
  if (!choice.covered) return 1.0f;
  float visibility = 0.0f;
  for (int i = choice.first; i <= choice.second && !turnedAway; ++i) {
    const float share = i == choice.first ? 1.0f - choice.blend : choice.blend;
    visibility += share * tileVisibility(maps, data, data.firstTile + static_cast<unsigned>(i), receiver);
  }
  visibility = mix(visibility, 1.0f, choice.fade);
  return mix(1.0f, visibility, data.strength);
}

} // namespace gnomon::cpu::truth
