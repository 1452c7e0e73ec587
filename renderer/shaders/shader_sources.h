#pragma once

#include <span>
#include <string_view>

namespace gnomon {

/// One shader file as it is built into the program: its includes expanded once each, with #line directives whose
/// source number is given by comments "// source 1: common_shadow.glsl" (0 is the file itself). No #version.
struct ShaderSource {
  std::string_view name; ///< "view.frag"
  std::string_view text;
};

/// All .vert, .frag and .comp files.
std::span<const ShaderSource> shaderSources();

/// The text of one; empty when there is none of that name.
std::string_view shaderSource(std::string_view name);

} // namespace gnomon
