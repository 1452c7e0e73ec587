#ifdef FRAGMENT_STAGE
#define STAGE_IO in
#else
#define STAGE_IO out
#endif

STAGE_IO SurfaceVaryings {
  vec3 relative;
  vec3 normal;
#ifdef SMOOTH_PLACES
  vec4 vertex; // xyz: the vertex's normal, unit length; w: its place along that
#endif
#ifdef TANGENTS
  vec4 tangent;
#endif
#ifdef UV0
  vec2 uv0;
#endif
#ifdef UV1
  vec2 uv1;
#endif
#ifdef VERTEX_COLORS
  vec4 color;
#endif
#ifdef RECEIVER_GROUPS
  flat uint receiverGroup;
#endif
#ifdef TRIANGLE_NUMBERS
  flat uint firstTriangle; // number of the draw's first
#endif
#if defined(SHOWN_SAMPLES) && defined(GL_ARB_post_depth_coverage)
  vec2 mapPlace;
#elif defined(BAKED_LIGHTS)
  centroid vec2 mapPlace; // within the triangle, even where the pixel's middle is not
#endif
} surface;
