#ifdef ALPHA_MASK
layout(location = GNOMON_UV0) in vec2 uv0;
layout(location = GNOMON_UV1) in vec2 uv1;
layout(location = GNOMON_COLOR) in vec4 color;
out MaskVertex {
  vec2 uv;
#ifdef VERTEX_COLORS
  float alpha;
#endif
} mask;

void passMask() {
#ifdef BASE_COLOR_UV1
  mask.uv = uv1;
#else
  mask.uv = uv0;
#endif
#ifdef VERTEX_COLORS
  mask.alpha = color.a;
#endif
}
#else
void passMask() {}
#endif
