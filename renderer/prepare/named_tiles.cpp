#include "renderer/prepare/named_tiles.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/srgb.h"
#include "renderer/image/digits.h"
#include "renderer/shaders/shared/frame_types.h"

namespace gnomon {
namespace {

using glm::vec3;
constexpr std::array kTints{GNOMON_TINTS_0_3, GNOMON_TINTS_4_7};

std::uint8_t srgb(float linear) {
  return static_cast<std::uint8_t>(std::lround(srgbOf(linear) * 255.0f));
}

Rgb tintOf(int tile) {
  const vec3& tint = kTints[static_cast<std::size_t>(tile) % kTints.size()];
  return {srgb(tint.r), srgb(tint.g), srgb(tint.b)};
}

Image asRgb(const Image& grey) {
  Image picture{grey.width, grey.height, {"R", "G", "B"}, {}};
  std::visit(
      [&](const auto& from) {
        std::remove_cvref_t<decltype(from)> to(from.size() * 3);
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i / 3];
        picture.pixels = std::move(to);
      },
      grey.pixels);
  return picture;
}

/// `rect` counts rows from the picture's lower edge.
void nameTile(Image& picture, const Rect& rect, const std::string& name, const Rgb& tint) {
  const int top = picture.height - rect.y - rect.height;
  const int line = std::max(1, rect.width / 256);
  fillRect(picture, rect.x, top, rect.width, line, tint);
  fillRect(picture, rect.x, top + rect.height - line, rect.width, line, tint);
  fillRect(picture, rect.x, top, line, rect.height, tint);
  fillRect(picture, rect.x + rect.width - line, top, line, rect.height, tint);

  const int scale = std::max(1, rect.width / 128);
  const int margin = 2 * scale;
  fillRect(picture, rect.x, top, digitsWidth(name, scale) + 2 * margin, kDigitHeight * scale + 2 * margin, tint);
  drawDigits(picture, name, {rect.x + margin, top + margin, scale}, {0, 0, 0});
}

} // namespace

Image namedTiles(const Image& grey, const ShadowPlan& plan) {
  Image picture = asRgb(grey);
  for (const PlannedLight& light : plan.lights) {
    for (int i = 0; i < light.tileCount; ++i) {
      const Rect& rect = plan.tiles[static_cast<std::size_t>(light.firstTile + i)].rect;
      if (rect.width == 0) continue;
      nameTile(picture, rect, std::to_string(light.light) + "." + std::to_string(i), tintOf(i));
    }
  }
  return picture;
}

} // namespace gnomon
