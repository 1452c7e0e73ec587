#include "renderer/reference/alpha.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/tree.h"

namespace gnomon {
namespace {

/// The texel that texture coordinates outside of the image mean (OpenGL 4.5, table 8.20).
std::size_t wrapped(double texel, int size, Wrap wrap) {
  const double n = size;
  if (texel >= 0 && texel < n) return static_cast<std::size_t>(texel);
  if (wrap == Wrap::repeat) texel -= std::floor(texel / n) * n;
  if (wrap == Wrap::mirroredRepeat) {
    texel -= std::floor(texel / (2 * n)) * (2 * n);
    if (texel >= n) texel = 2 * n - 1 - texel;
  }
  if (!(texel > 0)) return 0; // not a number, too
  return static_cast<std::size_t>(std::min(texel, n - 1));
}

glm::dvec2 moved(const glm::dvec2& uv, const std::optional<TextureTransform>& transform) {
  return transform ? glm::dmat2(transform->axes) * uv + glm::dvec2(transform->offset) : uv;
}

/// Filtered, or the texel that holds the place.
double texelsAt(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv, bool nearest) {
  const auto column = [&](double x) { return wrapped(x, alpha.width(), use.wrapS); };
  const auto row = [&](double y) { return wrapped(y, alpha.height(), use.wrapT); };
  const auto texel = [&](std::size_t x, std::size_t y) { return alpha.at(x, y) / 255.0; };
  const glm::dvec2 place = uv * glm::dvec2(alpha.width(), alpha.height());
  if (nearest) return texel(column(std::floor(place.x)), row(std::floor(place.y)));
  const glm::dvec2 low = glm::floor(place - 0.5);
  const glm::dvec2 share = place - 0.5 - low;
  const std::size_t left = column(low.x), right = column(low.x + 1);
  const std::size_t above = row(low.y), below = row(low.y + 1);
  return glm::mix(glm::mix(texel(left, above), texel(right, above), share.x),
                  glm::mix(texel(left, below), texel(right, below), share.x), share.y);
}

/// Alpha of a triangle's material anywhere in its plane. `ofTexture(alpha, use, uvAt)` reads the texture, whose
/// coordinates are uvAt(place).
template <class OfTexture>
double alphaOf(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const Barycentric& at,
               OfTexture ofTexture) {
  const Primitive& primitive = tree.primitive(instance);
  const Material& material = tree.material(instance);
  const std::uint32_t* corner = &tree.scene->indices[primitive.firstIndex + 3 * std::size_t{triangle}];
  const VertexAttributes* vertices = &tree.scene->attributes[primitive.baseVertex];
  const VertexAttributes& a = vertices[corner[0]];
  const VertexAttributes& b = vertices[corner[1]];
  const VertexAttributes& c = vertices[corner[2]];
  double alpha = material.baseColorFactor.a;
  if (material.uniformAlpha) return alpha;
  if (material.hasVertexColors) alpha *= at.mix<double>(a.color.a, b.color.a, c.color.a) / 65535.0;
  if (material.baseColor && material.baseColor->image >= 0) {
    const TextureUse& use = *material.baseColor;
    const auto uv = use.texCoord == 1 ? &VertexAttributes::uv1 : &VertexAttributes::uv0;
    alpha *= ofTexture(*tree.masks[static_cast<std::size_t>(use.image)], use, [&](const Barycentric& place) {
      return moved(place.mix(glm::dvec2(a.*uv), glm::dvec2(b.*uv), glm::dvec2(c.*uv)), use.transform);
    });
  }
  return alpha;
}

} // namespace

double textureAlpha(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv) {
  return texelsAt(alpha, use, uv, use.nearest);
}

double textureAlpha(const AlphaLevels& alpha, const TextureUse& use, const TexturePlace& place) {
  const glm::dvec2 size(alpha.largest().width(), alpha.largest().height());
  const glm::dvec2 right = place.right * size, below = place.below * size;
  const double squared = std::max(glm::dot(right, right), glm::dot(below, below));
  if (!(squared > 1)) return textureAlpha(alpha.largest(), use, place.uv); // not a number, too
  const bool nearest = takesNearestTexel(use.minFilter);
  if (!takesLevels(use.minFilter)) return texelsAt(alpha.largest(), use, place.uv, nearest);
  const double halvings = std::min(0.5 * std::log2(squared), static_cast<double>(alpha.count() - 1));
  const auto level = [&](double number) {
    return texelsAt(alpha.of(static_cast<std::size_t>(number)), use, place.uv, nearest);
  };
  if (!mixesLevels(use.minFilter)) return level(std::ceil(halvings - 0.5));
  const double larger = std::floor(halvings);
  return glm::mix(level(larger), level(std::ceil(halvings)), halvings - larger);
}

double alphaAt(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const Barycentric& at) {
  return alphaOf(tree, instance, triangle, at, [&](const AlphaLevels& alpha, const TextureUse& use, const auto& uvAt) {
    return textureAlpha(alpha.largest(), use, uvAt(at));
  });
}

double alphaSeen(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle,
                 const SeenPlace& place) {
  const auto read = [&](const AlphaLevels& alpha, const TextureUse& use, const auto& uvAt) {
    const glm::dvec2 uv = uvAt(place.at);
    return textureAlpha(alpha, use, TexturePlace{uv, uvAt(place.right) - uv, uvAt(place.below) - uv});
  };
  return alphaOf(tree, instance, triangle, place.at, read);
}

} // namespace gnomon
