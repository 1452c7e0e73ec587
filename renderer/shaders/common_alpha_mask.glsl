// What a masked surface leaves out: the same test for the eye and for the light.
#ifdef ALPHA_MASK
layout(std430, binding = GNOMON_MATERIAL_BUFFER) readonly buffer MaterialBuffer { MaterialData materials[]; };
layout(binding = GNOMON_BASE_COLOR_UNIT) uniform sampler2D baseColorTexture;
layout(location = GNOMON_MATERIAL) uniform int materialIndex;
in MaskVertex {
  vec2 uv;
  float alpha;
} mask;

void discardMasked() {
  MaterialData material = materials[materialIndex];
  float alpha = material.baseColorFactor.a * mask.alpha;
#ifdef BASE_COLOR_TEXTURE
  alpha *= texture(baseColorTexture, mask.uv).a;
#endif
  if (alpha < material.emissiveFactor.w) discard;
}
#else
void discardMasked() {}
#endif
