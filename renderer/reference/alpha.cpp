#include "renderer/reference/alpha.h"

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

} // namespace

double textureAlpha(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv) {
  const auto column = [&](double x) { return wrapped(x, alpha.width(), use.wrapS); };
  const auto row = [&](double y) { return wrapped(y, alpha.height(), use.wrapT); };
  const auto texel = [&](std::size_t x, std::size_t y) { return alpha.at(x, y) / 255.0; };
  const glm::dvec2 place = uv * glm::dvec2(alpha.width(), alpha.height());
  if (use.nearest) return texel(column(std::floor(place.x)), row(std::floor(place.y)));
  const glm::dvec2 low = glm::floor(place - 0.5);
  const glm::dvec2 share = place - 0.5 - low;
  const std::size_t left = column(low.x), right = column(low.x + 1);
  const std::size_t above = row(low.y), below = row(low.y + 1);
  return glm::mix(glm::mix(texel(left, above), texel(right, above), share.x),
                  glm::mix(texel(left, below), texel(right, below), share.x), share.y);
}

double alphaAt(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const Barycentric& at) {
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
    alpha *= textureAlpha(*tree.masks[static_cast<std::size_t>(use.image)], use,
                          moved(at.mix(glm::dvec2(a.*uv), glm::dvec2(b.*uv), glm::dvec2(c.*uv)), use.transform));
  }
  return alpha;
}

} // namespace gnomon
