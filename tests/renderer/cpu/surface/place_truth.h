#pragma once

#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/surface/made_scene.h"
#include "tests/renderer/cpu/surface/sampled_truth.h"

namespace gnomon::cpu {

/// Weights of a triangle's corners where a line of sight meets its plane.
inline glm::dvec3 weightsAt(const FrameScene& scene, const CameraView& view, const MadeScene::Seen& seen,
                            const glm::dvec2& place) {
  const glm::dvec2 ndc = place / glm::dvec2(scene.width, scene.height) * 2.0 - 1.0;
  const glm::dvec3 from = view.perspective ? glm::dvec3(0) : pointAt(view, ndc, 0);
  const glm::dvec3 way = pointAt(view, ndc, 1) - from;
  const glm::dvec3 edge1 = seen.corners[1] - seen.corners[0], edge2 = seen.corners[2] - seen.corners[0];
  const glm::dvec3 p = glm::inverse(glm::dmat3(edge1, edge2, -way)) * (from - seen.corners[0]);
  return {1 - p.x - p.y, p.x, p.y};
}

/// What materials read of a place, in double precision.
class Place {
 public:
  Place(const MadeScene& made, const MadeScene::Seen& seen)
      : scene_(made.frameScene()),
        textures_(made.textures()),
        material_(scene_.scene.materials[seen.instance]),
        seen_(seen),
        right_((weightsAt(scene_, made.view(), seen, seen.place + glm::dvec2(kStep, 0)) - seen.weights) / kStep),
        up_((weightsAt(scene_, made.view(), seen, seen.place + glm::dvec2(0, kStep)) - seen.weights) / kStep) {}

  glm::dvec2 coordinates(const TextureUse& use, const glm::dvec3& weights, double offset) const {
    glm::dvec2 uv(0);
    for (int c = 0; c < 3; ++c) {
      const VertexAttributes& vertex = scene_.scene.attributes[seen_.vertices[c]];
      uv += glm::dvec2(use.texCoord == 0 ? vertex.uv0 : vertex.uv1) * weights[c];
    }
    if (!use.transform) return uv;
    return glm::dmat2(use.transform->axes) * uv + glm::dvec2(use.transform->offset) * offset;
  }
  glm::vec4 texel(const std::optional<TextureUse>& use, bool srgb) const {
    if (!use) return glm::vec4(1);
    return glm::vec4(sampledTruth(textures_.of(use->image, srgb).from(0), *use, coordinates(*use, seen_.weights, 1),
                                  coordinates(*use, right_, 0), coordinates(*use, up_, 0)));
  }
  glm::vec3 normal(const glm::vec3& face) const {
    glm::dvec3 local(0);
    glm::dvec4 tangent(0);
    for (int c = 0; c < 3; ++c) {
      const VertexAttributes& vertex = scene_.scene.attributes[seen_.vertices[c]];
      local += glm::dvec3(vertex.normal) * seen_.weights[c];
      tangent += glm::dvec4(vertex.tangent) * seen_.weights[c];
    }
    const PlacedInstance& placed = scene_.geometry.instances[seen_.instance];
    glm::vec3 n(glm::normalize(placed.normalFromLocal * local));
    if (material_.doubleSided && glm::dot(n, face) < 0) n = -n;
    if (!material_.normal) return n;
    glm::vec3 direction = glm::vec3(texel(material_.normal, false)) * 2.0f - 1.0f;
    direction *= glm::vec3(material_.normalScale, material_.normalScale, 1.0f);
    if (seen_.instance % 2 == 1) {
      const glm::vec3 turned(glm::dmat3(placed.relativeFromLocal) * glm::dvec3(tangent));
      return glm::normalize(shared::bentByTangent(n, turned, static_cast<float>(tangent.w), direction));
    }
    const auto moved = [&](const glm::dvec3& weights) {
      return glm::vec3(seen_.corners[0] * weights[0] + seen_.corners[1] * weights[1] + seen_.corners[2] * weights[2]);
    };
    return glm::normalize(shared::bentBySteps(n, moved(right_), moved(up_),
                                              glm::vec2(coordinates(*material_.normal, right_, 0)),
                                              glm::vec2(coordinates(*material_.normal, up_, 0)), direction));
  }
  double alpha() const {
    double alpha = 0;
    for (int c = 0; c < 3; ++c)
      alpha += scene_.scene.attributes[seen_.vertices[c]].color.w / 65535.0 * seen_.weights[c];
    if (!material_.hasVertexColors) alpha = 1;
    return alpha * static_cast<double>(material_.baseColorFactor.a * texel(material_.baseColor, true).a);
  }
  const Material& material() const { return material_; }

 private:
  static constexpr double kStep = 1e-4; ///< pixels

  const FrameScene& scene_;
  const Textures& textures_;
  const Material& material_;
  const MadeScene::Seen& seen_;
  glm::dvec3 right_, up_; ///< how weights change
};

} // namespace gnomon::cpu
