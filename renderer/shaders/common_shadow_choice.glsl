// Which of a light's tiles serve a receiver.
struct TileChoice {
  int first;   // among the light's tiles
  int second;  // blended in; = first where there is none
  float blend; // share of the second
  float fade;  // share of "lit" at the far end of a manual range
  bool covered;
};

// The first cascade that reaches as far as the view depth; none before the first one begins.
TileChoice chooseCascade(int light, float viewDepth) {
  int last = int(lights[light].tileCount) - 1;
  int index = 0;
  uint tile = lights[light].firstTile;
  bool begun = viewDepth >= tiles[tile].near;
  float blendNear = tiles[tile].blendNear;
  float far = tiles[tile].far;
  for (int i = 1; i < TILE_COUNT; ++i) {
    if (i <= last && viewDepth > far) {
      index = i;
      blendNear = tiles[tile + i].blendNear;
      far = tiles[tile + i].far;
    }
  }
  float zone = far > blendNear ? smoothstep(blendNear, far, viewDepth) : 0.0;
  bool fades = lights[light].fadesOut != 0u;
  if (index < last) return TileChoice(index, zone > 0.0 ? index + 1 : index, zone, 0.0, begun);
  return TileChoice(index, index, 0.0, fades ? zone : 0.0, begun && (!fades || viewDepth <= far));
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
