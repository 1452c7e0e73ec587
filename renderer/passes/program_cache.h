#pragma once

#include <map>
#include <string>

#include "renderer/gl/program.h"

namespace gnomon {

/// Shader programs by their source, made when a scene first asks for them.
class ProgramCache {
 public:
  /// The program; valid as long as the cache. A backend problem where the driver refuses it.
  Result<const gl::Program*> get(const gl::ProgramSource& source);

 private:
  std::map<std::string, gl::Program> programs_;
};

} // namespace gnomon
