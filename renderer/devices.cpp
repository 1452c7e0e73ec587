#include "renderer/devices.h"

#include <filesystem>

#include "protocol/spec/enum_rows.h"
#include "renderer/cpu/cpu_device.h"
#include "renderer/passes/gl_device.h"
#include "renderer/render.h"

namespace gnomon {
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

/// An explicit context, or the wish for a GPU, is one for OpenGL.
Result<DeviceChoice> askedDevice(const BackendOptions& backend) {
  const bool namesContext = backend.backend != Backend::auto_ || backend.requireGpu;
  if (!namesContext || backend.device == DeviceChoice::gl) return backend.device;
  if (backend.device == DeviceChoice::auto_) return DeviceChoice::gl;
  return Problem{ProblemCode::invalidValue, "", "The device cpu has neither a context of OpenGL nor a GPU.",
                 "gl or auto", "cpu"};
}

} // namespace

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

} // namespace gnomon
