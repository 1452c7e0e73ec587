#pragma once

#include "renderer/render.h"
#include "server/wire/messages.h"
#include "server/worker/frame_file.h"

namespace gnomon {

/// Whether an order wants what a sensor sees instead of a frame's picture.
inline bool wantsSensor(const Order& order) {
  return order.depthRange.has_value() || order.labels;
}

/// That file: depths, or the colors of labels. REQUIRES: the frame has floats of view depth or materials alone.
Result<FrameFile> sensorFile(const ScenePtr& scene, Frame frame, const Order& order, const GoOn& goOn);

} // namespace gnomon
