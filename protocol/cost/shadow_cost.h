#pragma once

#include <cstdint>
#include <vector>

#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

/// What shadows cost by technique, from counts alone: nanoseconds that two cores take about, as in frame_cost.h.
namespace gnomon {

/// What a scene brings to each of its frames.
struct SceneCounts {
  std::uint64_t triangles = 0;     ///< of the default glTF scene
  std::vector<LightType> lights{}; ///< the scene's own; they count where a request names none
  std::uint64_t holed = 0;         ///< triangles whose materials have holes, or let light through
};

/// What draws, as far as costs differ.
enum class DeviceKind { processor, softwareGl, gpu };
DeviceKind kindOf(const RendererInfo& info);

double pixelsOf(const FrameSpec& spec);

/// Of drawing all tiles of `light` as if it showed in all of the picture.
double tileCost(const Light& light, const FrameSpec& spec, std::uint64_t triangles);
/// Of reading a map for one pixel.
double lookupOfPixel(const Filter& filter);
/// Of finding a light's shadow by rays in every pixel.
double rayCost(const Light& light, const FrameSpec& spec, const SceneCounts& scene);

/// What technique auto is for a light: rays where they cost at most kRaysPerMap times the map. A pure function, so that
/// the same request gives the same frame; neither the camera nor a clock has a part in it, so that a sequence keeps one
/// technique. Filters and biases belong to maps: a light that sets one gets a map. REQUIRES: the light's shadow is set.
TechniqueChoice chooseTechnique(const Light& light, const FrameSpec& spec, const SceneCounts& scene, DeviceKind device);

inline constexpr double kRaysPerMap = 2;

} // namespace gnomon
