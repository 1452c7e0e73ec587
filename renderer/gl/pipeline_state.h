#pragma once

#include <array>
#include <optional>

#include "renderer/core/rect.h"
#include "renderer/gl/object.h"

namespace gnomon::gl {

struct DepthState {
  bool test = false;        ///< false = every fragment passes
  bool write = false;       ///< also masks clears of depth
  GLenum func = GL_GREATER; ///< reversed depth: nearer is greater

  bool operator==(const DepthState&) const = default;
};

/// Added to a triangle's depths: its steepest change over a pixel, and the least step that its depths can show, times
/// these. Depth is reversed: below 0 is farther.
struct DepthOffset {
  float slope = 0;
  float steps = 0;

  bool operator==(const DepthOffset&) const = default;
};

/// What a fragment that fails the depth test does to the stencil; nothing else changes it.
struct StencilState {
  GLenum frontDepthFail = GL_KEEP; ///< by the facing of its triangle
  GLenum backDepthFail = GL_KEEP;

  bool operator==(const StencilState&) const = default;
};

enum class Cull { none, back, front };
enum class FrontFace { counterClockwise, clockwise };

/// Everything that stands between a draw and its target. Also clears and copies depend on `scissor` and the masks.
/// What has no member is always off or at its neutral value: blending, logic operation,
/// dithering, primitive restart, rasterizer discard, depth range 0..1, window origin lower left,
/// clip depth 0..1.
struct PipelineState {
  GLuint framebuffer = 0;
  Rect viewport;
  std::optional<Rect> scissor{};
  DepthState depth{};
  std::optional<StencilState> stencil{}; ///< absent = off; clears of the stencil are never masked
  DepthOffset depthOffset{};
  bool depthClamp = false;
  Cull cull = Cull::none;
  FrontFace frontFace = FrontFace::counterClockwise;
  std::array<bool, 4> colorMask{true, true, true, true};
  bool multisample = false;    ///< false = samples, where the target has them, all get the pixel's one value
  std::optional<int> sample{}; ///< only this one of each pixel is drawn; with `multisample`. Absent = all
  bool srgbConversion = false; ///< true = linear colors written to an sRGB target are encoded, and blended as linear
  int clipDistances = 0;       ///< how many of gl_ClipDistance[0..7] cut

  bool operator==(const PipelineState&) const = default;
};

/// States all of it, whatever was stated before; nothing is ever restored.
void apply(const PipelineState& state);

} // namespace gnomon::gl
