#include "renderer/passes/views/volume_layers.h"

#include "renderer/core/parallel.h"
#include "renderer/passes/views/view_pass.h"
#include "renderer/volume/volume_picture.h"

namespace gnomon {
namespace {

/// View depths of all samples, metres; infinite where nothing is.
Result<std::vector<float>> viewDepths(const PassInputs& inputs, const gl::Texture& depth, std::size_t samples) {
  const std::size_t pixels = static_cast<std::size_t>(inputs.width) * static_cast<std::size_t>(inputs.height);
  std::vector<float> depths(pixels * samples);
  const Rect whole{0, 0, inputs.width, inputs.height};
  const auto texels = std::as_writable_bytes(std::span(depths));
  if (samples == 1) {
    depth.read(0, whole, {GL_DEPTH_COMPONENT, GL_FLOAT}, texels);
  } else {
    const auto beside = drawTexture(inputs.programs, "sample_depths.frag", depth, GNOMON_DEPTH_UNIT, GL_RGBA32F);
    if (!beside) return beside.problems();
    beside->read(0, whole, {GL_RGBA, GL_FLOAT}, texels);
  }
  forEachPiece(depths.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) depths[i] = seenDepth(inputs.camera, depths[i]);
  });
  return depths;
}

} // namespace

Result<VolumeLayers> volumeLayers(const PassInputs& inputs, const Survey& survey, const Surfaces& surfaces,
                                  const FrameVolumes& volumes, bool seen) {
  VolumeLayers layers;
  layers.timer = gl::Timer::start();
  const auto depths = viewDepths(inputs, depthOf(surfaces, survey), surfaces.samplePositions.size());
  if (!depths) return depths.problems();
  const SeenSurfaces shown{inputs.camera, inputs.width, inputs.height, surfaces.samplePositions, *depths};
  const std::vector<MappedMedium> media = volumes.mapped();
  if (volumes.light >= 0) layers.shadow = volumeShadowPicture(shown, media, volumes.towards);
  if (seen) {
    const std::vector<glm::vec4> picture = marchPicture(shown, media, volumes.ambient);
    layers.picture = gl::Texture({GL_RGBA32F, inputs.width, inputs.height}, "volumes");
    layers.picture.write(0, {GL_RGBA, GL_FLOAT}, std::as_bytes(std::span(picture)));
  }
  layers.timer.stop();
  return layers;
}

} // namespace gnomon
