#include "renderer/render.h"

#include <filesystem>
#include <mutex>

#include "protocol/spec/enum_rows.h"
#include "renderer/cpu/cpu_device.h"
#include "renderer/evaluation/shimmer.h"
#include "renderer/frame/baked_scene.h"
#include "renderer/frame/render_frame.h"
#include "renderer/passes/gl_device.h"
#include "renderer/scene/gltf_loader.h"

namespace gnomon {

Result<ScenePtr> loadScene(const SceneBundle& bundle, const Limits& limits, const std::string& id, const GoOn& goOn,
                           KnownContent* known) {
  return untilStopped(goOn, [&] { return loadGltf(bundle, limits, id, known); });
}

const SceneSummary& summaryOf(const Scene& scene) {
  return scene.summary;
}

namespace {

/// False where no kernel driver of a GPU shows a device file, so that no OpenGL driver need be loaded to find none.
bool mayHaveGpu() {
  std::error_code none;
  for (const char* file : {"/dev/nvidiactl", "/dev/kfd", "/dev/dxg", "/dev/mali0"}) {
    if (std::filesystem::exists(file, none)) return true;
  }
  for (const auto& entry : std::filesystem::directory_iterator("/dev/dri", none)) {
    if (entry.path().filename().string().starts_with("render")) return true;
  }
  return false;
}

/// An explicit context, or a required GPU, is a request for OpenGL.
Result<DeviceChoice> askedDevice(const BackendOptions& backend) {
  const bool namesContext = backend.backend != Backend::auto_ || backend.requireGpu;
  if (!namesContext || backend.device == DeviceChoice::gl) return backend.device;
  if (backend.device == DeviceChoice::auto_) return DeviceChoice::gl;
  return Problem{ProblemCode::invalidValue, "", "The device cpu has neither a context of OpenGL nor a GPU.",
                 "gl or auto", "cpu"};
}

std::shared_ptr<FrameCaches> emptyCaches(const RendererOptions& options) {
  return std::shared_ptr<FrameCaches>(new FrameCaches{
      TracedSceneCache(options.tracedSceneBytes), LightMapCache(options.lightMapBytes, options.lightMaps),
      VolumeCache(options.volumeBytes / 2), EnvironmentCache(options.environmentBytes)});
}

} // namespace

/// The devices of one renderer. Used on one thread.
class Devices {
 public:
  /// Opens the one that draws: OpenGL where the options ask for it, or leave the choice open and there is a GPU; else
  /// the processor, for which no display is opened and no driver loaded, then or later.
  static Result<Devices> open(const RendererOptions& options);
  /// Only that one, whatever specs name.
  explicit Devices(std::unique_ptr<Device> only);

  const Device& standard() const { return *standard_; }

  /// The device that draws a spec: the processor where that is named and the choice was left open, else the standard
  /// one. A problem at /device where the spec names another, or it can't be opened.
  Result<Device*> of(const FrameSpec& spec);

 private:
  std::unique_ptr<Device> standard_, processor_;
  bool isOnly_ = true;
  bool mayOpenProcessor_ = false;
  std::size_t tileCacheBytes_ = 0; ///< of the processor, where that is opened later
};

Devices::Devices(std::unique_ptr<Device> only) : standard_(std::move(only)) {}

Result<Devices> Devices::open(const RendererOptions& options) {
  const auto asked = askedDevice(options.backend);
  if (!asked) return asked.problems();
  std::unique_ptr<Device> device;
  const bool isOpen = *asked == DeviceChoice::auto_;
  if (*asked == DeviceChoice::gl || (isOpen && mayHaveGpu())) {
    BackendOptions backend = options.backend;
    backend.requireGpu = backend.requireGpu || isOpen;
    auto made = createGlDevice({backend, options.gpuSceneBytes, options.tileCacheBytes});
    if (!made && !isOpen) return made.problems();
    if (made) device = *std::move(made);
  }
  const bool mayOpenProcessor = isOpen && device != nullptr;
  if (!device) {
    auto made = createCpuDevice({options.tileCacheBytes});
    if (!made) return made.problems();
    device = *std::move(made);
  }
  Devices devices(std::move(device));
  devices.isOnly_ = false;
  devices.mayOpenProcessor_ = mayOpenProcessor;
  devices.tileCacheBytes_ = options.tileCacheBytes;
  return devices;
}

Result<Device*> Devices::of(const FrameSpec& spec) {
  const DeviceChoice drawing = standard_->info().device;
  if (isOnly_ || spec.device == DeviceChoice::auto_ || spec.device == drawing) return standard_.get();
  if (!mayOpenProcessor_) {
    const std::string used(spell(drawing));
    const std::string named(spell(spec.device));
    return Problem{ProblemCode::unsupportedFeature, "/device",
                   "The device " + used + " draws here: start with --device " + named + " for the other.",
                   "auto or " + used, named};
  }
  if (!processor_) {
    auto made = createCpuDevice({tileCacheBytes_});
    if (!made) return made.problems();
    processor_ = *std::move(made);
  }
  return processor_.get();
}

struct Renderer::Impl {
  Devices devices;
  std::shared_ptr<FrameCaches> caches;
};

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

std::shared_ptr<EnvironmentCache> Renderer::environments() const {
  return {impl_->caches, &impl_->caches->environments};
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
          },
          renderer.environments()};
}

Result<Frame> Renderer::render(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles, const GoOn& goOn) {
  const auto device = impl_->devices.of(spec);
  if (!device) return device.problems();
  return renderFrame(**device, *impl_->caches, scene, spec, tiles, goOn);
}

} // namespace gnomon
