#include "renderer/cpu/surface/material_holes.h"

#include <bit>
#include <gtest/gtest.h>

#include "tests/renderer/cpu/instruction_sets.h"
#include "tests/renderer/cpu/surface/place_truth.h"

namespace gnomon::cpu {
namespace {

std::vector<glm::mat4> clipFromLocal(const MadeScene& made) {
  std::vector<glm::mat4> matrices;
  for (const PlacedInstance& instance : made.frameScene().geometry.instances) {
    matrices.emplace_back(clipFromView(made.view()) * viewFromRelative(made.view()) * instance.relativeFromLocal);
  }
  return matrices;
}

HolesInput inputOf(const MadeScene& made, const std::vector<glm::mat4>& clip) {
  return {made.frameScene(), made.textures(), clip, {made.frameScene().width, made.frameScene().height}};
}

std::uint32_t instanceOf(const MadeScene& made, std::uint32_t number) {
  return made.frameScene().slots[number / kClusterTriangles].instance;
}

/// A pixel as the place `at` of those that are asked about.
HoledPlaces placed(const MadeScene& made, std::uint32_t number, const glm::ivec2& pixel, std::size_t at) {
  HoledPlaces places;
  places.instance = instanceOf(made, number);
  places.number[at] = number;
  places.x[at] = pixel.x;
  places.y[at] = pixel.y;
  return places;
}

/// Sixteen pixels of one triangle, four by four.
HoledPlaces block(const MadeScene& made, std::uint32_t number, bool counterClockwise) {
  HoledPlaces places;
  places.instance = instanceOf(made, number);
  places.counterClockwise = counterClockwise ? 0xffff : 0;
  for (int i = 0; i < 16; ++i) {
    places.number[i] = number;
    places.x[i] = 12 + i % 4;
    places.y[i] = 20 + i / 4;
  }
  return places;
}

std::vector<Material> maskedMaterials() {
  std::vector<Material> materials(3);
  for (Material& material : materials) material.cutoff = 0.5f;
  materials[0].baseColor = TextureUse{};
  materials[0].baseColor->image = 0;
  materials[0].baseColor->texCoord = 1;
  materials[0].baseColor->transform = TextureTransform{glm::mat2(0.5f, 0.25f, -0.75f, 1.0f), {0.125f, 0.375f}};
  materials[1] = materials[0];
  materials[1].baseColor->transform.reset();
  materials[1].baseColorFactor.a = 0.75f;
  materials[1].cutoff = 0.25f;
  materials[1].hasVertexColors = true;
  materials[2].hasVertexColors = true;
  return materials;
}

TEST(CpuMaterialHoles, LeaveOutWhatTheCutoffDoes) {
  for (const bool perspective : {true, false}) {
    MadeScene made(perspective);
    made.place(maskedMaterials(), {noise(32, 64)});
    const std::vector<MadeScene::Seen> all = made.seen(4800);
    const std::vector<glm::mat4> clip = clipFromLocal(made);
    const MaterialHoles holes(inputOf(made, clip));
    onEachInstructionSet([&] {
      std::size_t off = 0;
      std::size_t filled = 0;
      for (MadeScene::Seen seen : all) {
        // The centre of the pixel that the point lies in, on the triangle's plane.
        const glm::ivec2 pixel(seen.place);
        seen.place = glm::dvec2(pixel) + 0.5;
        seen.weights = weightsAt(made.frameScene(), made.view(), seen, seen.place);
        if (glm::length(seen.weights) > 4) continue;
        const unsigned bit = 1u << (filled % 16);
        const unsigned found = holes.filled(placed(made, seen.triangle, pixel, filled % 16), bit);
        ASSERT_TRUE(found == 0 || found == bit) << "no place that isn't asked for";
        const Place place(made, seen);
        const double over = place.alpha() - static_cast<double>(*place.material().cutoff);
        off += std::abs(over) > 0.01 && (found != 0) != (over > 0) ? 1 : 0;
        filled += found != 0 ? 1 : 0;
      }
      EXPECT_LE(off, all.size() / 1000);
      EXPECT_GT(filled, all.size() / 4);
      EXPECT_LT(filled, all.size() * 3 / 4);
    });
  }
}

TEST(CpuMaterialHoles, DitherAsManyTexelsAsAlphaSays) {
  std::vector<Material> materials(16);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    materials[i].cutoff = 0.5f;
    materials[i].lightOpacity = i % 2 == 0 ? 1.0f : 0.5f;
    materials[i].baseColorFactor.a = static_cast<float>(i) / 16.0f / *materials[i].lightOpacity;
  }
  MadeScene made(true);
  made.place(materials);
  const std::vector<glm::mat4> clip = clipFromLocal(made);
  HolesInput input = inputOf(made, clip);
  input.dithers = true;
  input.corner = {64, 128};
  const MaterialHoles dithered(input);
  input.corner = {65, 128};
  const MaterialHoles beside(input);
  input.dithers = false;
  const MaterialHoles masked(input);
  onEachInstructionSet([&] {
    for (std::uint32_t instance = 0; instance < materials.size(); ++instance) {
      const std::uint32_t number = made.frameScene().geometry.firstSlot[instance] * kClusterTriangles + 7;
      const HoledPlaces counterClockwise = block(made, number, true), clockwise = block(made, number, false);
      const unsigned front = dithered.filled(counterClockwise, 0xffff);
      const unsigned back = dithered.filled(clockwise, 0xffff);
      EXPECT_EQ(std::popcount(front), static_cast<int>(instance));
      EXPECT_EQ(std::popcount(back), static_cast<int>(instance));
      // The pattern lies still in the atlas: column 1 from the first corner is column 0 from the next.
      EXPECT_EQ(front >> 1 & 0x7777u, beside.filled(counterClockwise, 0xffff) & 0x7777u);
      EXPECT_EQ(masked.filled(counterClockwise, 0xffff), materials[instance].baseColorFactor.a >= 0.5f ? 0xffffu : 0u);
    }
    const std::uint32_t half = made.frameScene().geometry.firstSlot[8] * kClusterTriangles + 7;
    EXPECT_NE(dithered.filled(block(made, half, true), 0xffff), dithered.filled(block(made, half, false), 0xffff));
  });
}

} // namespace
} // namespace gnomon::cpu
