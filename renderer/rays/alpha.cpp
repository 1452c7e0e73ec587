#include "renderer/rays/alpha.h"

#include "renderer/rays/tree.h"
#include "renderer/scene/mask_coverage.h"
#include "renderer/scene/texture_reads.h"

namespace gnomon {
namespace {

glm::dvec2 moved(const glm::dvec2& uv, const std::optional<TextureTransform>& transform) {
  return transform ? glm::dmat2(transform->axes) * uv + glm::dvec2(transform->offset) : uv;
}

/// A triangle of a material with holes, and its corners.
struct Holed {
  const Material& material;
  const VertexAttributes &a, &b, &c;

  Holed(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle)
      : Holed(tree.material(instance), tree.vertices(instance, triangle)) {}

  /// What the texture's alpha is multiplied by, anywhere in the triangle's plane.
  double factor(const Barycentric& at) const {
    const double own = material.baseColorFactor.a;
    if (!material.hasVertexColors) return own;
    return own * at.mix<double>(a.color.a, b.color.a, c.color.a) / 65535.0;
  }

  /// The texture that alpha depends on; null where it depends on none.
  const TextureUse* texture() const { return readsAlpha(material) ? &*material.baseColor : nullptr; }

  /// Where that is read.
  glm::dvec2 uv(const Barycentric& at) const {
    const auto set = texture()->texCoord == 1 ? &VertexAttributes::uv1 : &VertexAttributes::uv0;
    return moved(at.mix(glm::dvec2(a.*set), glm::dvec2(b.*set), glm::dvec2(c.*set)), texture()->transform);
  }

 private:
  Holed(const Material& of, const std::array<const VertexAttributes*, 3>& corners)
      : material(of), a(*corners[0]), b(*corners[1]), c(*corners[2]) {}
};

} // namespace

double alphaAt(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const Barycentric& at) {
  const Holed holed(tree, instance, triangle);
  const TextureUse* use = holed.texture();
  if (use == nullptr) return holed.factor(at);
  const AlphaLevels& alpha = *tree.masks[static_cast<std::size_t>(use->image)];
  return holed.factor(at) * textureAlpha(alpha.largest(), *use, holed.uv(at));
}

bool isFilled(const TracedScene::Tree& tree, std::uint32_t instance, std::uint32_t triangle, const SeenPlace& place) {
  const Holed holed(tree, instance, triangle);
  const double factor = holed.factor(place.at);
  const double cutoff = *holed.material.cutoff;
  const TextureUse* use = holed.texture();
  if (use == nullptr) return factor >= cutoff;
  const glm::dvec2 uv = holed.uv(place.at);
  const TexturePlace read{uv, holed.uv(place.right) - uv, holed.uv(place.below) - uv};
  const double alpha = textureAlpha(*tree.masks[static_cast<std::size_t>(use->image)], *use, read);
  const MaskCoverage* coverage = tree.coverage(instance);
  if (coverage == nullptr) return alpha * factor >= cutoff;
  return coverage->keeps({uv, halvingsAt(read, coverage->size()), alpha}, factor, cutoff);
}

} // namespace gnomon
