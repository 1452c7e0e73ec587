#include "renderer/resolve/check_device.h"

#include <algorithm>
#include <utility>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"

namespace gnomon {

Status checkDevice(const FrameSpec& spec, const RendererInfo& device) {
  ProblemList problems;
  for (const auto& [side, place] : {std::pair(spec.width, "/width"), std::pair(spec.height, "/height")}) {
    if (side <= device.maxTextureSize) continue;
    problems.add({ProblemCode::invalidValue, place, "The device has no pictures as large as that.",
                  "at most " + std::to_string(device.maxTextureSize), std::to_string(side)});
  }
  if (spec.atlas.samples > device.maxSamples) {
    problems.add({ProblemCode::invalidValue, "/atlas/samples", "The device has no depth textures of so many samples.",
                  "at most " + std::to_string(device.maxSamples), std::to_string(spec.atlas.samples)});
  }
  if (spec.atlas.size > device.maxTextureSize) {
    problems.add({ProblemCode::invalidValue, "/atlas/size", "The device has no textures as large as that.",
                  "at most " + std::to_string(device.maxTextureSize), std::to_string(spec.atlas.size)});
  }
  if (problems.empty()) return Done{};
  return std::move(problems).take();
}

Status checkAtlas(const ShadowPlan& plan, int samples) {
  constexpr std::int64_t kDepthBytes = 4;
  constexpr std::int64_t kMomentBytes = 16;
  const bool moments = std::any_of(plan.tiles.begin(), plan.tiles.end(), isBlurred);
  const std::int64_t texels = std::int64_t{plan.atlasWidth} * plan.atlasHeight;
  const std::int64_t bytes = texels * (kDepthBytes * samples + (moments ? kMomentBytes : 0));
  if (bytes <= kLimits.maxAtlasBytes) return Done{};
  return Problem{ProblemCode::tooLarge, "/atlas/size",
                 "The shadow atlas would take more memory than a frame may have; samples and moments count.",
                 std::to_string(kLimits.maxAtlasBytes) + " bytes", std::to_string(bytes) + " bytes"};
}

} // namespace gnomon
