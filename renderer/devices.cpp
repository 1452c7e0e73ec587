#include "renderer/devices.h"

#include <filesystem>

#include "protocol/spec/shadow_volume_places.h"
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

struct Devices::Choice {
  DeviceChoice device = DeviceChoice::auto_;
  GlOptions gl;
  CpuOptions cpu;
};

Devices::Devices(std::unique_ptr<Device> only) : only_(std::move(only)), standard_(only_.get()) {}

Result<Devices> Devices::open(const RendererOptions& options) {
  Devices devices;
  const auto asked = askedDevice(options.backend);
  if (!asked) return asked.problems();
  const Choice choice{
      *asked, {options.backend, options.gpuSceneBytes, options.tileCacheBytes}, {options.tileCacheBytes}};
  devices.choice_ = std::make_shared<const Choice>(choice);
  if (choice.device == DeviceChoice::gl) {
    auto made = createGlDevice(choice.gl);
    if (!made) return made.problems();
    devices.gl_ = std::move(*made);
  } else if (choice.device == DeviceChoice::auto_ && mayHaveGpu()) {
    GlOptions onGpu = choice.gl;
    onGpu.backend.requireGpu = true;
    if (auto made = createGlDevice(onGpu)) devices.gl_ = std::move(*made);
  }
  if (!devices.gl_) {
    auto made = createCpuDevice(choice.cpu);
    if (!made) return made.problems();
    devices.cpu_ = std::move(*made);
  }
  devices.standard_ = devices.gl_ ? devices.gl_.get() : devices.cpu_.get();
  return devices;
}

Result<Device*> Devices::of(const FrameSpec& spec) {
  if (only_) return only_.get();
  DeviceChoice wanted = spec.device;
  if (wanted == DeviceChoice::auto_) {
    const bool needsGl = choice_->device == DeviceChoice::auto_ && !placesOfShadowVolumes(spec).empty();
    if (!needsGl) return standard_;
    wanted = DeviceChoice::gl;
  }
  const char* name = wanted == DeviceChoice::cpu ? "cpu" : "gl";
  if (choice_->device != DeviceChoice::auto_ && choice_->device != wanted) {
    return Problem{ProblemCode::unsupportedFeature, "/device", "This renderer was started for one device only.",
                   wanted == DeviceChoice::cpu ? "gl or auto" : "cpu or auto", name};
  }
  std::unique_ptr<Device>& device = wanted == DeviceChoice::cpu ? cpu_ : gl_;
  if (!device) {
    auto made = wanted == DeviceChoice::cpu ? createCpuDevice(choice_->cpu) : createGlDevice(choice_->gl);
    if (!made) return made.problems();
    device = std::move(*made);
  }
  return device.get();
}

} // namespace gnomon
