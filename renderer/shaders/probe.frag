#include "shared/frame_types.h"
layout(std140, binding = GNOMON_FRAME_BUFFER) uniform FrameBuffer { FrameData frame; };
layout(std430, binding = GNOMON_PROBE_BUFFER) readonly buffer ProbeBuffer { ProbeData probes[]; };

// The pixel of the picture that shows the point; the target of this shader is no picture.
vec2 shadedPixel;
#define SHADED_PIXEL shadedPixel
#include "common_shadow.glsl"
#include "common_names.glsl"
#include "shared/light.h"

layout(location = GNOMON_DEBUG_LIGHT) uniform int debugLight;
layout(location = 0) out float visibility;

Receiver receiverOf(ProbeData probe) {
#ifdef RECEIVER_GROUPS
  return Receiver(probe.relative.xyz, probe.normal.xyz, probe.relative.w, 1u << uint(probe.normal.w));
#else
  return Receiver(probe.relative.xyz, probe.normal.xyz, probe.relative.w);
#endif
}

void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  ProbeData probe = probes[place.y * GNOMON_PROBE_COLUMNS + place.x];
  vec4 clip = frame.clipFromRelative * vec4(probe.relative.xyz, 1.0);
  shadedPixel = floor((clip.xy / clip.w + 1.0) / frame.pixelStep) + 0.5;
  vec3 toLight;
  irradiance(lights[debugLight], probe.relative.xyz, toLight);
  visibility = shadowVisibility(debugLight, receiverOf(probe), toLight, true);
}
