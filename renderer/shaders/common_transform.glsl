layout(std140, binding = GNOMON_FRAME_BUFFER) uniform FrameBuffer { FrameData frame; };

layout(location = GNOMON_POSITION) in vec3 position;
layout(location = GNOMON_INSTANCE_ROWS) in vec4 instanceRows[3];

vec3 relativeFromLocal(vec3 local) {
  vec4 p = vec4(local, 1.0);
  return vec3(dot(instanceRows[0], p), dot(instanceRows[1], p), dot(instanceRows[2], p));
}
