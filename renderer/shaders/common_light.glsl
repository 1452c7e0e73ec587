// Irradiance on a surface that faces the light, and where the light is.
// Range and cone as in KHR_lights_punctual.
vec3 irradiance(LightData light, vec3 relative, out vec3 toLight) {
  int type = light.type;
  if (type == GNOMON_DIRECTIONAL) {
    toLight = light.direction;
    return light.radiance;
  }
#ifdef PUNCTUAL
  vec3 offset = light.position - relative;
  float squared = max(dot(offset, offset), 1e-8);
  toLight = offset * inversesqrt(squared);
  float attenuation = 1.0 / squared;
  if (light.range > 0.0) {
    float ratio = squared / (light.range * light.range);
    attenuation *= clamp(1.0 - ratio * ratio, 0.0, 1.0);
  }
  if (type == GNOMON_SPOT) {
    float falloff = clamp(dot(light.direction, -toLight) * light.coneScale + light.coneOffset, 0.0, 1.0);
    attenuation *= falloff * falloff;
  }
  return light.radiance * attenuation;
#else
  return vec3(0.0);
#endif
}
