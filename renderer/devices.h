#pragma once

#include <cstddef>
#include <memory>

#include "protocol/spec/frame_spec.h"
#include "renderer/device/device.h"

namespace gnomon {

struct RendererOptions;

/// The devices that one renderer may draw by, each opened when it is first needed. Used on one thread.
class Devices {
 public:
  /// Opens the one that draws what leaves the choice open: OpenGL where the options ask for it or there is a GPU, else
  /// the processor, for which no display is opened and no driver loaded.
  static Result<Devices> open(const RendererOptions& options);
  /// Only that one.
  explicit Devices(std::unique_ptr<Device> only);

  const Device& standard() const { return *standard_; }

  /// The device that a spec, as it was asked for, is drawn by: the one that it names, or else the standard one, but for
  /// what only OpenGL draws. A problem at /device where the options leave it out, or it can't be opened.
  Result<Device*> of(const FrameSpec& spec);

 private:
  struct Choice; ///< what the options leave
  Devices() = default;

  std::shared_ptr<const Choice> choice_;
  std::unique_ptr<Device> cpu_, gl_, only_;
  Device* standard_ = nullptr;
};

} // namespace gnomon
