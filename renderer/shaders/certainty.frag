#include "shared/frame_types.h"
#include "common_surface.glsl"
#include "common_surface_read.glsl"
#include "common_shadow_lookup.glsl"
#include "common_shadow_choice.glsl"
#include "common_names.glsl"
#include "shared/light.h"

// Whether the shadow map of one light knows what arrives at a pixel (Verdict of renderer/techniques/traced_shadow.h).
//
// Seen from the light, the casters are sheets of surface. A sheet begins and ends at outlines alone, and the map's outlines
// (renderer/prepare/outlines.h) mark every cell between four texels that one passes through. Where none does, the
// sheets over a receiver lie over the four texels around it, too, so that four depths tell whether one of them lies
// before the receiver; a line along which two sheets cross leaves at least one texel on the receiver's side of it.
//  - none before the receiver's own plane: lit;
//  - all before it by more than the receiver's own sheet may bend within the cell: in shadow;
//  - else the sheet is too near, or it and the receiver cross: not sure.
// No bias is needed: a plane is held against each texel at that texel's place.
layout(binding = GNOMON_ATLAS_UNIT) uniform sampler2D atlasDepths;
layout(binding = GNOMON_OUTLINES_UNIT) uniform sampler2D outlines;
layout(location = GNOMON_DEBUG_LIGHT) uniform int light;
layout(location = 0) out float verdict;

const float kLit = 1.0;
const float kShadow = 0.0;
const float kTurnedAway = 64.0 / 255.0;
const float kUnsure = 128.0 / 255.0;

// How much depths change along a surface with each length across, at most, where no outline is near: the tangent of
// kSteepest in outlines.h, for two surfaces that lean either way, and some room.
const float kBend = 2.2 * GNOMON_STEEPEST;

float verdictOf(Sample seen) {
  if (!seen.hit) return kLit;
#ifdef RECEIVER_GROUPS
  if ((lights[light].litGroups & lights[light].shadowedGroups & (1u << receiverGroup(seen.bits))) == 0u) return kLit;
#endif
  Receiver receiver;
  receiver.relative = seen.relative;
  receiver.normal = unpackedSurface(seen.bits).face;
  receiver.viewDepth = seen.viewDepth;
#ifdef SMOOTH_PLACES
  receiver.sampleIndex = seen.index;
  receiver.lifted = false;
#endif
  vec3 toLight;
  if (irradiance(lights[light], receiver.relative, toLight) == vec3(0.0)) return kLit;
  float cosine = dot(receiver.normal, toLight);
#ifdef SMOOTH_PLACES
  if (shadedReceiver(lights[light], receiver, toLight) != receiver) return kUnsure;
#endif
  if (cosine < -1e-3) return kTurnedAway;
  if (cosine <= 1e-3) return kUnsure;

  TileChoice choice = chooseTile(light, receiver, toLight);
  if (!choice.covered) return kUnsure;
  TileData tile = tiles[lights[light].firstTile + uint(choice.first)];
  vec4 p = vec4(receiver.relative, 1.0);
  vec3 at = vec3(dot(tile.atlasFromRelative[0], p), dot(tile.atlasFromRelative[1], p), dot(tile.atlasFromRelative[2], p));
  // z that one length across is worth, along the light.
  float perLength = dot(tile.atlasFromRelative[2].xyz, tile.axis);
  float rounding = tile.depthBias;
#ifdef PUNCTUAL
  if (!isParallel(tile)) {
    float divisor = dot(tile.atlasFromRelative[3], p);
    if (divisor <= 0.0) return kUnsure;
    at /= divisor;
    perLength = tile.near * tile.far / ((tile.far - tile.near) * divisor);
    rounding += tile.depthBiasNear / (divisor * divisor);
  }
#endif
  if (any(lessThan(at.xy, tile.lowest)) || any(greaterThan(at.xy, tile.highest))) return kUnsure;
  vec2 size = vec2(textureSize(atlasDepths, 0));
  ivec2 cell = ivec2(floor(at.xy * size - 0.5));
  if (texelFetch(outlines, cell, 0).r > 0.0) return kUnsure;

  float tangent = sqrt(max(1.0 - cosine * cosine, 0.0)) / cosine;
  // A steep surface has an outline along all of its edges: away from them it is a plane.
  float bend = tangent > GNOMON_STEEPEST ? 0.0 : kBend * perLength;
#ifdef PUNCTUAL
  if (!isParallel(tile)) bend += 2.0 * perLength; // depth is told along the tile's axis, slopes along the ray
#endif
  float unevenness = 2e-4 * (1.0 + tangent * tangent) * perLength; // of a normal of 16 bits an axis
  vec2 slope = receiverSlope(tile, receiver, lights[light].position);
  bool lit = true;
  bool shadow = true;
  for (int y = 0; y <= 1; ++y) {
    for (int x = 0; x <= 1; ++x) {
      ivec2 texel = cell + ivec2(x, y);
      vec2 across = vec2(texel) + 0.5 - at.xy * size;
      float apart = length(across / (tile.atlasPerMetre * size));
      float plane = at.z + dot(slope, across);
      float depth = texelFetch(atlasDepths, texel, 0).r;
      float slack = rounding + unevenness * apart;
      // What lies before the map's first depth is drawn at 0: there it can't be told from a receiver.
      lit = lit && depth > 0.0 && min(plane, 1.0) - depth <= slack;
      shadow = shadow && plane - depth > slack + bend * apart;
    }
  }
  return lit ? kLit : shadow ? kShadow : kUnsure;
}

void main() {
#if SAMPLES > 1
  uint all = (1u << SAMPLES) - 1u;
  uint same;
  Sample seen = mergedSample(all, same);
  verdict = same == all ? verdictOf(seen) : kUnsure;
#else
  verdict = verdictOf(sampleAt(0));
#endif
}
