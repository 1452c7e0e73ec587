#include "tests/renderer/cpu/shadow/debug_truth.h"

#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>

#include "renderer/prepare/draw_list.h"
#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/shadow/shadow_truth.h"

namespace gnomon::cpu::truth {

using glm::abs;
using glm::cross;
using glm::dot;
using glm::ivec2;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using shared::LightData;
using shared::TileData;

namespace {

struct TexelEdges {
  vec2 u, v;
  float scale;
};

vec2 pixelsAlong(const DebugMaps& debug, const AskedPoint& receiver, vec3 way) {
  const shared::FrameData& frame = debug.frame;
  const vec3 right = vec3(frame.right) / dot(vec3(frame.right), vec3(frame.right));
  const vec3 up = vec3(frame.up) / dot(vec3(frame.up), vec3(frame.up));
  vec2 moved(dot(way, right), dot(way, up));
  if (frame.perspective != 0u) {
    const vec2 place = vec2(dot(receiver.relative, right), dot(receiver.relative, up)) / receiver.viewDepth;
    moved = (moved - place * dot(way, vec3(frame.forward))) / receiver.viewDepth;
  }
  return moved / frame.pixelStep;
}

TexelEdges texelEdges(const DebugMaps& debug, const DebugTexel& texel, const AskedPoint& receiver) {
  const vec2 atlasTexels = debug.maps.atlasTexels;
  const vec3 last(texel.data.atlasFromRelative[3]);
  const vec3 u = (vec3(texel.data.atlasFromRelative[0]) - texel.coordinate.x * last) * (atlasTexels.x / texel.divisor);
  const vec3 v = (vec3(texel.data.atlasFromRelative[1]) - texel.coordinate.y * last) * (atlasTexels.y / texel.divisor);
  return {pixelsAlong(debug, receiver, cross(v, receiver.normal)),
          pixelsAlong(debug, receiver, cross(receiver.normal, u)), dot(receiver.normal, cross(u, v))};
}

vec2 checkerboardMeans(vec2 place, vec2 width) {
  const vec2 before = 1.0f - abs(2.0f * glm::fract((place - 0.5f * width) * 0.5f) - 1.0f);
  const vec2 after = 1.0f - abs(2.0f * glm::fract((place + 0.5f * width) * 0.5f) - 1.0f);
  return (after - before) / width;
}

const LightData& lightOf(const DebugMaps& debug) {
  return debug.maps.lights[0];
}

} // namespace

std::optional<DebugTexel> debugTexel(const DebugMaps& debug, const AskedPoint& receiver) {
  if (lightOf(debug).tileCount == 0) return std::nullopt;
  const TileChoice choice = chooseTile(debug.maps, 0, receiver);
  const TileData& tile = debug.maps.tiles[lightOf(debug).firstTile + static_cast<unsigned>(choice.first)];
  const vec4 p(receiver.relative, 1.0f);
  const float divisor = dot(tile.atlasFromRelative[3], p);
  const vec3 at =
      vec3(dot(tile.atlasFromRelative[0], p), dot(tile.atlasFromRelative[1], p), dot(tile.atlasFromRelative[2], p)) /
      divisor;
  const bool found = choice.covered && divisor > 0.0f && glm::all(glm::greaterThanEqual(vec2(at), tile.lowest)) &&
                     glm::all(glm::lessThanEqual(vec2(at), tile.highest));
  if (!found) return std::nullopt;
  return DebugTexel{choice.first, choice.blend, tile, at, divisor};
}

float texelDensity(const DebugMaps& debug, const DebugTexel& texel, const AskedPoint& receiver) {
  const TexelEdges edges = texelEdges(debug, texel, receiver);
  const float uu = dot(edges.u, edges.u);
  const float vv = dot(edges.v, edges.v);
  const float uv = dot(edges.u, edges.v);
  const float greatest = std::sqrt(0.5f * (uu + vv + std::sqrt((uu - vv) * (uu - vv) + 4.0f * uv * uv)));
  return std::min(greatest / std::max(std::abs(edges.scale), 1e-30f), 65504.0f);
}

float biasMetres(const DebugMaps& debug, const DebugTexel& texel, const AskedPoint& receiver) {
  Lookup at = lookupIn(lightOf(debug), texel.data, receiver);
  if (!at.inside) return 0.0f;
  const vec2 slope = shared::comparedSlope(lightOf(debug), texel.data, receiver.relative, receiver.normal);
  at.coordinate.z -= shared::bendRoom(lightOf(debug), texel.data, at.divisor, slope, 1.0f);
  const vec3 last(texel.data.atlasFromRelative[3]);
  const glm::mat3 planes(vec3(texel.data.atlasFromRelative[0]) - at.coordinate.x * last,
                         vec3(texel.data.atlasFromRelative[1]) - at.coordinate.y * last,
                         vec3(texel.data.atlasFromRelative[2]) - at.coordinate.z * last);
  return glm::length(glm::inverse(glm::transpose(planes)) * ((at.coordinate - texel.coordinate) * texel.divisor));
}

int casterNode(const DebugMaps& debug, const AskedPoint& receiver) {
  const auto texel = debugTexel(debug, receiver);
  if (!texel) return -1;
  Lookup at = lookupIn(lightOf(debug), texel->data, receiver);
  const vec2 slope = shared::comparedSlope(lightOf(debug), texel->data, receiver.relative, receiver.normal);
  const vec2 place = vec2(at.coordinate) * debug.maps.atlasTexels;
  const ivec2 under(place);
  at.coordinate.z -= shared::bendRoom(lightOf(debug), texel->data, at.divisor, slope, 1.0f);
  const float plane = at.coordinate.z + dot(slope, vec2(under) + 0.5f - place);
  if (!at.inside) return -1;
  const TileMap& casters = debug.casters[static_cast<std::size_t>(texel->tile)];
  const std::size_t index = casters.depths->at(under.x - casters.rect.x, under.y - casters.rect.y);
  if (std::min(plane, 1.0f) <= casters.depths->depths[index]) return -1;
  const std::uint32_t number = casters.depths->triangles[index];
  return number == kNoNumber ? -1 : debug.slotNodes[number / kClusterTriangles];
}

vec3 nodeColor(int node) {
  const vec3 steps = glm::fract(static_cast<float>(node + 1) * vec3(0.61803399f, 0.75487767f, 0.56984029f));
  const vec3 hue =
      glm::clamp(abs(glm::fract(steps.x + vec3(0, 2, 1) / 3.0f) * 6.0f - 3.0f) - 1.0f, vec3(0.0f), vec3(1.0f));
  return glm::mix(vec3(1.0f), hue, 0.55f + 0.4f * steps.y) * (0.7f + 0.3f * steps.z);
}

vec3 texelGrid(const DebugMaps& debug, const vec3& shown, const AskedPoint& receiver) {
  const vec3 grey(0.15f + 0.85f * glm::clamp(dot(shown, vec3(0.2126f, 0.7152f, 0.0722f)), 0.0f, 1.0f));
  const auto texel = debugTexel(debug, receiver);
  if (!texel) return grey;
  const TexelEdges edges = texelEdges(debug, *texel, receiver);
  const float area = std::max(std::abs(edges.u.x * edges.v.y - edges.u.y * edges.v.x), 1e-30f);
  const vec2 width = vec2(glm::length(edges.v), glm::length(edges.u)) * (std::abs(edges.scale) / area);
  const vec2 mean = checkerboardMeans(vec2(texel->coordinate) * debug.maps.atlasTexels, glm::max(width, vec2(0.02f)));
  return grey * kTints[static_cast<std::size_t>(texel->tile)] * glm::mix(0.3f, 1.0f, 0.5f + 0.5f * mean.x * mean.y);
}

MapFootprint footprint(const DebugMaps& debug, const AskedPoint& receiver) {
  const LightData& light = lightOf(debug);
  if ((light.litGroups & light.shadowedGroups & receiver.groupBit) == 0u) return {};
  vec3 toLight;
  const vec3 arriving = shared::irradiance(light, receiver.relative, toLight);
  if (arriving == vec3(0.0f) || dot(receiver.normal, toLight) <= 1e-4f) return {};
  MapFootprint seen;
  seen.normal = receiver.normal;
  seen.viewDepth = receiver.viewDepth;
  const auto texel = debugTexel(debug, receiver);
  if (!texel) return seen;
  const TexelEdges edges = texelEdges(debug, *texel, receiver);
  const float scale = std::max(std::abs(edges.scale), 1e-30f);
  vec3 moved = shared::movedReceiver(light, texel->data, receiver.relative, receiver.normal, receiver.toLight) -
               receiver.relative;
  moved -= toLight * (dot(receiver.normal, moved) / dot(receiver.normal, toLight));
  const auto pictured = [](vec2 pixels) { return glm::clamp(pixels, -6e4f, 6e4f) * vec2(1, -1); };
  seen.shift = pictured(pixelsAlong(debug, receiver, moved));
  seen.texelU = pictured(edges.u / scale);
  seen.texelV = pictured(edges.v / scale);
  seen.tile = texel->tile;
  return seen;
}

} // namespace gnomon::cpu::truth
