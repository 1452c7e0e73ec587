#include "renderer/passes/gpu_environments.h"

#include <algorithm>
#include <span>

#include "renderer/shaders/shared/environment_squares.h"

namespace gnomon {

const gl::Texture& GpuEnvironments::get(const std::shared_ptr<const Environment>& environment) {
  entries_.remove_if([](const Entry& entry) { return entry.environment.expired(); });
  const auto known = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.environment.lock() == environment; });
  if (known != entries_.end()) return known->texels;
  gl::Texture texels({GL_RGBA32F, GNOMON_ENVIRONMENT_WIDTH, GNOMON_ENVIRONMENT_HEIGHT}, "environment");
  texels.write(0, {GL_RGBA, GL_FLOAT}, std::as_bytes(std::span(environment->prefiltered.texels)));
  entries_.push_front({environment, std::move(texels)});
  return entries_.front().texels;
}

EnvironmentBinding::EnvironmentBinding(const gl::Texture& texels, GLuint unit)
    : between_({GL_LINEAR, GL_LINEAR}, "environment") {
  texels.bind(unit);
  between_.bind(unit);
}

} // namespace gnomon
