#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shaders/shared/functions.h"
#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/surface/made_scene.h"

namespace gnomon::cpu {
namespace {

std::vector<Material> plainMaterials() {
  std::vector<Material> materials(6);
  materials[0].baseColorFactor = {0.5f, 0.25f, 0.75f, 1.0f};
  materials[0].metallicFactor = 0.25f;
  materials[1].doubleSided = true;
  materials[1].hasVertexColors = true;
  materials[2].emissiveFactor = {1.0f, 2.0f, 3.0f};
  materials[2].roughnessFactor = 0.125f;
  materials[3].unlit = true;
  materials[3].hasVertexColors = true;
  materials[4].specularGlossiness = SpecularGlossiness{{0.6f, 0.5f, 0.4f}, 0.7f};
  materials[5].transmission = 0.75f;
  materials[5].metallicFactor = 0.5f;
  materials[5].roughnessFactor = 0.4f;
  return materials;
}

/// What a place shows, in double precision where geometry is concerned.
struct Truth {
  glm::dvec3 relative, face, normal, baseColor, emission;
  double metallic = 0, roughness = 0;
};

Truth truthOf(const FrameScene& scene, const CameraView& view, const MadeScene::Seen& seen) {
  const Material& material = scene.scene.materials[seen.instance];
  Truth truth;
  truth.relative = seen.point();
  const glm::dvec3 toEye = view.perspective ? -glm::normalize(truth.relative) : -view.forward;
  truth.face = seen.normal() * (glm::dot(seen.normal(), toEye) < 0 ? -1.0 : 1.0);
  glm::dvec3 normal(0);
  glm::dvec3 color(0);
  for (int c = 0; c < 3; ++c) {
    const VertexAttributes& vertex = scene.scene.attributes[seen.vertices[c]];
    normal += glm::dvec3(vertex.normal) * seen.weights[c];
    color += glm::dvec3(vertex.color) / 65535.0 * seen.weights[c];
  }
  truth.normal = glm::normalize(scene.geometry.instances[seen.instance].normalFromLocal * normal);
  if (material.doubleSided && glm::dot(truth.normal, truth.face) < 0) truth.normal = -truth.normal;
  truth.baseColor = glm::dvec3(material.baseColorFactor) * (material.hasVertexColors ? color : glm::dvec3(1));
  truth.metallic = material.metallicFactor;
  truth.roughness = material.roughnessFactor;
  if (material.specularGlossiness) {
    const glm::vec3 diffuse(truth.baseColor), specular = material.specularGlossiness->specularFactor;
    truth.metallic = shared::metallicOf(diffuse, specular);
    truth.baseColor = shared::baseColorOf(diffuse, specular, static_cast<float>(truth.metallic));
    truth.roughness = 1.0 - material.specularGlossiness->glossinessFactor;
  }
  truth.emission = material.emissiveFactor;
  if (material.unlit) truth.emission = truth.baseColor;
  if (material.transmission > 0) {
    const double passing = material.transmission * (1 - truth.metallic);
    const float behind = shared::radianceOfEvenStudio(static_cast<float>(-toEye.y), material.roughnessFactor);
    truth.emission += truth.baseColor * passing * glm::dvec3(scene.frame.ambient) * static_cast<double>(behind);
    truth.baseColor *= 1 + (truth.metallic - 1) * passing;
  }
  return truth;
}

void expectTruth(bool perspective) {
  MadeScene made(perspective);
  made.place(plainMaterials());
  const std::vector<MadeScene::Seen> seen = made.seen(48'000);
  const FragmentInput in = made.fragmentsOf(seen);
  onEachInstructionSet([&] {
    const NumberTable out = surfacesByLanes(made.frameScene(), in);
    double place = 0, face = 0, normal = 0, color = 0, rest = 0;
    const auto worst = [](double& largest, double difference) {
      if (!(difference <= largest)) largest = difference; // not a number counts
    };
    for (std::size_t row = 0; row < seen.size(); ++row) {
      const Truth truth = truthOf(made.frameScene(), made.view(), seen[row]);
      const double depth = glm::dot(truth.relative, made.view().forward);
      worst(place, glm::length(glm::dvec3(out.triple(row, kRelative)) - truth.relative) / depth);
      worst(place, std::abs(static_cast<double>(out.at(row, kViewDepth)) - depth) / depth);
      worst(face, glm::length(glm::dvec3(out.triple(row, kFace)) - truth.face));
      worst(normal, glm::length(glm::dvec3(out.triple(row, kNormal)) - truth.normal));
      worst(color, glm::length(glm::dvec3(out.triple(row, kBaseColor)) - truth.baseColor));
      worst(color, glm::length(glm::dvec3(out.triple(row, kEmission)) - truth.emission));
      worst(rest, std::abs(static_cast<double>(out.at(row, kMetallic)) - truth.metallic));
      worst(rest, std::abs(static_cast<double>(out.at(row, kRoughness)) - truth.roughness));
      worst(rest, std::abs(static_cast<double>(out.at(row, kOcclusion)) - 1.0));
      EXPECT_EQ(out.at(row, kUnlit) == 1.0f, made.frameScene().scene.materials[seen[row].instance].unlit);
      EXPECT_EQ(out.at(row, kGroupBit), static_cast<float>(1u << seen[row].instance));
    }
    EXPECT_LT(place, 2e-5);
    EXPECT_LT(face, 1e-5);
    // Corners whose normals point opposite ways nearly cancel each other between them.
    EXPECT_LT(normal, 1e-2);
    EXPECT_LT(color, 1e-3);
    EXPECT_LT(rest, 1e-3);
  });
}

TEST(CpuSurface, ShowsWhatAPerspectiveCameraSees) {
  expectTruth(true);
}

TEST(CpuSurface, ShowsWhatAnOrthographicCameraSees) {
  expectTruth(false);
}

TEST(CpuSurface, IsFiniteOfTrianglesSeenEdgeOnOrWithoutArea) {
  MadeScene made(true);
  made.place(plainMaterials());
  FragmentInput in = made.fragmentsOf(made.seen(4800));
  // Any triangle at any place: most of them lie elsewhere, some behind the eye.
  std::reverse(in.triangles.begin(), in.triangles.end());
  onEachInstructionSet([&] {
    const NumberTable out = surfacesByLanes(made.frameScene(), in);
    for (const float number : out.numbers) ASSERT_TRUE(std::isfinite(number));
  });
}

/// Packets of sixteen places that show one triangle.
std::size_t packetsOfOne(const std::vector<MadeScene::Seen>& seen) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < seen.size(); row += 16) {
    const auto isOther = [&](const MadeScene::Seen& other) { return other.triangle != seen[row].triangle; };
    const auto first = seen.begin() + static_cast<std::ptrdiff_t>(row);
    count += std::none_of(first, first + 16, isOther) ? 1 : 0;
  }
  return count;
}

TEST(CpuSurface, ATriangleShowsAloneWhatItShowsBesideOthersToTheBit) {
  for (const bool perspective : {true, false}) {
    MadeScene made(perspective);
    made.place(plainMaterials());
    const std::vector<MadeScene::Seen> seen = made.seen(9600);
    const auto elsewhere = [&](std::size_t row) { return row * 37 % seen.size(); };
    std::vector<MadeScene::Seen> mixed(seen.size());
    for (std::size_t row = 0; row < seen.size(); ++row) mixed[elsewhere(row)] = seen[row];
    ASSERT_GT(packetsOfOne(seen), 10u);
    ASSERT_EQ(packetsOfOne(mixed), 0u);
    onEachInstructionSet([&] {
      const NumberTable alone = surfacesByLanes(made.frameScene(), made.fragmentsOf(seen));
      const NumberTable beside = surfacesByLanes(made.frameScene(), made.fragmentsOf(mixed));
      std::size_t differ = 0;
      for (std::size_t row = 0; row < seen.size(); ++row) {
        for (std::size_t column = 0; column < kSurfaceNumbers; ++column) {
          differ += alone.at(row, column) == beside.at(elsewhere(row), column) ? 0 : 1;
        }
      }
      EXPECT_EQ(differ, 0u);
    });
  }
}

} // namespace
} // namespace gnomon::cpu
