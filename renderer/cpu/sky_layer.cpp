#include "renderer/cpu/sky_layer.h"

namespace gnomon::cpu {

Result<SkyShadow> skyLayer(const CameraRaster& camera, const FrameWork& work, const DepthBuffer& surfaces) {
  const auto scene = work.traced();
  if (!scene) return scene.problems();
  const SampleGrid grid = gridOf(surfaces);
  const ShownNumbers shown = shownNumbers(surfaces);
  const TriangleNumbers numbers(camera.scene.geometry);
  const std::vector<const Medium*> media = mediaOf(work);
  const TraceInput rays{**scene,      camera.camera, surfaces.width, surfaces.height, *work.frame.spec.lights,
                        camera.nodes, media};
  const PicturePoints points(rays, grid, numbers, shown, {});
  return skyShadow(points, skyLightOf(work.environment), work.frame.spec.environment.samples);
}

} // namespace gnomon::cpu
