#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/surface/textures.h"
#include "tests/renderer/cpu/number_table.h"

namespace gnomon::cpu {

/// Places of the picture and what they show; a multiple of 16 of them.
struct FragmentInput {
  const Textures& textures;
  std::vector<std::uint32_t> triangles; ///< kNoNumber: nothing
  std::vector<float> x, y;              ///< pixels, from the lower left corner
};

/// Columns of surfacesByLanes.
enum SurfaceNumber : std::size_t {
  kRelative = 0, // three columns each
  kFace = 3,
  kNormal = 6,
  kBaseColor = 9,
  kEmission = 12,
  kViewDepth = 15,
  kMetallic,
  kRoughness,
  kOcclusion,
  kUnlit,
  kGroupBit,
  kSurfaceNumbers
};

/// What surface-inl.h makes of each place.
NumberTable surfacesByLanes(const FrameScene& scene, const FragmentInput& in);

} // namespace gnomon::cpu
