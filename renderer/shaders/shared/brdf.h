// How much light a surface reflects to the eye.
GNOMON_CONSTANT(kPi, 3.14159265358979f);

struct SurfacePoint {
  vec3 albedo; // of the diffuse part
  vec3 f0;     // reflectance at normal incidence
  Real alpha;  // roughness squared
  vec3 normal; // shading normal
  vec3 toEye;
};

// `roughness` is perceptual.
GNOMON_FUNCTION SurfacePoint surfacePoint(vec3 baseColor, Real metallic, Real roughness, vec3 normal, vec3 toEye) {
  SurfacePoint s;
  s.albedo = baseColor * (1.0f - metallic);
  s.f0 = mix(vec3(0.04f), baseColor, metallic);
  s.alpha = max(roughness * roughness, 0.002f);
  s.normal = normal;
  s.toEye = toEye;
  return s;
}

// Lambert and GGX with height-correlated Smith visibility (Walter et al. 2007; Heitz, JCGT 2014) and Schlick's Fresnel
// term (1994), times the cosine: radiance out for a unit of irradiance facing the light.
GNOMON_FUNCTION vec3 reflectedRadiance(SurfacePoint s, vec3 toLight) {
  Real nl = dot(s.normal, toLight);
  Real nv = max(dot(s.normal, s.toEye), 1e-4f);
  vec3 h = normalize(toLight + s.toEye);
  Real nh = clamp(dot(s.normal, h), 0.0f, 1.0f);
  Real vh = clamp(dot(s.toEye, h), 0.0f, 1.0f);
  Real a2 = s.alpha * s.alpha;
  Real d = nh * nh * (a2 - 1.0f) + 1.0f;
  Real distribution = a2 / (kPi * d * d);
  Real masking = 0.5f / (nl * sqrt(nv * nv * (1.0f - a2) + a2) + nv * sqrt(nl * nl * (1.0f - a2) + a2));
  Real grazing = 1.0f - vh;
  Real grazing2 = grazing * grazing;
  vec3 fresnel = s.f0 + (1.0f - s.f0) * (grazing2 * grazing2 * grazing);
  vec3 reflected = ((1.0f - fresnel) * s.albedo * (1.0f / kPi) + fresnel * (distribution * masking)) * nl;
  return select(nl <= 0.0f, vec3(0.0f), reflected);
}
