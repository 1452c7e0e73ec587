#include "protocol/cost/cost_model.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon {
namespace {

constexpr double kKept = 0.9;          ///< of a frame's weight, with each frame that follows
constexpr double kUsualFactor = 1e-6;  ///< milliseconds for a unit of work, before anything was seen
constexpr double kUsualWeighs = 0.2e6; ///< as much as so much seen work

/// The part that a report's stage is of; nothing for what is no work on the frame.
std::optional<FramePart> partOf(std::string_view stage) {
  constexpr std::array<std::pair<std::string_view, FramePart>, 11> kParts{{{"upload", FramePart::fixed},
                                                                           {"plan", FramePart::fixed},
                                                                           {"bake", FramePart::bake},
                                                                           {"volume", FramePart::volume},
                                                                           {"survey", FramePart::survey},
                                                                           {"shadow", FramePart::shadow},
                                                                           {"shade", FramePart::shade},
                                                                           {"predict", FramePart::predict},
                                                                           {"reference", FramePart::reference},
                                                                           {"sunHours", FramePart::reference},
                                                                           {"readback", FramePart::readback}}};
  if (stage == "encode") return FramePart::encode;
  const auto found = std::find_if(kParts.begin(), kParts.end(), [&](const auto& each) { return each.first == stage; });
  return found == kParts.end() ? std::nullopt : std::optional(found->second);
}

/// The times of a report by part, negative where it has none.
std::array<double, kFrameParts> timesOf(const FrameReport& report) {
  std::array<double, kFrameParts> times;
  times.fill(-1);
  const auto add = [&](FramePart part, double milliseconds) {
    double& time = times[static_cast<std::size_t>(part)];
    time = std::max(time, 0.0) + milliseconds;
  };
  for (const StageTime& stage : report.stages) {
    if (const auto part = partOf(stage.stage)) add(*part, stage.milliseconds);
  }
  for (const PassReport& pass : report.passes) {
    if (pass.pass == "visibility" || pass.pass == "sky") add(FramePart::visibility, pass.cpuMilliseconds);
  }
  const double apart = std::max(times[static_cast<std::size_t>(FramePart::visibility)], 0.0);
  double& shade = times[static_cast<std::size_t>(FramePart::shade)];
  if (shade >= 0) shade = std::max(shade - apart, 0.0);
  return times;
}

bool anyReused(const FrameReport& report) {
  return std::any_of(report.lights.begin(), report.lights.end(), [](const LightReport& light) {
    return (light.lightMap && light.lightMap->reused) ||
           std::any_of(light.tiles.begin(), light.tiles.end(), [](const TileReport& tile) { return tile.reused; });
  });
}

} // namespace

void CostModel::learn(const FrameCost& cost, const FrameReport& report) {
  std::array<double, kFrameParts> times = timesOf(report);
  if (anyReused(report)) {
    times[static_cast<std::size_t>(FramePart::shadow)] = -1;
    times[static_cast<std::size_t>(FramePart::bake)] = -1;
  }
  if (std::any_of(report.volumes.begin(), report.volumes.end(), [](const VolumeReport& each) { return each.reused; })) {
    times[static_cast<std::size_t>(FramePart::volume)] = -1;
  }
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < kFrameParts; ++i) {
    if (times[i] < 0 || !(cost.parts[i] > 0)) continue;
    seen_[i].milliseconds = kKept * seen_[i].milliseconds + times[i];
    seen_[i].work = kKept * seen_[i].work + cost.parts[i];
  }
}

FrameCost CostModel::parts(const FrameCost& cost) const {
  const std::lock_guard lock(mutex_);
  FrameCost parts;
  for (std::size_t i = 0; i < kFrameParts; ++i) {
    const Seen& seen = seen_[i];
    parts.parts[i] = cost.parts[i] * (seen.milliseconds + kUsualFactor * kUsualWeighs) / (seen.work + kUsualWeighs);
  }
  return parts;
}

double CostModel::milliseconds(const FrameCost& cost) const {
  const FrameCost each = parts(cost);
  return std::accumulate(each.parts.begin(), each.parts.end(), 0.0);
}

} // namespace gnomon
