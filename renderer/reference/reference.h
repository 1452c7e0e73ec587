#pragma once

#include <vector>

#include "protocol/spec/debug_light.h"
#include "renderer/core/stop.h"
#include "renderer/environment/frame_sampler.h"
#include "renderer/rays/trace.h"

namespace gnomon {

/// The truth about one light in one frame, a value a pixel, the picture's first row on top.
struct LightReference {
  int light = 0;                      ///< index into the lights
  std::vector<float> visibility;      ///< V, 0..1
  std::vector<std::uint8_t> receiver; ///< 1 = counts: its surface receives shadows and faces the light
  std::vector<float> blockerDistance; ///< widths of the pixel, to what hides the light; infinity where V >= 0.5
};

/// The truth about a frame: what rays through the pixels' centres meet, and what light arrives there.
struct Reference {
  int width = 0; ///< pixels
  int height = 0;
  std::vector<SurfacePoint> surface; ///< one a pixel
  std::vector<float> pixelWidth;     ///< metres across a pixel at its surface; 0 where there is none
  std::vector<LightReference> lights;
  int samples = 0;         ///< rays a pixel towards lights that have a size
  double milliseconds = 0; ///< of tracing
};

/// Traces a frame for `lights` (indices). A problem of code `unavailable` where `progress` asked to stop.
Result<Reference> traceReference(const TraceInput& input, std::span<const int> lights, int samples,
                                 const Progress& progress = {});

/// Rays a pixel by which an environment's share is measured, at least.
inline constexpr int kEnvironmentReferenceSamples = 1024;

/// Traces a frame for its environment, as one light of index kEnvironmentLight: the share of its diffuse light that
/// arrives, by luminance. Which of its parts hides it is not found.
Result<Reference> traceReference(const TraceInput& input, const SkyLight& environment, int samples,
                                 const Progress& progress = {});

} // namespace gnomon
