#pragma once

#include <list>
#include <memory>

#include "renderer/environment/environment.h"
#include "renderer/gl/texture.h"

namespace gnomon {

/// Uploaded atlases of environments: each as long as something else holds it.
class GpuEnvironments {
 public:
  /// RGBA32F. Made now if need be; valid until the next call that the environment is not alive for.
  const gl::Texture& get(const std::shared_ptr<const Environment>& environment);

 private:
  struct Entry {
    std::weak_ptr<const Environment> environment;
    gl::Texture texels;
  };
  std::list<Entry> entries_;
};

/// An atlas, bound to a texture unit with linear filters. Lives as long as that is drawn with.
class EnvironmentBinding {
 public:
  EnvironmentBinding(const gl::Texture& texels, GLuint unit);

 private:
  gl::Sampler between_;
};

} // namespace gnomon
