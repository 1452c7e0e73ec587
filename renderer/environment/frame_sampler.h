#pragma once

#include <memory>

#include "renderer/environment/environment.h"
#include "renderer/environment/environment_sampler.h"

namespace gnomon {

/// Light that comes from everywhere, as rays ask about it.
struct SkyLight {
  std::shared_ptr<const EnvironmentSampler> sampler;
  glm::mat3 mapFromWorld{1}; ///< a turn
};

/// Of what a frame is lit by; null = the studio. The sampler is made once for an environment that frames share, and
/// kept while it is. Any thread.
SkyLight skyLightOf(const FrameEnvironment* environment);

} // namespace gnomon
