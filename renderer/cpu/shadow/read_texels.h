#pragma once

#include <cstdint>
#include <span>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/raster/texel_marks.h"
#include "renderer/cpu/shadow/shadow_maps.h"

namespace gnomon::cpu {

/// Surfaces that are to be lit. All of it outlives the call.
struct ReadQuery {
  const FrameScene& scene;
  const DepthBuffer& surfaces; ///< numbered
  const ShadowMaps& maps;
  std::span<const std::uint32_t> lightLists; ///< as ShowJob's
  int debugLight = -1; ///< that light's shadow may be shown wherever it is, whatever the lists say
};

/// Marks the texels that the lights' maps are read in as the surfaces are lit, and some beside them; on all cores. What
/// is marked depends on nothing but the query. `marks`: one a tile of the maps.
void markReadTexels(const ReadQuery& query, std::span<TexelMarks> marks);

} // namespace gnomon::cpu
