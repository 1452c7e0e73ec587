#include "shared/frame_types.h"
#include "common_transform.glsl"

layout(location = GNOMON_NORMAL) in vec3 normal;
layout(location = GNOMON_TANGENT) in vec4 tangent;
layout(location = GNOMON_UV0) in vec2 uv0;
layout(location = GNOMON_UV1) in vec2 uv1;
layout(location = GNOMON_COLOR) in vec4 color;

invariant gl_Position;
#include "common_surface_varyings.glsl"

layout(location = GNOMON_NORMAL_ROWS) in vec4 normalRows[3];

#ifdef BAKED_LIGHTS
layout(location = GNOMON_MAP_PLACE) in vec2 mapPlace;
#endif

vec3 turned(vec3 v) { return vec3(dot(normalRows[0].xyz, v), dot(normalRows[1].xyz, v), dot(normalRows[2].xyz, v)); }

void main() {
  vec3 relative = relativeFromLocal(position);
  gl_Position = frame.clipFromRelative * vec4(relative, 1.0);
  surface.relative = relative;
  surface.normal = turned(normal);
#ifdef SMOOTH_PLACES
  vec3 own = normalize(surface.normal);
  surface.vertex = vec4(own, dot(own, relative));
#endif
#ifdef TANGENTS
  surface.tangent = vec4(relativeFromLocal(position + tangent.xyz) - relative, tangent.w);
#endif
#ifdef UV0
  surface.uv0 = uv0;
#endif
#ifdef UV1
  surface.uv1 = uv1;
#endif
#ifdef VERTEX_COLORS
  surface.color = color;
#endif
#ifdef RECEIVER_GROUPS
  surface.receiverGroup = uint(normalRows[0].w);
#endif
#ifdef TRIANGLE_NUMBERS
  surface.firstTriangle = uint(normalRows[1].w);
#endif
#ifdef BAKED_LIGHTS
  surface.mapPlace = mapPlace;
#endif
}
