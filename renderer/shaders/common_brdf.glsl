#include "shared/surroundings.h"

const float kPi = 3.14159265358979;

struct SurfacePoint {
  vec3 albedo;     // of the diffuse part
  vec3 f0;         // reflectance at normal incidence
  float alpha;     // roughness squared
  vec3 normal;     // shading normal
  vec3 toEye;
};

SurfacePoint surfacePoint(Surface surface, vec3 toEye) {
  float alpha = max(surface.roughness * surface.roughness, 0.002);
  return SurfacePoint(surface.baseColor * (1.0 - surface.metallic), mix(vec3(0.04), surface.baseColor, surface.metallic),
                      alpha, surface.normal, toEye);
}

// Lambert and GGX with height-correlated Smith visibility (Walter et al. 2007; Heitz, JCGT 2014) and Schlick's Fresnel
// term (1994), times the cosine: radiance out for a unit of irradiance facing the light.
vec3 reflectedRadiance(SurfacePoint s, vec3 toLight) {
  float nl = dot(s.normal, toLight);
  if (nl <= 0.0) return vec3(0.0);
  float nv = max(dot(s.normal, s.toEye), 1e-4);
  vec3 h = normalize(toLight + s.toEye);
  float nh = clamp(dot(s.normal, h), 0.0, 1.0);
  float vh = clamp(dot(s.toEye, h), 0.0, 1.0);
  float a2 = s.alpha * s.alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float distribution = a2 / (kPi * d * d);
  float masking = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
  float grazing = 1.0 - vh;
  float grazing2 = grazing * grazing;
  vec3 fresnel = s.f0 + (1.0 - s.f0) * (grazing2 * grazing2 * grazing);
  return ((1.0 - fresnel) * s.albedo / kPi + fresnel * (distribution * masking)) * nl;
}

// What a surface shows of the surroundings: Lambert, and the split-sum fit of Karis, "Physically Based Shading on
// Mobile", 2014.
vec3 ambientReflected(SurfacePoint s) {
  float roughness = sqrt(s.alpha);
  float nv = clamp(dot(s.normal, s.toEye), 0.0, 1.0);
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a004 = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
  vec2 scaleBias = vec2(-1.04, 1.04) * a004 + r.zw;
  vec3 mirrored = reflect(-s.toEye, s.normal);
  return s.albedo * irradianceAround(s.normal.y) +
         (s.f0 * scaleBias.x + scaleBias.y) * radianceAround(mirrored.y, roughness);
}
