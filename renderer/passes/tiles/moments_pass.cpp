#include "renderer/passes/tiles/moments_pass.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/device/shader_data.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/texture.h"

namespace gnomon {
namespace {

/// Texels to each side that the blur takes whole: (x, y).
glm::vec2 blurOf(const ShadowTile& tile) {
  if (tile.filter.radius <= 0) return glm::vec2(0.5f * static_cast<float>(tile.filter.size - 1));
  const glm::dvec2 texels = tile.space.fit.radius / tile.space.fit.texelSize;
  return glm::vec2(glm::max(glm::dvec2(0.0), texels - 0.5));
}

struct Step {
  bool alongX = true;
  const gl::Texture& from;
  const gl::Framebuffer& to;
  Rect viewport;
};

Status blur(const PassInputs& inputs, const ShadowTile& tile, int samples, const Step& step) {
  std::vector<std::string> defines{"FILTER_KIND " + std::to_string(filterKind(tile.filter))};
  if (step.alongX) defines.emplace_back("ALONG_X");
  if (step.alongX && samples > 1) defines.push_back("ATLAS_SAMPLES " + std::to_string(samples));
  const auto program = inputs.programs.get({"fullscreen.vert", "moments.frag", std::move(defines)});
  if (!program) return program.problems();
  const glm::vec2 texels = blurOf(tile);
  const bool perspective = tile.space.fit.perspective;
  (*program)->set(GNOMON_MOMENT_TILE, glm::ivec4(tile.rect.x, tile.rect.y, tile.rect.width, tile.rect.height));
  (*program)->set(GNOMON_MOMENT_BLUR, glm::vec4(step.alongX ? texels.x : texels.y, perspective ? tile.near : 0.0,
                                                perspective ? tile.far : 0.0, 0.0));
  gl::drawBands(**program, {.framebuffer = step.to.id(), .viewport = step.viewport, .scissor = step.viewport},
                {{0, &step.from}});
  return Done{};
}

} // namespace

Status blurMoments(const PassInputs& inputs, const std::vector<const ShadowTile*>& tiles, AtlasTextures& atlas) {
  int side = 0;
  for (const ShadowTile* tile : tiles) side = std::max(side, tile->rect.width);
  if (side == 0) return Done{};
  const gl::Texture rows({GL_RGBA32F, side, side}, "blurred rows");
  auto target = gl::Framebuffer::create({{{&atlas.moments}}, {}}, "shadow moments");
  if (!target) return target.problems();
  auto between = gl::Framebuffer::create({{{&rows}}, {}}, "blurred rows");
  if (!between) return between.problems();
  const int samples = std::max(1, atlas.depth.shape().samples);
  for (const ShadowTile* tile : tiles) {
    const Rect alone{0, 0, tile->rect.width, tile->rect.height};
    if (Status along = blur(inputs, *tile, samples, {true, atlas.depth, *between, alone}); !along) return along;
    if (Status up = blur(inputs, *tile, samples, {false, rows, *target, tile->rect}); !up) return up;
  }
  return Done{};
}

} // namespace gnomon
