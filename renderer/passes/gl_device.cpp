#include "renderer/passes/gl_device.h"

#include <numeric>
#include <vector>

#include "renderer/gl/context.h"
#include "renderer/passes/gl_frame.h"

namespace gnomon {
namespace {

class GlDevice : public Device {
 public:
  GlDevice(std::unique_ptr<gl::Context> context, const GlOptions& options)
      : context_(std::move(context)), shared_{{}, GpuSceneCache(options.sceneBytes), TileCache(options.tileBytes)} {}

  const RendererInfo& info() const override { return context_->info(); }

  /// Uploading a scene takes all of its images.
  Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) override {
    std::vector<int> images(work.scene->images.size());
    std::iota(images.begin(), images.end(), 0);
    if (const Status decoded = decodeImages(work.scene->images, images); !decoded) return decoded.problems();
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
