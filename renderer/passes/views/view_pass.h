#pragma once

#include <span>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/passes/tiles/caster_node_pass.h"
#include "renderer/passes/tiles/shadow_pass.h"
#include "renderer/passes/views/surface_pass.h"
#include "renderer/passes/views/visibility_layers.h"

namespace gnomon {

/// One view, drawn: a single-sample color target.
struct DrawnView {
  gl::Texture color; ///< RGBA8 or SRGB8_ALPHA8 when encoded, else RGBA32F
  gl::Framebuffer framebuffer;
  gl::Timer timer;
};

struct ViewInputs {
  const Survey& survey;
  const ShadowAtlas& atlas;
  std::span<const shared::LightData> lights; ///< the spec's
  std::span<const shared::TileData> tiles;   ///< the plan's
  std::span<const std::uint32_t> lightLists; ///< empty = every light is tried at every pixel
  const FrameSpec& spec;                     ///< effective
  int debugLight = -1;                       ///< what views of one light show; -1 = there is none
};

/// Pictures (color, cascades, texelGrid, lightContribution) are antialiased as the spec asks; all else is data and
/// never averaged: it belongs to the surface at the pixel's centre.
bool isPicture(View view);

/// True for views that show a shadow.
bool showsShadow(View view);

/// What one view is made from besides the frame.
struct ViewSources {
  const Surfaces& surfaces;           ///< data wants one sample a pixel
  const VisibilityLayers& visibility; ///< of the surfaces' samples; empty where no light has a layer
  const CasterNodes& casters;         ///< read by the view casterIds
};

/// What looking up these lights' shadows needs and no more; the rest of the variant has its defaults. `layersDecide`:
/// no light that has a layer (visibility_layers.h) is looked up in its tiles.
ViewVariant lightVariant(const PassInputs& inputs, const ViewInputs& shading, bool layersDecide);

/// Lights the surfaces of every pixel for any view but atlas and tile.
Result<DrawnView> drawView(const PassInputs& inputs, const ViewInputs& shading, const ViewSources& sources, View view);

} // namespace gnomon
