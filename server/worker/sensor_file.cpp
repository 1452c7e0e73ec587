#include "server/worker/sensor_file.h"

#include "protocol/base/elapsed.h"

namespace gnomon {

Result<FrameFile> sensorFile(const ScenePtr& scene, Frame frame, const Order& order, const GoOn& goOn) {
  const auto start = std::chrono::steady_clock::now();
  auto file = [&]() -> Result<Bytes> {
    if (order.labels) return labelPng(*scene, frame, goOn);
    if (order.mediaType == "image/png") return depthPng(frame, *order.depthRange, goOn);
    return depthTiff(frame, *order.depthRange, goOn);
  }();
  if (!file) return std::move(file).problems();
  frame.report.stages.push_back({"encode", millisecondsSince(start)});
  return FrameFile{order.mediaType, std::string(asText(*file)), std::move(frame.report.stages)};
}

} // namespace gnomon
