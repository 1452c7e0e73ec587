#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/light.h"
#include "renderer/device/shader_data.h"
#include "renderer/reference/trace.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/volume/volume_light.h"

namespace gnomon {

/// A frame's lights as they shine on volumes. Must not outlive the frame.
struct ShiningLights {
  std::vector<shared::LightData> data; ///< relative to `origin`
  glm::dvec3 origin{0};
  std::span<const Light> lights;
  std::vector<int> shadowing; ///< those whose shadows fall on volumes
};

/// `origin`: metres; a place near to what they shine on.
ShiningLights shiningLights(const ResolvedFrame& frame, const glm::dvec3& origin);

/// A text that differs where the lights do.
std::string lightsText(const ShiningLights& shining);

/// A text that differs where what casts shadows on volumes does, of one file's frames.
std::string castersText(const ResolvedFrame& frame);

/// The share of each light that surfaces let through to each point of a volume's map; empty for lights that all of
/// reaches it.
using LightShares = std::vector<std::vector<float>>;

/// By rays to the middle of each light that casts shadows. `size`: of the volume's map.
LightShares surfaceShares(const ShiningLights& shining, const TraceInput& rays, const VolumeSpace& space,
                          const glm::ivec3& size);

/// One a light. Refer to both, which must outlive them. `shares`: empty = no surface blocks any light.
std::vector<ArrivalAt> arrivalsOf(const ShiningLights& shining, const LightShares& shares);

} // namespace gnomon
