#pragma once

#include <cstddef>
#include <memory>

#include "protocol/spec/frame_spec.h"
#include "renderer/device/device.h"

namespace gnomon {

struct RendererOptions;

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

} // namespace gnomon
