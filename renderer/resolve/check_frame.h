#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/base/result.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/limits.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// JSON Pointer to the shadow of a light in a spec as it was asked for.
std::string shadowPlace(const FrameSpec& asked, int light);

/// What only the device can refuse.
Status checkDevice(const FrameSpec& spec, const RendererInfo& device);

/// A problem where a planned atlas takes more memory than a frame may have.
Status checkAtlas(const ShadowPlan& plan, int samples);

/// A problem for each light whose technique can't serve all that casts from it: shadow volumes have no holes, so that
/// every caster must be opaque. `asked`: the spec before it was settled, whose fields are pointed at.
Status checkTechniques(const FrameSpec& asked, const Scene& scene, const ResolvedFrame& frame);

/// A problem where what is kept of each pixel takes more than a frame may have for it (Limits::maxVisibilityBytes).
inline Status checkVisibilityBytes(std::int64_t bytes, const std::string& pointer, const std::string& detail) {
  if (bytes <= kLimits.maxVisibilityBytes) return Done{};
  return Problem{ProblemCode::tooLarge, pointer, detail, std::to_string(kLimits.maxVisibilityBytes) + " bytes",
                 std::to_string(bytes) + " bytes"};
}

/// Of visibility layers: two bytes for each light at each sample of a picture.
inline std::int64_t visibilityBytes(int width, int height, std::size_t samples, std::size_t lights) {
  return std::int64_t{2} * width * height * static_cast<std::int64_t>(samples * lights);
}

inline Status checkVisibilityBytes(int width, int height, std::size_t samples, std::size_t lights) {
  return checkVisibilityBytes(
      visibilityBytes(width, height, samples, lights), "/lights",
      "What rays and shadow volumes decide for every sample and light would take more memory than a frame may have.");
}

} // namespace gnomon
