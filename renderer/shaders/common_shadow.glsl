// Visibility of a light through its tiles in the shadow atlas.
#include "common_shadow_lookup.glsl"
#include "common_shadow_filter.glsl"
#include "common_shadow_disc.glsl"
#include "common_shadow_moments.glsl"

// Share of the light that one tile lets through; 1 outside of what the tile covers. The bounds leave the filter room:
// no lookup of it leaves the tile.
float tileVisibility(LightData light, TileData tile, Receiver receiver, vec3 toLight) {
  Lookup at = lookupIn(light, tile, receiver, toLight);
  if (!at.inside) return 1.0;
#ifdef FILTER_KIND
  const int kind = FILTER_KIND; // all lights have the same
#else
  int kind = int(light.sampling.x);
#endif
#ifdef FILTER_MOMENTS
  if (kind >= GNOMON_FILTER_VSM) return momentVisibility(at.coordinate.xy, momentDepth(tile, at), kind);
#endif
  at.coordinate.z = clamp(at.coordinate.z, 0.0, 1.0);
#ifdef FILTER_DISC
  if (kind == GNOMON_FILTER_DISC) return discVisibility(tile, receiver, at, light.sampling.y, light.position.xyz);
#endif
#ifdef FILTER_SIZE
  const int size = FILTER_SIZE; // all lights have the same
#else
  int size = int(light.tiles.y);
#endif
  return kernelVisibility(at.coordinate, size);
}

struct TileChoice {
  int first;   // among the light's tiles
  int second;  // blended in; = first where there is none
  float blend; // share of the second
  float fade;  // share of "lit" at the far end of a manual range
  bool covered;
};

// The first cascade that reaches as far as the view depth; none before the first one begins.
TileChoice chooseCascade(int light, float viewDepth) {
  int last = int(lights[light].tiles.x) - 1;
  int index = 0;
  vec3 interval = tiles[lights[light].tiles.z].interval.xyz;
  bool begun = viewDepth >= interval.x;
  for (int i = 1; i < TILE_COUNT; ++i) {
    if (i <= last && viewDepth > interval.z) {
      index = i;
      interval = tiles[lights[light].tiles.z + i].interval.xyz;
    }
  }
  float zone = interval.z > interval.y ? smoothstep(interval.y, interval.z, viewDepth) : 0.0;
  bool fades = lights[light].cone.w > 0.0;
  if (index < last) return TileChoice(index, zone > 0.0 ? index + 1 : index, zone, 0.0, begun);
  return TileChoice(index, index, 0.0, fades ? zone : 0.0, begun && (!fades || viewDepth <= interval.z));
}

#ifdef PUNCTUAL
// The face that looks most nearly along the light's way to the point.
TileChoice chooseFace(int light, vec3 toLight) {
  int best = 0;
  float most = -2.0;
  for (int i = 0; i < TILE_COUNT; ++i) {
    float along = -dot(tiles[lights[light].tiles.z + i].axis.xyz, toLight);
    if (i < int(lights[light].tiles.x) && along > most) {
      most = along;
      best = i;
    }
  }
  return TileChoice(best, best, 0.0, 0.0, true);
}
#endif

TileChoice chooseTile(int light, Receiver receiver, vec3 toLight) {
#ifdef PUNCTUAL
  if (int(lights[light].direction.w) != GNOMON_DIRECTIONAL) return chooseFace(light, toLight);
#endif
  return chooseCascade(light, receiver.viewDepth);
}

// `needed` false spares the lookups where no light arrives anyway.
float shadowVisibility(int light, Receiver receiver, vec3 toLight, bool needed) {
#ifdef NO_SHADOWS
  return 1.0;
#endif
  if (lights[light].tiles.x == 0u) return 1.0;
#ifdef RECEIVER_GROUPS
  if ((lights[light].groups.y & receiver.groupBit) == 0u) return 1.0;
#endif
  TileChoice choice = chooseTile(light, receiver, toLight);
  if (!choice.covered) return 1.0;
  float strength = lights[light].cone.z;
  // A face turned away from the light, or along it to within rounding, shadows itself.
  bool turnedAway = dot(receiver.normal, toLight) <= 1e-4;
  float visibility = 0.0;
  for (int i = choice.first; i <= choice.second && needed && !turnedAway; ++i) {
    float share = i == choice.first ? 1.0 - choice.blend : choice.blend;
    visibility += share * tileVisibility(lights[light], tiles[lights[light].tiles.z + i], receiver, toLight);
  }
  visibility = mix(visibility, 1.0, choice.fade);
  return mix(1.0, visibility, strength);
}

// The cascades from near to far, or a light's faces; white beyond.
const vec3 kTints[8] = vec3[8](GNOMON_TINTS_0_3, GNOMON_TINTS_4_7);

vec3 cascadeTint(int light, Receiver receiver, vec3 toLight) {
  TileChoice choice = chooseTile(light, receiver, toLight);
  if (!choice.covered) return vec3(1.0);
  return mix(mix(kTints[choice.first], kTints[choice.second], choice.blend), vec3(1.0), choice.fade);
}
