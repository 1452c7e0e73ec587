// The light around a scene where `ambient` is 1: a neutral studio, with lamps or even. White paper that faces up shows
// as 1 in both. Directions are of unit length; `turn` as inEnvironment has it.

// A world direction in those of the surroundings. `turn`: cosine and sine of their turn about the vertical axis.
GNOMON_FUNCTION vec3 inEnvironment(vec3 direction, vec2 turn) {
  return vec3(turn.x * direction.x + turn.y * direction.z, direction.y, turn.x * direction.z - turn.y * direction.x);
}

// Irradiance over pi of the even studio. `up`: height of the direction that is faced, +1 straight up. Spherical
// harmonics to the second band, of which only those around the axis are not 0 (Ramamoorthi and Hanrahan, "An Efficient
// Representation for Irradiance Environment Maps", 2001).
GNOMON_FUNCTION Real irradianceOfEvenStudio(Real up) {
  return 0.547f + up * (0.3034f + up * 0.1534f);
}

// A floor that sends light back, walls that brighten upwards, a wide lamp overhead. `spread`: of their borders.
GNOMON_FUNCTION Real radianceOfRoom(Real up, Real spread) {
  Real below = mix(0.34f, 0.42f, max(-up, 0.0f));
  Real walls = mix(0.50f, 0.72f, max(up, 0.0f));
  Real sides = mix(below, walls, smoothstep(-spread, spread, up));
  return mix(sides, 1.4256f, smoothstep(0.72f - spread, 0.72f + spread, up));
}

// The same room all around. Its borders widen with roughness (perceptual) as the reflection lobe does, until at 1 the
// lobe sees as much as a diffuse surface: within 0.12 of the integral over a GGX lobe along the mirrored direction.
GNOMON_FUNCTION Real radianceOfEvenStudio(Real up, Real roughness) {
  Real sharp = radianceOfRoom(up, 0.06f + 1.9f * roughness * roughness);
  return mix(sharp, irradianceOfEvenStudio(up), roughness * roughness);
}

// A flat lamp: `halfWidth` and `halfHeight` at a distance of 1, along `across` and `upwards`.
GNOMON_FUNCTION Real seenOfLamp(vec3 direction, vec3 towards, vec3 across, vec3 upwards, Real halfWidth,
                                Real halfHeight, Real spread) {
  Real ahead = dot(direction, towards);
  Real beside = halfWidth * ahead - abs(dot(direction, across));
  Real over = halfHeight * ahead - abs(dot(direction, upwards));
  return smoothstep(-spread, spread, beside) * smoothstep(-spread, spread, over);
}

// Irradiance over pi of the studio with lamps: spherical harmonics to the second band, within 0.04.
GNOMON_FUNCTION Real irradianceOfLamps(vec3 normal) {
  Real x = normal.x, y = normal.y, z = normal.z;
  Real first = x * 0.09985f + y * 0.41539f + z * -0.04948f;
  Real second = x * y * 0.11674f + y * z * -0.03791f + z * x * 0.10518f + y * y * 0.00736f + (x * x - z * z) * 0.05892f;
  return first + second + 0.57725f;
}

// A dimmer room with three lamps as photographers place them: a large one beside the usual sun, a tall one across from
// it, a wide one behind. Spreads and the share of what is diffuse were fitted to integrals over GGX lobes, which they
// meet within 0.25, and 0.05 in the mean.
GNOMON_FUNCTION Real radianceOfLamps(vec3 direction, Real roughness) {
  Real rough2 = roughness * roughness;
  Real spread = 0.03f + 2.415f * rough2;
  Real key = seenOfLamp(direction, vec3(0.7686f, 0.5299f, 0.3584f), vec3(0.4226f, 0.0f, -0.9063f),
                        vec3(-0.4803f, 0.8480f, -0.2240f), 0.5f, 0.42f, spread);
  Real fill = seenOfLamp(direction, vec3(-0.9101f, 0.4067f, -0.0796f), vec3(-0.0872f, 0.0f, 0.9962f),
                         vec3(0.4052f, 0.9135f, 0.0354f), 0.22f, 0.6f, spread);
  Real rim = seenOfLamp(direction, vec3(0.1504f, 0.5f, -0.8529f), vec3(-0.9848f, 0.0f, -0.1736f),
                        vec3(-0.0868f, 0.8660f, 0.4924f), 0.75f, 0.22f, spread);
  Real lamps = (2.4842f * key + 2.0184f * (fill + rim)) / (1.0f + 0.208f * spread * spread);
  Real sharp = 0.48132f * radianceOfRoom(direction.y, 0.06f + 1.1115f * rough2) + lamps;
  return mix(sharp, irradianceOfLamps(direction), rough2 / sqrt(max(roughness, 1e-4f)));
}

// `lamps`: 0 = the even studio.
GNOMON_FUNCTION Real irradianceOfStudio(vec3 normal, vec2 turn, uint lamps) {
  if (lamps == 0u) return irradianceOfEvenStudio(normal.y);
  return irradianceOfLamps(inEnvironment(normal, turn));
}

// Mean radiance over a GGX lobe about a direction. `roughness` is perceptual, 0..1.
GNOMON_FUNCTION Real radianceOfStudio(vec3 direction, vec2 turn, uint lamps, Real roughness) {
  if (lamps == 0u) return radianceOfEvenStudio(direction.y, roughness);
  return radianceOfLamps(inEnvironment(direction, turn), roughness);
}
