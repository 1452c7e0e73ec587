#include "renderer/passes/views/sky_texture.h"

#include <vector>

#include "protocol/base/elapsed.h"
#include "renderer/techniques/sky_shadow.h"

namespace gnomon {
namespace {

/// One sample of every pixel.
std::vector<glm::u16vec4> sampleOf(const SkyShadow& shadow, std::size_t sample, std::size_t samples) {
  std::vector<glm::u16vec4> values(shadow.values.size() / samples);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = shadow.values[i * samples + sample];
  return values;
}

} // namespace

Result<SkyTexture> skyTexture(const PassInputs& inputs, const Shading& shading, const FrameWork& work,
                              const Surfaces& surfaces) {
  SkyTexture sky{{}, 0, gl::Timer::start()};
  const auto scene = work.traced();
  if (!scene) return scene.problems();
  const auto numbers = shownTriangles(inputs, surfaces);
  if (!numbers) return numbers.problems();
  const SampleGrid grid{inputs.width, inputs.height, surfaces.samplePositions};
  const ShownNumbers shown = inOrder(grid, *numbers);
  const std::vector<const Medium*> media = mediaOf(work);
  const TraceInput rays{**scene, inputs.camera, inputs.width, inputs.height, *shading.spec.lights, inputs.nodes, media};
  const PicturePoints points(rays, grid, surfaces.numbers, shown, {});
  const SkyShadow shadow = skyShadow(points, skyLightOf(work.environment), shading.spec.environment.samples);
  sky.rays = shadow.rays;
  gl::TextureShape shape{GL_RGBA16, inputs.width, inputs.height};
  shape.layers = static_cast<int>(grid.samples());
  sky.texture = gl::Texture(shape, "sky");
  for (std::size_t sample = 0; sample < grid.samples(); ++sample) {
    const std::vector<glm::u16vec4> values = sampleOf(shadow, sample, grid.samples());
    sky.texture.writeLayer(static_cast<int>(sample), {GL_RGBA, GL_UNSIGNED_SHORT}, std::as_bytes(std::span(values)));
  }
  sky.timer.stop();
  return sky;
}

} // namespace gnomon
