#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/cost/shadow_cost.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

/// The work of a frame, estimated before it is drawn, from the request and the scene's summary alone.
namespace gnomon {

SceneCounts sceneCounts(const SceneSummary& summary);

/// Where a frame spends its time: the stages of a report, those that belong together as one. What `shade` of a report
/// takes to find shadows sample by sample (pass `visibility`) is a part of its own here.
enum class FramePart { fixed, bake, volume, survey, shadow, visibility, shade, predict, reference, readback, encode };

inline constexpr std::size_t kFrameParts = static_cast<std::size_t>(FramePart::encode) + 1;

/// Work by part, in nanoseconds that it takes about on two cores without a GPU: a unit that other machines are
/// proportional to, part by part. 0 = the frame has no such part.
struct FrameCost {
  std::array<double, kFrameParts> parts{};

  double& operator[](FramePart part) { return parts[static_cast<std::size_t>(part)]; }
  double operator[](FramePart part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Of a frame that finds nothing of earlier ones: every tile is drawn, every light map baked. What the camera sees is
/// not known, so that it counts as if surfaces filled the picture, lit by every light. Grows with each of: pixels,
/// samples, views, lights, rays, texels, triangles. `device`: what technique auto chooses for. REQUIRES: `spec` has
/// passed protocol/validate.
FrameCost frameCost(const FrameSpec& spec, const SceneCounts& scene, DeviceKind device = DeviceKind::processor);

} // namespace gnomon
