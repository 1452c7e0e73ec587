// Which of a light's tiles serve a receiver.
#include "shared/tile_choice.h"

// The first cascade that reaches as far as the view depth; none before the first one begins.
TileChoice chooseCascade(int light, float viewDepth) {
  int last = int(lights[light].tileCount) - 1;
  int index = 0;
  uint tile = lights[light].firstTile;
  float blendNear = tiles[tile].blendNear;
  float far = tiles[tile].far;
  for (int i = 1; i < TILE_COUNT; ++i) {
    if (i <= last && viewDepth > far) {
      index = i;
      blendNear = tiles[tile + i].blendNear;
      far = tiles[tile + i].far;
    }
  }
  return cascadeChoice(lights[light], index, blendNear, far, tiles[tile].near, viewDepth);
}

#ifdef PUNCTUAL
// The face that looks most nearly along the light's way to the point.
TileChoice chooseFace(int light, vec3 toLight) {
  int best = 0;
  float most = -2.0;
  for (int i = 0; i < TILE_COUNT; ++i) {
    float along = -dot(tiles[lights[light].firstTile + i].axis, toLight);
    if (i < int(lights[light].tileCount) && along > most) {
      most = along;
      best = i;
    }
  }
  return TileChoice(best, best, 0.0, 0.0, true);
}
#endif

TileChoice chooseTile(int light, Receiver receiver, vec3 toLight) {
#ifdef PUNCTUAL
  if (lights[light].type != GNOMON_DIRECTIONAL) return chooseFace(light, toLight);
#endif
  return chooseCascade(light, receiver.viewDepth);
}
