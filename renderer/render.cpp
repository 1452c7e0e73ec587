#include "renderer/render.h"

#include "renderer/evaluation/shimmer.h"
#include "renderer/frame/render_frame.h"
#include "renderer/passes/gl_device.h"
#include "renderer/scene/gltf_loader.h"

namespace gnomon {

Result<ScenePtr> loadScene(const SceneBundle& bundle, const Limits& limits) {
  return loadGltf(bundle, limits);
}

const SceneSummary& summaryOf(const Scene& scene) {
  return scene.summary;
}

struct Renderer::Impl {
  std::unique_ptr<Device> device;
  TracedSceneCache traced;
};

Renderer::Renderer(std::unique_ptr<Device> device, std::size_t tracedSceneBytes)
    : impl_(new Impl{std::move(device), TracedSceneCache(tracedSceneBytes)}) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(const RendererOptions& options) {
  auto device = createGlDevice({options.backend, options.gpuSceneBytes, options.tileCacheBytes});
  if (!device) return device.problems();
  return Renderer(std::move(*device), options.tracedSceneBytes);
}

const RendererInfo& Renderer::info() const {
  return impl_->device->info();
}

Result<Shimmer> Renderer::shimmer(const ScenePtr& scene, const FrameSpec& spec, std::span<const Camera> path,
                                  const Progress& progress) {
  return measureShimmer(*impl_->device, impl_->traced, scene, spec, path, progress);
}

Result<Frame> Renderer::render(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles) {
  return renderFrame(*impl_->device, impl_->traced, scene, spec, tiles);
}

} // namespace gnomon
