// Structs that C++ writes and GLSL reads (std430). Positions are relative to the camera's eye ("relative").
#ifdef __cplusplus
#pragma once
#include <glm/glm.hpp>
namespace gnomon::shared {
using glm::mat4;
using glm::uint;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
#else
// Samples of a pixel in the target that is drawn or read.
#ifndef SAMPLES
#define SAMPLES 1
#endif
#ifndef ATLAS_SAMPLES
#define ATLAS_SAMPLES 1
#endif
// Tiles of the light that has most of them.
#ifndef TILE_COUNT
#define TILE_COUNT GNOMON_LIGHT_TILES
#endif
#endif

// Attribute locations.
#define GNOMON_POSITION 0
#define GNOMON_NORMAL 1
#define GNOMON_TANGENT 2
#define GNOMON_UV0 3
#define GNOMON_UV1 4
#define GNOMON_COLOR 5
#define GNOMON_INSTANCE_ROWS 6 // three: InstanceData::relativeFromLocal
#define GNOMON_NORMAL_ROWS 9   // three: InstanceData::normalFromLocal
#define GNOMON_NODE 11         // w: the node's index; the last of those three
#define GNOMON_PLACE_WEIGHT 12 // of shadow volumes: the position's fourth coordinate
#define GNOMON_MAP_PLACE 13    // in light maps, 0..1

// Places of a disc that are compared, and those that are searched for casters.
#define GNOMON_DISC_TAPS 32
#define GNOMON_SEARCH_TAPS 32
#define GNOMON_GOLDEN_ANGLE 2.39996323

// Texels that a blur of moments takes along an axis, at most: wider ones take every other texel, or fewer.
#define GNOMON_BLUR_TAPS 33

// Uniform buffer bindings.
#define GNOMON_FRAME_BUFFER 0

// Storage buffer bindings; 4 is in mask_coverage.h.
#define GNOMON_MATERIAL_BUFFER 0
#define GNOMON_LIGHT_BUFFER 1
#define GNOMON_TILE_BUFFER 2
#define GNOMON_LIGHT_LIST_BUFFER 3
#define GNOMON_PROBE_BUFFER 7

// Uniform locations.
#define GNOMON_MATERIAL 0
#define GNOMON_LIGHT_CLIP 1
#define GNOMON_FRAME_SIZE 1
#define GNOMON_SAMPLE 1
#define GNOMON_SAMPLE_POSITIONS 1 // as many as there are samples
#define GNOMON_MOMENT_TILE 1
#define GNOMON_MOMENT_BLUR 2
#define GNOMON_DEBUG_LIGHT 16
#define GNOMON_ATLAS_SIZE 17

// Texture units, of which a pass has 16. Of passes that draw surfaces:
#define GNOMON_BASE_COLOR_UNIT 0
#define GNOMON_METALLIC_ROUGHNESS_UNIT 1
#define GNOMON_NORMAL_UNIT 2
#define GNOMON_OCCLUSION_UNIT 3
#define GNOMON_EMISSIVE_UNIT 4
#define GNOMON_LIGHT_MAP_UNIT 5 // and the next ones
#define GNOMON_LIGHT_MAPS 4     // that surfaces are looked up in as they are drawn
#define GNOMON_SURFACE_ENVIRONMENT_UNIT 9
// Of passes over what was drawn:
#define GNOMON_SURFACE_UNIT 0
#define GNOMON_DEPTH_UNIT 1
#define GNOMON_EMISSION_UNIT 2
#define GNOMON_SMOOTH_UNIT 3
#define GNOMON_BAKED_UNIT 4
#define GNOMON_VISIBILITY_UNIT 5
#define GNOMON_ATLAS_UNIT 6
#define GNOMON_MOMENTS_UNIT 7
#define GNOMON_VOLUMES_UNIT 8
#define GNOMON_CASTER_NODE_UNIT 9
#define GNOMON_CASTER_DEPTH_UNIT 10
#define GNOMON_ENVIRONMENT_UNIT 11
#define GNOMON_SKY_UNIT 15

// Pixels along a side of a survey block (shadow_plan.h).
#define GNOMON_BLOCK_SIZE 8

// Pixels along a side of the squares of the picture that have a list of lights each; whole blocks.
#define GNOMON_REGION_SIZE 64

// Probes in a row of their target.
#define GNOMON_PROBE_COLUMNS 256

// Tiles of a light, at most.
#define GNOMON_LIGHT_TILES 8

// What a light's tiles are tinted with, linear RGB: green, blue, purple, red, orange, cyan, yellow, pink.
#define GNOMON_TINTS_0_3 vec3(0.35, 1.0, 0.35), vec3(0.35, 0.5, 1.0), vec3(0.8, 0.35, 1.0), vec3(1.0, 0.3, 0.3)
#define GNOMON_TINTS_4_7 vec3(1.0, 0.65, 0.2), vec3(0.3, 0.95, 0.95), vec3(1.0, 0.95, 0.3), vec3(1.0, 0.5, 0.75)

// LightData.type
#define GNOMON_DIRECTIONAL 0
#define GNOMON_SPOT 1
#define GNOMON_POINT 2

// LightData.filterKind
#define GNOMON_FILTER_KERNEL 0 // comparisons over a square of texels
#define GNOMON_FILTER_DISC 1   // comparisons over a disc of the world
#define GNOMON_FILTER_VSM 2    // moments of blurred depths
#define GNOMON_FILTER_EVSM 3
#define GNOMON_FILTER_MSM 4
#define GNOMON_FILTER_PCSS 5 // comparisons over a disc as wide as the penumbra
#define GNOMON_READS_MOMENTS(kind) \
  ((kind) == GNOMON_FILTER_VSM || (kind) == GNOMON_FILTER_EVSM || (kind) == GNOMON_FILTER_MSM)

// What a frame's radiance becomes as it is shown.
#define GNOMON_TONE_NONE 0 // of pictures that are not encoded
#define GNOMON_TONE_CLIP 1
#define GNOMON_TONE_ACES 2
#define GNOMON_TONE_NEUTRAL 3
#define GNOMON_TONE_AGX 4

struct FrameData {
  mat4 clipFromRelative;
  vec3 forward;               // the view axis
  uint perspective;           // 0 = orthographic
  vec3 middle;                // the way through the picture's middle, one metre of view depth long
  float nearest;              // surface, metres of view depth
  vec3 right;                 // from the picture's middle to its right edge, at 1 m (perspective) or at any depth
  float farthest;             // surface, metres of view depth
  vec3 up;                    // the same as `right` to the upper edge
  float pixelHeight;          // there, metres
  vec2 depthTerms;            // terms 2 2 and 3 2 of the projection
  vec2 pixelStep;             // 2 / width, 2 / height
  vec4 background;            // where there is no surface, as it shows
  vec3 ambient;               // radiance of the studio
  float exposureScale;        // 2^exposure
  float ahead;                // metres to be added to a depth that is shown, as the eye is moved ahead
  float environmentIntensity; // radiance of the environment's texels is multiplied by it
  vec2 environmentTurn;       // as inEnvironment of surroundings.h has it, of the studio too
  float shownRoughness;       // of the surroundings where there is no surface; less than 0 = `background` shows there
  uint studioLamps;           // 0 = the studio is even all around
  float padding1, padding2;
};

// Read as vertex attributes, one an instance: llvmpipe fetches those far faster than a storage buffer.
struct InstanceData {
  vec4 relativeFromLocal[3]; // rows of the affine matrix
  vec4 normalFromLocal[3];   // rows, xyz; w: as named below
#ifdef __cplusplus
  // The number of a draw's first triangle; the index of the node.
  float& firstTriangle() {
    return normalFromLocal[1].w;
  }
  float& node() {
    return normalFromLocal[2].w;
  }
  float& receiverGroup() {
    return normalFromLocal[0].w;
  }
  float receiverGroup() const {
    return normalFromLocal[0].w;
  }
#endif
};

struct MaterialData {
  vec4 baseColorFactor;
  vec3 emissiveFactor;
  float alphaCutoff;
  float metallicFactor;
  float roughnessFactor;
  float normalScale;
  float occlusionStrength;
  vec3 specularFactor;
  float glossinessFactor;
  float transmission;
  float coverageRow;     // the first of its table (mask_coverage.h)
  float coverageLastRow; // the number of the last one from there on; 0 = it has none
  float mixesLevels;     // 1 = the table's levels are mixed
  vec4 uvAxes[5];        // of each texture unit: columns of the matrix from a vertex's coordinates
  vec4 uvOffsets[5];     // xy: added to that
};

struct LightData {
  vec3 direction;  // unit length: towards the light (directional), along which it shines (spot)
  int type;        // GNOMON_DIRECTIONAL ...
  vec3 position;   // relative
  float range;     // metres; 0 = infinite
  vec3 radiance;   // color times intensity
  float strength;  // of its shadow; 0 = casts none
  float coneScale; // spot: the falloff is the square of cosine * coneScale + coneOffset, within 0..1
  float coneOffset;
  float filterRadius; // GNOMON_FILTER_DISC: metres; GNOMON_FILTER_PCSS: the light's own, metres or a tangent
  uint fadesOut;      // 1 = its last tile fades to lit at the far end
  uint firstTile;
  uint tileCount;             // cascades or faces; 0 = no map
  int filterKind;             // GNOMON_FILTER_...
  int filterSize;             // texels along a side that are compared
  uint visibilityLayer;       // its number plus 1; 0 = none
  uint layerOmitsTurnedFaces; // 1 = its visibility layer is lit where a face is turned away
  uint litGroups;             // a bit a receiver group: those that it lights
  uint shadowedGroups;        // of these, where it throws shadows
  float manualDepthBias;      // metres towards the light
  float manualSlopeBias;      // the same, times the slope
  float manualNormalOffset;   // metres along the normal
  uint hasManualBias;         // 1 = the manual bias counts, not the tile's
  vec3 shadowColor;           // the share of the light that a full shadow of strength 1 leaves
  uint hasShadowColor;        // 1 = that is not black
  uint smoothTerminator;      // 1 = receivers may stand on the surface that shading shows (smooth_surface.h)
  uint padding1, padding2, padding3;
};

struct TileData {
  vec4 atlasFromRelative[4]; // rows: to atlas u, v (0..1 over the atlas), depth, and what to divide them by
  vec2 lowest;               // atlas u v of the lowest point that may be looked up
  vec2 highest;
  float near;      // view depth, metres (cascade); distance along the axis (face)
  float blendNear; // cascade: where blending to the next begins
  float far;
  float normalOffset; // metres, times the divisor
  float depthBias;
  float depthBiasNear; // times the square of the divisor
  vec2 atlasPerMetre;  // atlas u v of a length across the light, at a divisor of 1
  vec3 axis;           // where the light travels in the tile's middle
  float texelDepth;    // length of `right`
  vec3 right;        // along u, as long as the depth that one texel's width along the light is worth (parallel), or its
                     // tangent times the negative of what 1 / distance is multiplied by in depths
  float filterReach; // of its filter's disc at most, a length across the light
  vec3 up;           // the same along v
  uint perspective;  // 0 = its light is parallel, and divisors are 1
};

// A point of a surface, of which the light is asked.
struct ProbeData {
  vec4 relative; // xyz; w: view depth, metres
  vec4 normal;   // xyz: of the triangle, on the eye's side, unit length; w: receiver group
};

#ifdef __cplusplus
} // namespace gnomon::shared
#endif
