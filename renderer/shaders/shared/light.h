// Irradiance on a surface that faces the light, and where the light is.
// Range and cone as in KHR_lights_punctual.
GNOMON_FUNCTION vec3 irradiance(LightData light, vec3 relative, GNOMON_OUT(vec3) toLight) {
  int type = light.type;
  if (type == GNOMON_DIRECTIONAL) {
    toLight = vec3(light.direction);
    return vec3(light.radiance);
  }
#ifdef PUNCTUAL
  vec3 offset = vec3(light.position) - relative;
  Real squared = max(dot(offset, offset), 1e-8f);
  toLight = offset * inversesqrt(squared);
  Real attenuation = 1.0f / squared;
  if (light.range > 0.0f) {
    Real ratio = squared / (light.range * light.range);
    attenuation *= clamp(1.0f - ratio * ratio, 0.0f, 1.0f);
  }
  if (type == GNOMON_SPOT) {
    Real falloff = clamp(dot(vec3(light.direction), -toLight) * light.coneScale + light.coneOffset, 0.0f, 1.0f);
    attenuation *= falloff * falloff;
  }
  return vec3(light.radiance) * attenuation;
#else
  return vec3(0.0f);
#endif
}
