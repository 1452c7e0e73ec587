#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/surface/place_truth.h"
#include "tests/renderer/cpu/surface/sampled_truth.h"

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
  std::vector<Material> materials(8);
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
  // Read alike, and each time alike but for one thing.
  Material& alike = materials[5];
  alike.baseColor = alike.metallicRoughness = alike.normal = alike.occlusion = alike.emissive = useOf(0, 0, false);
  alike.emissiveFactor = {1, 1, 1};
  materials[6] = alike;
  materials[6].metallicRoughness->wrapS = Wrap::clampToEdge;
  materials[6].normal->wrapT = Wrap::mirroredRepeat;
  materials[6].occlusion->minFilter = MinFilter::linearMipmapNearest;
  materials[6].emissive->nearest = true;
  materials[7] = alike;
  materials[7].metallicRoughness = useOf(2, 0, false);
  materials[7].normal = useOf(3, 0, false);
  materials[7].occlusion = useOf(3, 1, false);
  materials[7].emissive = useOf(3, 1, true);
  return materials;
}

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
    made.place(texturedMaterials(), {noise(32, 64), noise(19, 16), noise(32, 16), noise(64, 16)});
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
      for (std::size_t i = 0; i < off.size(); ++i) EXPECT_LE(off[i], seen.size() / 2000) << kCompared[i];
    });
  }
}

} // namespace
} // namespace gnomon::cpu
