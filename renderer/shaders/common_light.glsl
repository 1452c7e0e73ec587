// Irradiance on a surface that faces the light, and where the light is.
// Range and cone as in KHR_lights_punctual.
vec3 irradiance(LightData light, vec3 relative, out vec3 toLight) {
  int type = int(light.direction.w);
  if (type == GNOMON_DIRECTIONAL) {
    toLight = light.direction.xyz;
    return light.radiance.rgb;
  }
#ifdef PUNCTUAL
  vec3 offset = light.position.xyz - relative;
  float squared = max(dot(offset, offset), 1e-8);
  toLight = offset * inversesqrt(squared);
  float attenuation = 1.0 / squared;
  if (light.position.w > 0.0) {
    float ratio = squared / (light.position.w * light.position.w);
    attenuation *= clamp(1.0 - ratio * ratio, 0.0, 1.0);
  }
  if (type == GNOMON_SPOT) {
    float falloff = clamp(dot(light.direction.xyz, -toLight) * light.cone.x + light.cone.y, 0.0, 1.0);
    attenuation *= falloff * falloff;
  }
  return light.radiance.rgb * attenuation;
#else
  return vec3(0.0);
#endif
}
