// The light around a scene where `ambient` is 1: a neutral studio, the same all around. `up`: height of a unit
// direction, +1 straight up.

// Irradiance over pi: 1 on what faces up. Spherical harmonics to the second band, of which only those around the axis
// are not 0 (Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps", 2001).
GNOMON_FUNCTION Real irradianceAround(Real up) {
  return 0.547f + up * (0.3034f + up * 0.1534f);
}

// A floor that sends light back, walls that brighten upwards, a wide lamp overhead. Its borders widen with roughness
// (perceptual) as the reflection lobe does, until at 1 the lobe sees as much as a diffuse surface: within 0.12 of the
// integral over a GGX lobe along the mirrored direction.
GNOMON_FUNCTION Real radianceAround(Real up, Real roughness) {
  Real spread = 0.06f + 1.9f * roughness * roughness;
  Real below = mix(0.34f, 0.42f, max(-up, 0.0f));
  Real walls = mix(0.50f, 0.72f, max(up, 0.0f));
  Real sides = mix(below, walls, smoothstep(-spread, spread, up));
  Real sharp = mix(sides, 1.4256f, smoothstep(0.72f - spread, 0.72f + spread, up));
  return mix(sharp, irradianceAround(up), roughness * roughness);
}
