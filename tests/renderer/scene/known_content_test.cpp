#include "renderer/scene/shared_content.h"
#include "tests/renderer/scene/load.h"
#include "tests/support/webp_builder.h"

namespace gnomon {
namespace {

using ::testing::SizeIs;

/// A file that holds what is loaded again and again: only where the camera stands differs.
testing::GlbBuilder seenFrom(double x) {
  testing::GlbBuilder file = testing::cube();
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
  file.addRoot({{"camera", 0}, {"translation", {x, 0, 5}}});
  return file;
}

std::shared_ptr<const Scene> loadedBy(KnownContent& known, const testing::GlbBuilder& file) {
  auto scene = loadGltf(file.bundle(), kLimits, {}, &known);
  EXPECT_TRUE(scene);
  return scene ? *scene : nullptr;
}

/// `other`: as `load` gives it.
void expectSameMeshes(const Scene& loaded, const Scene& other) {
  const Scene scene = ofFile(loaded);
  EXPECT_EQ(scene.positions, other.positions);
  EXPECT_EQ(scene.indices, other.indices);
  EXPECT_EQ(scene.welded, other.welded);
  ASSERT_EQ(scene.attributes.size(), other.attributes.size());
  for (std::size_t i = 0; i < scene.attributes.size(); ++i) {
    EXPECT_EQ(scene.attributes[i].normal, other.attributes[i].normal);
    EXPECT_EQ(scene.attributes[i].uv0, other.attributes[i].uv0);
  }
  ASSERT_EQ(scene.clusters.size(), other.clusters.size());
  for (std::size_t i = 0; i < scene.clusters.size(); ++i) {
    EXPECT_EQ(scene.clusters[i].bounds.min, other.clusters[i].bounds.min);
    EXPECT_EQ(scene.clusters[i].bounds.max, other.clusters[i].bounds.max);
  }
  ASSERT_EQ(scene.primitives.size(), other.primitives.size());
  for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
    const Primitive& one = scene.primitives[i];
    const Primitive& two = other.primitives[i];
    EXPECT_EQ(one.baseVertex, two.baseVertex);
    EXPECT_EQ(one.firstIndex, two.firstIndex);
    EXPECT_EQ(one.firstCluster, two.firstCluster);
    EXPECT_EQ(one.vertexCount, two.vertexCount);
    EXPECT_EQ(one.indexCount, two.indexCount);
    EXPECT_EQ(one.clusterCount, two.clusterCount);
    EXPECT_EQ(one.hasTangents, two.hasTangents);
    EXPECT_EQ(one.solid, two.solid);
    EXPECT_EQ(one.material, two.material);
    EXPECT_EQ(one.bounds.max, two.bounds.max);
  }
}

TEST(KnownContent, AFileWithKnownMeshesIsTheSceneThatItIsAlone) {
  KnownContent known;
  const auto first = loadedBy(known, seenFrom(0));
  EXPECT_EQ(known.reused().meshes, 0u);
  const auto second = loadedBy(known, seenFrom(1));
  EXPECT_EQ(known.reused().meshes, 1u);
  EXPECT_TRUE(sameSurfaces(*first, *second));
  EXPECT_NE(first->scenes[0].cameras[0].eye, second->scenes[0].cameras[0].eye);
  expectSameMeshes(*second, load(seenFrom(1)));
}

TEST(KnownContent, AMeshIsFoundBehindOthersAndWithAnotherMaterial) {
  KnownContent known;
  const auto first = loadedBy(known, testing::cube());
  testing::GlbBuilder file = testing::plane();
  const testing::GlbBuilder other = testing::cube();
  const int offset = static_cast<int>(file.json["accessors"].size());
  const int views = static_cast<int>(file.json["bufferViews"].size());
  const std::size_t bytes = (file.binary.size() + 3) / 4 * 4;
  file.binary.resize(bytes);
  file.binary.insert(file.binary.end(), other.binary.begin(), other.binary.end());
  for (auto view : other.json["bufferViews"]) {
    view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + bytes;
    file.add("bufferViews", view);
  }
  for (auto accessor : other.json["accessors"]) {
    accessor["bufferView"] = accessor["bufferView"].get<int>() + views;
    file.add("accessors", accessor);
  }
  auto primitive = other.json["meshes"][0]["primitives"][0];
  for (auto& [name, accessor] : primitive["attributes"].items()) accessor = accessor.get<int>() + offset;
  if (primitive.contains("indices")) primitive["indices"] = primitive["indices"].get<int>() + offset;
  primitive["material"] = file.add("materials", {{"name", "red"}});
  file.addMeshNode(file.addMesh(primitive));
  const auto second = loadedBy(known, file);
  EXPECT_EQ(known.reused().meshes, 1u);
  expectSameMeshes(*second, load(file));
  EXPECT_FALSE(sameMeshes(*first, *second));
}

TEST(KnownContent, PrimitivesOfOneSetOfVerticesAreToldApart) {
  testing::GlbBuilder file = testing::cube();
  auto primitive = file.json["meshes"][0]["primitives"][0];
  auto part = file.json["accessors"][primitive["indices"].get<std::size_t>()];
  part["count"] = 6;
  part.erase("min");
  part.erase("max");
  primitive["indices"] = file.add("accessors", part);
  file.json["meshes"][0]["primitives"].push_back(primitive);
  KnownContent known;
  const auto first = loadedBy(known, file);
  const auto second = loadedBy(known, file);
  EXPECT_EQ(known.reused().meshes, 2u);
  ASSERT_THAT(second->primitives, SizeIs(2));
  EXPECT_NE(second->primitives[0].content, second->primitives[1].content);
  expectSameMeshes(*second, load(file));
}

TEST(KnownContent, WhatDiffersInAByteIsAnother) {
  KnownContent known;
  const auto first = loadedBy(known, testing::cube());
  testing::GlbBuilder changed = testing::cube();
  changed.binary[2] ^= 1;
  const auto second = loadedBy(known, changed);
  EXPECT_EQ(known.reused().meshes, 0u);
  EXPECT_FALSE(sameMeshes(*first, *second));
  expectSameMeshes(*second, load(changed));
}

TEST(KnownContent, ANodeThatMovedHasItsMeshButNotItsSurfaces) {
  KnownContent known;
  const auto first = loadedBy(known, testing::cube());
  testing::GlbBuilder moved = testing::cube();
  moved.json["nodes"][0]["translation"] = {1, 0, 0};
  const auto second = loadedBy(known, moved);
  EXPECT_TRUE(sameMeshes(*first, *second));
  EXPECT_TRUE(sameTextures(*first, *second));
  EXPECT_FALSE(sameSurfaces(*first, *second));
}

TEST(KnownContent, AnotherColorIsAnotherSurface) {
  KnownContent known;
  const auto colored = [](double red) {
    testing::GlbBuilder file = testing::cube();
    const int material = file.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0, 0, 1}}}}});
    file.json["meshes"][0]["primitives"][0]["material"] = material;
    return file;
  };
  const auto first = loadedBy(known, colored(0.5));
  const auto second = loadedBy(known, colored(0.25));
  EXPECT_EQ(known.reused().meshes, 1u);
  EXPECT_TRUE(sameMeshes(*first, *second));
  EXPECT_FALSE(sameSurfaces(*first, *second));
  EXPECT_EQ(second->materials[0].baseColorFactor.r, 0.25f);
}

TEST(KnownContent, NothingLivesLongerThanItsScenes) {
  KnownContent known;
  loadedBy(known, testing::cube());
  const auto again = loadedBy(known, testing::cube());
  EXPECT_EQ(known.reused().meshes, 0u) << "the first is gone";
  loadedBy(known, testing::cube());
  EXPECT_EQ(known.reused().meshes, 1u);
}

TEST(KnownContent, WhatAFileIsWarnedOfIsSaidForEachFile) {
  KnownContent known;
  testing::GlbBuilder file = testing::cube();
  const int accessor = file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"];
  const int view = file.json["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
  const std::size_t offset =
      file.json["bufferViews"][static_cast<std::size_t>(view)].value("byteOffset", std::size_t{0});
  // The first normal has no length.
  std::fill_n(file.binary.begin() + static_cast<std::ptrdiff_t>(offset), 12, std::uint8_t{0});
  const auto first = loadedBy(known, file);
  const auto second = loadedBy(known, file);
  EXPECT_THAT(first->summary.warnings, SizeIs(1));
  EXPECT_EQ(first->summary.warnings, second->summary.warnings);
  EXPECT_EQ(known.reused().meshes, 0u);
}

TEST(KnownContent, ImagesAreSharedWhereBytesAndPlaceAreTheSame) {
  const auto textured = [](const Bytes& picture) {
    testing::GlbBuilder file = testing::plane();
    file.add("images", {{"bufferView", file.addView(picture)}, {"mimeType", "image/webp"}});
    file.add("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
    file.json["extensionsUsed"] = {"EXT_texture_webp"};
    const int material = file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    file.json["meshes"][0]["primitives"][0]["material"] = material;
    return file;
  };
  KnownContent known;
  const Bytes picture = testing::losslessWebp(2, 2, Bytes(16, 17));
  const auto first = loadedBy(known, textured(picture));
  const auto second = loadedBy(known, textured(picture));
  ASSERT_THAT(first->images, SizeIs(1));
  EXPECT_EQ(first->images, second->images);
  EXPECT_EQ(known.reused().images, 1u);
  const auto third = loadedBy(known, textured(testing::losslessWebp(2, 2, Bytes(16, 18))));
  EXPECT_NE(first->images, third->images);
  EXPECT_FALSE(sameTextures(*first, *third));
}

} // namespace
} // namespace gnomon
