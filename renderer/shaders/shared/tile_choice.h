// Which of a light's tiles serve a receiver.
struct TileChoice {
  Whole first;   // among the light's tiles
  Whole second;  // blended in; = first where there is none
  Real blend;    // share of the second
  Real fade;     // share of "lit" at the far end of a manual range
  Truth covered; // whether some tile serves it
};

// By cascade `index`, the first that reaches as far as the view depth: it ends at `far` and begins to blend at
// `blendNear`. `nearest`: where the light's first cascade begins.
GNOMON_FUNCTION TileChoice cascadeChoice(LightData light, Whole index, Real blendNear, Real far, Real nearest,
                                         Real viewDepth) {
  int last = int(light.tileCount) - 1;
  Truth isLast = index == last;
  Real zone = select(far > blendNear, smoothstep(blendNear, far, viewDepth), Real(0.0f));
  TileChoice choice;
  choice.first = index;
  choice.second = select(both(zone > 0.0f, index < last), index + 1, index);
  choice.blend = select(isLast, Real(0.0f), zone);
  choice.fade = Real(0.0f);
  choice.covered = viewDepth >= nearest;
  if (light.fadesOut != 0u) {
    choice.fade = select(isLast, zone, Real(0.0f));
    choice.covered = both(choice.covered, viewDepth <= select(isLast, far, viewDepth));
  }
  return choice;
}
