// Which lights may reach the surfaces at this pixel.
#ifdef LIGHT_LISTS
layout(std430, binding = GNOMON_LIGHT_LIST_BUFFER) readonly buffer LightListBuffer { uint lightLists[]; };

// First place and the one after the last.
uvec2 lightList() {
  vec2 frameSize = 2.0 / frame.pixelStep;
  uvec2 region = uvec2(gl_FragCoord.x, frameSize.y - gl_FragCoord.y) / uint(GNOMON_REGION_SIZE); // rows count from the top
  uint columns = (uint(frameSize.x + 0.5) + uint(GNOMON_REGION_SIZE) - 1u) / uint(GNOMON_REGION_SIZE);
  uint at = 2u * (region.y * columns + region.x);
  return uvec2(lightLists[at], lightLists[at + 1u]);
}

int listedLight(uint place) { return int(lightLists[place]); }
#else
uvec2 lightList() { return uvec2(0u, uint(lights.length())); }

int listedLight(uint place) { return int(place); }
#endif
