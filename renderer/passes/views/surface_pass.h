#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/gpu_light_maps.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/survey/survey_pass.h"
#include "renderer/prepare/draw_list.h"

namespace gnomon {

/// What each sample of the picture shows, before any light falls on it. Views are made from it, pixel by pixel.
struct Surfaces {
  gl::Texture bits;                       ///< RGBA32UI: a packed Surface (shaders/common_surface.glsl)
  gl::Texture emission;                   ///< RGBA16F; empty where nothing in the scene glows
  gl::Texture smoothPlaces;               ///< RG32UI: packedSmoothPlace; empty where no light asks for them
  gl::Texture ownDepth;                   ///< only where the survey has other samples
  gl::Texture bakedShares;                ///< R16, RG16 or RGBA16: a channel a light of SurfaceAsks; empty = none
  gl::Texture triangleNumbers;            ///< R32UI; empty where nothing asks which triangle shows
  TriangleNumbers numbers;                ///< what they stand for
  std::vector<glm::vec2> samplePositions; ///< within a pixel, 0..1 from its lower left corner; one a sample
  std::uint64_t triangles = 0;
  std::size_t drawCalls = 0;
  gl::Timer timer;

  std::size_t bytes() const; ///< of the textures, on the device
};

/// What is asked of surfaces, besides what they are made of.
struct SurfaceAsks {
  bool numbered = false;                      ///< the triangle that each sample shows
  bool smoothPlaces = false;                  ///< where the surface lies that shading shows
  std::span<const GpuLightMap* const> maps{}; ///< their shares there; GNOMON_LIGHT_MAPS at most, of one layout
};

/// Draws the surfaces that the survey found, `samples` a pixel (1 or 4). With the survey's own samples its depth and
/// its visible clusters are exact; else depth is drawn again.
Result<Surfaces> drawSurfaces(const PassInputs& inputs, const Survey& survey, int samples, const SurfaceAsks& asks);

/// The numbers (prepare/draw_list.h) of what the samples show, pixel by pixel from the LOWEST row; the samples of a
/// pixel lie side by side. REQUIRES: numbered surfaces.
Result<std::vector<std::uint32_t>> shownTriangles(const PassInputs& inputs, const Surfaces& surfaces);

} // namespace gnomon
