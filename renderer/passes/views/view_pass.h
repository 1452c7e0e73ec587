#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/device/device.h"
#include "renderer/device/shader_data.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/passes/pass_inputs.h"
#include "renderer/passes/shader_variants.h"
#include "renderer/passes/tiles/atlas_views.h"
#include "renderer/passes/tiles/shadow_pass.h"
#include "renderer/passes/views/surface_pass.h"

namespace gnomon {

/// What exact techniques say of every sample of the picture: the share of each of their lights that arrives, before the
/// shadow's strength. A layer a light.
struct VisibilityLayers {
  gl::Texture
      texture; ///< array of R16 (one sample a pixel) or RGBA16 (four: a channel a sample); empty = no such light
};

/// Layers of undefined texels. More bytes than a frame may take are a problem at /lights.
Result<VisibilityLayers> makeVisibilityLayers(int width, int height, int samples, int layers);

/// Writes one layer: a value for each sample, 0..65535, pixel by pixel, the picture's LOWEST row first.
void writeVisibility(VisibilityLayers& layers, int layer, std::span<const std::uint16_t> values);

/// One view, drawn: a single-sample color target.
struct DrawnView {
  gl::Texture color; ///< RGBA8 or SRGB8_ALPHA8 when encoded, else RGBA32F; that also when fine
  gl::Framebuffer framebuffer;
  gl::Timer timer;
};

/// The light maps that surfaces are looked up in as they are drawn: those of the last of FrameWork::layered.
struct BakedShading {
  std::vector<const GpuLightMap*> maps{}; ///< as SurfaceAsks has them
  int firstLayer = 0;                     ///< of the first of them, an index into FrameWork::layered
};

/// A frame's lights, their tiles and the light lists of the picture's squares, where shaders read them.
struct LightBuffers {
  gl::Buffer lights;
  gl::Buffer tiles;
  gl::Buffer lists;
};

LightBuffers uploadLights(std::span<const LitLight> lights, const ShadowPlan& plan,
                          std::span<const std::uint32_t> lists = {});

/// What lights the surfaces of a frame.
struct Shading {
  const FrameSpec& spec; ///< effective
  const Survey& survey;
  const ShadowAtlas& atlas;
  std::span<const LitLight> lights; ///< the spec's
  const LightBuffers& buffers;      ///< of the same
  bool lightLists = false;          ///< each square of the picture lists its own; else every light is tried everywhere
  int debugLight = -1;              ///< what views of one light show; -1 = there is none
  BakedShading baked{};             ///< the other lights that are layered have their layers
};

/// What volumes are to a picture of one number of samples a pixel: found by the processor, read by shaders.
struct VolumeLayers {
  gl::Texture picture;               ///< RGBA32F: marchPicture; empty where no view shows them
  std::vector<std::uint16_t> shadow; ///< volumeShadowPicture; empty where they shade no light
  gl::Timer timer;
};

/// SkyShadow of the surfaces' samples.
struct SkyTexture {
  gl::Texture texture; ///< array of RGBA16, a layer a sample; empty = nothing is hidden
  std::uint64_t rays = 0;
  gl::Timer timer;
};

/// What one view is made from.
struct ViewSources {
  const Surfaces& surfaces;              ///< data wants one sample a pixel
  const VisibilityLayers& visibility;    ///< of the surfaces' samples; empty where no light has a layer
  const CasterNodes& casters;            ///< read by the view casterIds
  const VolumeLayers* volumes = nullptr; ///< null where the view knows none
  const SkyTexture* sky = nullptr;       ///< null where the view knows none
  int volumeLight = -1;                  ///< the light that they shade surfaces from; -1 = none
};

/// What looking up these lights' shadows needs and no more; the rest of the variant has its defaults. `layersDecide`:
/// no light that has a layer (VisibilityLayers) is looked up in its tiles.
ViewVariant lightVariant(const PassInputs& inputs, const Shading& shading, bool layersDecide);

/// Lights the surfaces of every pixel for a view that is a picture or data.
Result<DrawnView> drawView(const PassInputs& inputs, const Shading& shading, const ViewSources& sources,
                           const ViewRequest& request);

/// The depth of these surfaces.
const gl::Texture& depthOf(const Surfaces& surfaces, const Survey& survey);

/// Lights, tiles and the atlas, bound for a shader that looks shadows up (shaders/common_shadow.glsl). Lives as long as
/// that is drawn.
class ShadowBindings {
 public:
  explicit ShadowBindings(const Shading& shading);

 private:
  gl::Sampler texels_;
  gl::Sampler blurred_;
};

} // namespace gnomon
