#pragma once

#include <optional>

#include "protocol/output_options.h"
#include "renderer/gl/program.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The #defines that a masked material needs where only its outline matters; none for an opaque one (null).
std::vector<std::string> maskDefines(const Material* material);

/// What a shading program is made for.
struct ShadeVariant {
  View view = View::color;
  bool encoded = true; ///< for an 8-bit picture: tone mapped, normals and depths brought into 0..1
  ToneMapping toneMapping = ToneMapping::aces;
  bool tangents = false; ///< the primitive brings its own
  int lights = 0;
  bool punctual = false; ///< some light is a spot or a point
  /// Texels a side that every shadow's filter compares; 0 = they differ; absent = nothing casts a shadow.
  std::optional<int> filterSize{};
};

gl::ProgramSource shadeProgram(const Material& material, const ShadeVariant& variant);

} // namespace gnomon
