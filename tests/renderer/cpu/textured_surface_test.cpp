#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/made_scene.h"
#include "tests/renderer/cpu/sampled_truth.h"

namespace gnomon::cpu {
namespace {

TextureUse useOf(int image, int texCoord, bool transformed) {
  TextureUse use;
  use.image = image;
  use.texCoord = texCoord;
  if (transformed) use.transform = TextureTransform{glm::mat2(0.5f, 0.25f, -0.75f, 1.0f), {0.125f, 0.375f}};
  return use;
}

/// Those of odd numbers have tangents of their own (MadeScene).
std::vector<Material> texturedMaterials() {
  std::vector<Material> materials(5);
  materials[0].baseColor = useOf(0, 0, false);
  materials[0].normal = useOf(1, 0, true);
  materials[1].normal = useOf(1, 1, false);
  materials[1].normalScale = 0.5f;
  materials[1].doubleSided = true;
  materials[1].baseColor = useOf(1, 1, true);
  materials[2].specularGlossiness = SpecularGlossiness{{0.9f, 0.8f, 0.7f}, 0.6f};
  materials[2].metallicRoughness = useOf(1, 0, false);
  materials[2].baseColor = useOf(0, 1, false);
  materials[3].metallicRoughness = useOf(0, 1, true);
  materials[3].occlusion = useOf(1, 0, false);
  materials[3].occlusionStrength = 0.75f;
  materials[3].emissive = useOf(0, 0, false);
  materials[3].emissiveFactor = {1, 2, 3};
  materials[4].unlit = true;
  materials[4].baseColor = useOf(0, 0, true);
  return materials;
}

/// Weights of a triangle's corners where a line of sight meets its plane.
glm::dvec3 weightsAt(const FrameScene& scene, const CameraView& view, const MadeScene::Seen& seen,
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
    return glm::vec4(sampledTruth(textures_.of(use->image, srgb), *use, coordinates(*use, seen_.weights, 1),
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
  const Material& material() const { return material_; }

 private:
  static constexpr double kStep = 1e-4; ///< pixels

  const FrameScene& scene_;
  const Textures& textures_;
  const Material& material_;
  const MadeScene::Seen& seen_;
  glm::dvec3 right_, up_; ///< how weights change
};

/// By SurfaceNumber, from kNormal on.
std::vector<float> truthOf(const Place& place, const glm::vec3& face) {
  const Material& material = place.material();
  glm::vec3 color = glm::vec3(material.baseColorFactor) * glm::vec3(place.texel(material.baseColor, true));
  const glm::vec4 factor = place.texel(material.metallicRoughness, material.specularGlossiness.has_value());
  float metallic = material.metallicFactor * factor.b, roughness = material.roughnessFactor * factor.g;
  if (const auto& glossy = material.specularGlossiness) {
    const glm::vec3 specular = glossy->specularFactor * glm::vec3(factor);
    metallic = shared::metallicOf(color, specular);
    color = shared::baseColorOf(color, specular, metallic);
    roughness = 1 - glossy->glossinessFactor * factor.a;
  }
  glm::vec3 emission = material.emissiveFactor * glm::vec3(place.texel(material.emissive, true));
  if (material.unlit) emission = color;
  const float occlusion = 1 + material.occlusionStrength * (place.texel(material.occlusion, false).r - 1);
  const glm::vec3 n = place.normal(face);
  return {n.x, n.y, n.z, color.r, color.g, color.b, emission.r, emission.g, emission.b, metallic, roughness, occlusion};
}

TEST(CpuTexturedSurface, ReadsItsTexturesWhereThePictureShowsThem) {
  constexpr SurfaceNumber kCompared[] = {kNormal,
                                         SurfaceNumber(kNormal + 1),
                                         SurfaceNumber(kNormal + 2),
                                         kBaseColor,
                                         SurfaceNumber(kBaseColor + 1),
                                         SurfaceNumber(kBaseColor + 2),
                                         kEmission,
                                         SurfaceNumber(kEmission + 1),
                                         SurfaceNumber(kEmission + 2),
                                         kMetallic,
                                         kRoughness,
                                         kOcclusion};
  for (const bool perspective : {true, false}) {
    MadeScene made(perspective);
    made.place(texturedMaterials(), {noise(32, 64), noise(19, 16)});
    const std::vector<MadeScene::Seen> seen = made.seen(16'000);
    const FragmentInput in = made.fragmentsOf(seen);
    onEachInstructionSet([&] {
      const NumberTable out = surfacesByLanes(made.frameScene(), in);
      std::vector<std::size_t> off(std::size(kCompared));
      for (std::size_t row = 0; row < seen.size(); ++row) {
        const std::vector<float> truth = truthOf(Place(made, seen[row]), out.triple(row, kFace));
        for (std::size_t i = 0; i < truth.size(); ++i) {
          off[i] += std::abs(out.at(row, kCompared[i]) - truth[i]) < 0.01f ? 0 : 1;
        }
      }
      // Few lie where levels, axes of a normal map or the brightness of metal change at once.
      for (std::size_t i = 0; i < off.size(); ++i) EXPECT_LE(off[i], seen.size() / 500) << kCompared[i];
    });
  }
}

} // namespace
} // namespace gnomon::cpu
