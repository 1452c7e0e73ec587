// The surfaces of a frame, read back: what each sample of this pixel shows, and where.
layout(std140, binding = GNOMON_FRAME_BUFFER) uniform FrameBuffer { FrameData frame; };

#if SAMPLES > 1
#define SURFACE_FLOATS sampler2DMS
#define SURFACE_WORDS usampler2DMS
#else
#define SURFACE_FLOATS sampler2D
#define SURFACE_WORDS usampler2D
#endif
layout(binding = GNOMON_DEPTH_UNIT) uniform SURFACE_FLOATS surfaceDepths;
layout(binding = GNOMON_SURFACE_UNIT) uniform SURFACE_WORDS surfaceBits;
#ifdef SMOOTH_PLACES
layout(binding = GNOMON_SMOOTH_UNIT) uniform SURFACE_WORDS surfaceSmooth;
#endif
#ifdef EMISSION
layout(binding = GNOMON_EMISSION_UNIT) uniform SURFACE_FLOATS surfaceEmission;
#endif

// Where the samples lie in a pixel, 0..1.
layout(location = GNOMON_SAMPLE_POSITIONS) uniform vec2 samplePositions[SAMPLES];

struct Sample {
  bool hit; // false: the background
  int index;
  uvec4 bits;      // of a Surface
  vec3 relative;   // to the eye
  float viewDepth; // metres
};

Sample sampleOf(ivec2 pixel, int index) {
  Sample s;
  s.index = index;
  float depth = texelFetch(surfaceDepths, pixel, index).r;
  s.hit = depth > 0.0;
  s.bits = texelFetch(surfaceBits, pixel, index);
  vec2 ndc = (vec2(pixel) + samplePositions[index]) * frame.pixelStep - 1.0;
  // From depth, reversed, to metres: the inverse of the projection's two terms (renderer/core/camera_view.cpp).
  bool perspective = frame.perspective != 0u;
  vec2 terms = frame.depthTerms;
  s.viewDepth = perspective ? terms.y / (depth + terms.x) : (terms.y - depth) / terms.x;
  vec3 across = frame.right * ndc.x + frame.up * ndc.y;
  s.relative = frame.middle * s.viewDepth + across * (perspective ? s.viewDepth : 1.0);
  return s;
}

Sample sampleAt(int index) { return sampleOf(ivec2(gl_FragCoord.xy), index); }

// rgb: radiance; w: 1 = unlit, 2 = catches shadows.
vec4 emissionAt(int index) {
#ifdef EMISSION
  return texelFetch(surfaceEmission, ivec2(gl_FragCoord.xy), index);
#else
  return vec4(0.0);
#endif
}

#if SAMPLES > 1
// Largest difference between two octahedral normals that light tells apart no more than an eye does: about 2 degrees.
const float kNormalStep = 0.03;

// Two samples of a pixel that light treats as one: normals, colors, what they give off and the rest of the material within
// steps too small to see, and half a pixel at most between their planes. Compared as they are stored; where the
// octahedron folds, close normals may pass for different ones, which costs time and nothing else.
bool alike(Sample a, Sample b) {
  if (!a.hit || !b.hit) return a.hit == b.hit;
#ifdef RECEIVER_GROUPS
  if (receiverGroup(a.bits) != receiverGroup(b.bits)) return false;
#endif
#ifdef EMISSION
  vec4 glowA = emissionAt(a.index);
  vec4 glowB = emissionAt(b.index);
  if (any(greaterThan(abs(glowA - glowB), 0.02 * max(glowA, glowB)))) return false;
#endif
  vec4 normals = abs(vec4(unpackSnorm2x16(a.bits.x) - unpackSnorm2x16(b.bits.x),
                          unpackSnorm2x16(a.bits.y) - unpackSnorm2x16(b.bits.y)));
  vec3 color = abs(rootColor(a.bits.z) - rootColor(b.bits.z));
  vec3 rest = abs(unpackUnorm4x8(a.bits.w).xyz - unpackUnorm4x8(b.bits.w).xyz);
  float pixel = frame.pixelHeight * (frame.perspective != 0u ? a.viewDepth : 1.0);
  float apart = abs(dot(fromOctahedral(unpackSnorm2x16(a.bits.x)), a.relative - b.relative));
  return all(lessThan(normals, vec4(kNormalStep))) && all(lessThan(color, vec3(0.01))) &&
         all(lessThan(rest, vec3(0.02))) && apart < 0.5 * pixel;
}

// The first of the samples in `left` (a bit each), moved to the middle of those of them that are alike: `same`.
Sample mergedSample(uint left, out uint same) {
  Sample first = sampleAt(findLSB(left));
  vec4 middle = vec4(0.0);
  same = 0u;
  for (int i = 0; i < SAMPLES; ++i) {
    Sample other = sampleAt(i);
    bool joins = i == first.index || ((left & (1u << i)) != 0u && alike(first, other));
    if (!joins) continue;
    same |= 1u << i;
    middle += vec4(other.relative, other.viewDepth);
  }
  middle /= float(bitCount(same));
  first.relative = middle.xyz;
  first.viewDepth = middle.w;
  return first;
}
#endif
