layout(std430, binding = GNOMON_FRAME_BUFFER) readonly buffer FrameBuffer { FrameData frame; };
layout(std430, binding = GNOMON_INSTANCE_BUFFER) readonly buffer InstanceBuffer { InstanceData instances[]; };

// Draw data: instance, first cluster slot, material.
layout(location = GNOMON_POSITION) in vec3 position;
layout(location = GNOMON_DRAW) in uvec4 draw;

vec3 relativeFromLocal(vec3 local) {
  vec4 p = vec4(local, 1.0);
  return vec3(dot(instances[draw.x].relativeFromLocal[0], p), dot(instances[draw.x].relativeFromLocal[1], p),
              dot(instances[draw.x].relativeFromLocal[2], p));
}
