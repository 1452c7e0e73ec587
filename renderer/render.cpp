#include "renderer/render.h"

#include <mutex>

#include "renderer/devices.h"
#include "renderer/evaluation/shimmer.h"
#include "renderer/frame/baked_scene.h"
#include "renderer/frame/render_frame.h"
#include "renderer/scene/gltf_loader.h"

namespace gnomon {

Result<ScenePtr> loadScene(const SceneBundle& bundle, const Limits& limits, const std::string& id, const GoOn& goOn,
                           KnownContent* known) {
  return untilStopped(goOn, [&] { return loadGltf(bundle, limits, id, known); });
}

const SceneSummary& summaryOf(const Scene& scene) {
  return scene.summary;
}

struct Renderer::Impl {
  Devices devices;
  std::shared_ptr<FrameCaches> caches;
};

namespace {

std::shared_ptr<FrameCaches> emptyCaches(const RendererOptions& options) {
  return std::shared_ptr<FrameCaches>(new FrameCaches{TracedSceneCache(options.tracedSceneBytes),
                                                      LightMapCache(options.lightMapBytes, options.lightMaps),
                                                      VolumeCache(options.volumeBytes / 2)});
}

} // namespace

Renderer::Renderer(std::unique_ptr<Device> device, std::size_t tracedSceneBytes)
    : impl_(new Impl{Devices(std::move(device)), emptyCaches({.backend = {}, .tracedSceneBytes = tracedSceneBytes})}) {}
Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create(const RendererOptions& options) {
  auto devices = Devices::open(options);
  if (!devices) return devices.problems();
  return Renderer(std::unique_ptr<Impl>(new Impl{std::move(*devices), emptyCaches(options)}));
}

const RendererInfo& Renderer::info() const {
  return impl_->devices.standard().info();
}

Result<RendererInfo> Renderer::infoFor(const FrameSpec& spec) {
  const auto device = impl_->devices.of(spec);
  if (!device) return device.problems();
  return (*device)->info();
}

Baker Renderer::baker() const {
  return Baker(impl_->caches);
}

Result<BakeReport> Baker::bake(const ScenePtr& scene, const FrameSpec& spec, const BakeListener& listener) const {
  const auto baked = bakeScene(*caches_, scene, spec, listener);
  if (!baked) return baked.problems();
  return reportOf(*baked);
}

Result<Bytes> Baker::file(const ScenePtr& scene, const FrameSpec& spec, BakeFile kind, std::optional<int> light,
                          const BakeListener& listener) const {
  const auto baked = bakeScene(*caches_, scene, spec, listener);
  if (!baked) return baked.problems();
  return bakeFile(*baked, kind, light);
}

Result<Shimmer> Renderer::shimmer(const ScenePtr& scene, const FrameSpec& spec, std::span<const Camera> path,
                                  const Progress& progress) {
  const auto device = impl_->devices.of(spec);
  if (!device) return device.problems();
  std::mutex reporting;
  double done = 0;
  const Progress report = [&](double share) {
    const std::lock_guard lock(reporting);
    done = share;
    return !progress || progress(share);
  };
  const GoOn goOn = progress ? GoOn([&] {
    const std::lock_guard lock(reporting);
    return progress(done);
  })
                             : GoOn();
  return untilStopped(goOn, [&] { return measureShimmer(**device, impl_->caches->traced, scene, spec, path, report); });
}

EvaluationTools evaluationTools(Renderer& renderer, const ScenePtr& scene) {
  return {[&](const FrameSpec& spec) { return renderer.render(scene, spec, TileUse::drawnAnew); },
          [&](const FrameSpec& spec, std::span<const Camera> path, const Progress& progress) -> Result<double> {
            const auto shimmer = renderer.shimmer(scene, spec, path, progress);
            if (!shimmer) return shimmer.problems();
            return shimmer->perThousand();
          }};
}

Result<Frame> Renderer::render(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles, const GoOn& goOn) {
  const auto device = impl_->devices.of(spec);
  if (!device) return device.problems();
  return renderFrame(**device, *impl_->caches, scene, spec, tiles, goOn);
}

} // namespace gnomon
