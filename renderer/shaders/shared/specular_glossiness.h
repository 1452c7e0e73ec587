// KHR_materials_pbrSpecularGlossiness as metallic-roughness.

GNOMON_FUNCTION Real perceivedBrightness(vec3 color) {
  return sqrt(dot(color * color, vec3(0.299f, 0.587f, 0.114f)));
}

// The share of metal with which metallic-roughness shows the same diffuse and specular color, as far as it can: the
// larger root of the quadratic in it that both colors' brightness give (Khronos, "Convert between workflows", appendix
// of KHR_materials_pbrSpecularGlossiness).
GNOMON_FUNCTION Real metallicOf(vec3 diffuse, vec3 specular) {
  const float dielectric = 0.04f;
  Real s = perceivedBrightness(specular);
  Real b = perceivedBrightness(diffuse) * (1.0f - max(max(specular.x, specular.y), specular.z)) / (1.0f - dielectric) +
           s - 2.0f * dielectric;
  Real share =
      clamp((-b + sqrt(max(b * b - 4.0f * dielectric * (dielectric - s), 0.0f))) / (2.0f * dielectric), 0.0f, 1.0f);
  return select(s < dielectric, Real(0.0f), share);
}

// The base color of the surface, given its metallicOf.
GNOMON_FUNCTION vec3 baseColorOf(vec3 diffuse, vec3 specular, Real metallic) {
  Real left = 1.0f - max(max(specular.x, specular.y), specular.z);
  vec3 ofDiffuse = diffuse * (left / (1.0f - 0.04f) / max(1.0f - metallic, 1e-4f));
  vec3 ofSpecular = (specular - 0.04f * (1.0f - metallic)) / max(metallic, 1e-4f);
  return clamp(mix(ofDiffuse, ofSpecular, metallic * metallic), 0.0f, 1.0f);
}
