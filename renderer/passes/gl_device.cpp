#include "renderer/passes/gl_device.h"

#include "renderer/gl/context.h"
#include "renderer/passes/gl_frame.h"

namespace gnomon {
namespace {

class GlDevice : public Device {
 public:
  GlDevice(std::unique_ptr<gl::Context> context, const GlOptions& options)
      : context_(std::move(context)), shared_{{}, GpuSceneCache(options.sceneBytes), TileCache(options.tileBytes)} {}

  const RendererInfo& info() const override { return context_->info(); }

  Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) override {
    return std::unique_ptr<FrameDrawing>(std::make_unique<GlFrame>(shared_, work));
  }

 private:
  std::unique_ptr<gl::Context> context_; ///< first, so that it outlives everything made in it
  GlShared shared_;
};

} // namespace

Result<std::unique_ptr<Device>> createGlDevice(const GlOptions& options) {
  auto context = gl::createContext(options.backend);
  if (!context) return context.problems();
  return std::unique_ptr<Device>(std::make_unique<GlDevice>(std::move(*context), options));
}

} // namespace gnomon
