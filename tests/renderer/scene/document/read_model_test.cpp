// tinygltf reads the same files as the loader's own reader does.
#include "renderer/scene/document/read_model.h"

#include <dlfcn.h>
#include <tiny_gltf.h>

#include "renderer/scene/container/json_text.h"
#include "renderer/scene/container/model_container.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;

gltf::Model ours(const Bytes& glb) {
  Findings findings;
  const auto container = openContainer(glb, findings);
  EXPECT_TRUE(container);
  auto json = parseJsonText(container->json, kLimits);
  EXPECT_TRUE(json);
  return readModel(*std::move(json));
}

bool noImage(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

tinygltf::Model theirs(const Bytes& glb) {
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(noImage, nullptr);
  tinygltf::Model model;
  std::string errors;
  std::string warnings;
  EXPECT_TRUE(parser.LoadBinaryFromMemory(&model, &errors, &warnings, glb.data(), static_cast<unsigned>(glb.size())))
      << errors;
  return model;
}

/// A cube with one more of everything that both readers know.
testing::GlbBuilder manyThings() {
  testing::GlbBuilder builder = testing::cube();
  const int values = builder.addPoints({{1, 2, 3}, {4, 5, 6}});
  const int times = builder.addAccessor(std::vector<float>{0, 1}, "SCALAR", 5126, 2);
  const int indices = builder.addView(std::vector<std::uint16_t>{1, 3});
  builder.add("accessors", {{"componentType", 5126},
                            {"count", 24},
                            {"type", "VEC3"},
                            {"byteOffset", 12},
                            {"normalized", true},
                            {"sparse",
                             {{"count", 2},
                              {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                              {"values", {{"bufferView", 0}, {"byteOffset", 4}}}}}});
  nlohmann::json& primitive = builder.json["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"POSITION", values}, {"NORMAL", values}}};
  primitive["material"] = 0;
  builder.json["meshes"][0]["weights"] = {0.25};
  builder.addRoot({{"name", "turned"}, {"rotation", {0, 1, 0, 0}}, {"translation", {1, 2, 3}}, {"scale", {4, 5, 6}}});
  builder.addRoot(
      {{"children", {1}}, {"matrix", {1, 2, 3, 0, 5, 6, 7, 0, 9, 10, 11, 0, 13, 14, 15, 1}}, {"camera", 0}});
  builder.add("materials",
              nlohmann::json::parse(R"({"name": "Red", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
      "emissiveFactor": [0.1, 0.2, 0.3], "normalTexture": {"index": 0, "scale": 0.5},
      "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.75, "roughnessFactor": 0.125,
                               "baseColorTexture": {"index": 0, "texCoord": 1}}})"));
  builder.add("images", {{"bufferView", 0}, {"mimeType", "image/png"}, {"name", "picture"}});
  builder.add("samplers", {{"wrapS", 33071}, {"magFilter", 9728}});
  builder.add("textures", {{"source", 0}, {"sampler", 0}});
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.5}, {"zfar", 9}}}});
  builder.add("skins", {{"joints", {1, 2}}});
  builder.add("animations", {{"name", "Move"},
                             {"samplers", {{{"input", times}, {"output", values}, {"interpolation", "STEP"}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "scale"}}}}}}});
  builder.json["scene"] = 0;
  return builder;
}

TEST(ReadModel, AgreesWithTinyGltfOnTheGraph) {
  const Bytes glb = manyThings().glb();
  const gltf::Model model = ours(glb);
  const tinygltf::Model other = theirs(glb);
  EXPECT_EQ(model.scene, other.defaultScene);
  ASSERT_EQ(model.scenes.size(), other.scenes.size());
  EXPECT_EQ(model.scenes[0].nodes, other.scenes[0].nodes);
  ASSERT_EQ(model.nodes.size(), other.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const gltf::Node& node = model.nodes[i];
    const tinygltf::Node& same = other.nodes[i];
    EXPECT_EQ(node.name, same.name);
    EXPECT_EQ(node.children, same.children);
    EXPECT_EQ(node.mesh, same.mesh);
    EXPECT_EQ(node.camera, same.camera);
    EXPECT_EQ(node.skin, same.skin);
    ASSERT_EQ(node.matrix.has_value(), !same.matrix.empty());
    for (int k = 0; node.matrix && k < 16; ++k)
      EXPECT_EQ((*node.matrix)[k / 4][k % 4], same.matrix[static_cast<std::size_t>(k)]);
    ASSERT_EQ(node.translation.has_value(), !same.translation.empty());
    for (int k = 0; node.translation && k < 3; ++k)
      EXPECT_EQ((*node.translation)[k], same.translation[static_cast<std::size_t>(k)]);
    for (int k = 0; node.scale && k < 3; ++k) EXPECT_EQ((*node.scale)[k], same.scale[static_cast<std::size_t>(k)]);
    for (int k = 0; node.rotation && k < 4; ++k)
      EXPECT_EQ((*node.rotation)[k], same.rotation[static_cast<std::size_t>(k)]);
  }
  EXPECT_EQ(model.skins.at(0).joints, other.skins.at(0).joints);
  EXPECT_EQ(model.cameras.at(0).perspective->zfar, other.cameras.at(0).perspective.zfar);
  EXPECT_EQ(model.animations.at(0).samplers.at(0).output,
            static_cast<std::size_t>(other.animations.at(0).samplers.at(0).output));
  EXPECT_EQ(model.animations.at(0).samplers.at(0).interpolation, Interpolation::step);
  EXPECT_EQ(model.animations.at(0).channels.at(0).path, other.animations.at(0).channels.at(0).target_path);
}

TEST(ReadModel, AgreesWithTinyGltfOnMeshesAndBytes) {
  const Bytes glb = manyThings().glb();
  const gltf::Model model = ours(glb);
  const tinygltf::Model other = theirs(glb);
  const gltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
  const tinygltf::Primitive& same = other.meshes.at(0).primitives.at(0);
  EXPECT_EQ(primitive.attributes, same.attributes);
  EXPECT_EQ(primitive.targets, same.targets);
  EXPECT_EQ(primitive.indices, same.indices);
  EXPECT_EQ(primitive.material, same.material);
  EXPECT_EQ(static_cast<int>(primitive.mode), same.mode);
  EXPECT_EQ(model.meshes[0].weights, other.meshes[0].weights);
  ASSERT_EQ(model.accessors.size(), other.accessors.size());
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    EXPECT_EQ(model.accessors[i].bufferView, other.accessors[i].bufferView);
    EXPECT_EQ(model.accessors[i].byteOffset, other.accessors[i].byteOffset);
    EXPECT_EQ(model.accessors[i].count, other.accessors[i].count);
    EXPECT_EQ(static_cast<int>(model.accessors[i].componentType), other.accessors[i].componentType);
    EXPECT_EQ(model.accessors[i].normalized, other.accessors[i].normalized);
    EXPECT_EQ(model.accessors[i].type == ElementType::vec3, other.accessors[i].type == TINYGLTF_TYPE_VEC3);
    EXPECT_EQ(model.accessors[i].sparse.has_value(), other.accessors[i].sparse.isSparse);
  }
  const gltf::Sparse& sparse = *model.accessors.back().sparse;
  EXPECT_EQ(sparse.indexView, other.accessors.back().sparse.indices.bufferView);
  EXPECT_EQ(static_cast<int>(sparse.valueOffset), other.accessors.back().sparse.values.byteOffset);
  ASSERT_EQ(model.bufferViews.size(), other.bufferViews.size());
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    EXPECT_EQ(model.bufferViews[i].byteOffset, other.bufferViews[i].byteOffset);
    EXPECT_EQ(model.bufferViews[i].byteLength, other.bufferViews[i].byteLength);
    EXPECT_EQ(model.bufferViews[i].byteStride.value_or(0), other.bufferViews[i].byteStride);
  }
}

TEST(ReadModel, AgreesWithTinyGltfOnMaterials) {
  const Bytes glb = manyThings().glb();
  const gltf::Model model = ours(glb);
  const tinygltf::Model other = theirs(glb);
  const gltf::Material& material = model.materials.at(0);
  const tinygltf::Material& same = other.materials.at(0);
  const auto& pbr = same.pbrMetallicRoughness;
  EXPECT_EQ(material.name, same.name);
  EXPECT_THAT(pbr.baseColorFactor, ElementsAre(material.baseColorFactor.r, material.baseColorFactor.g,
                                               material.baseColorFactor.b, material.baseColorFactor.a));
  EXPECT_EQ(material.metallicFactor, pbr.metallicFactor);
  EXPECT_EQ(material.roughnessFactor, pbr.roughnessFactor);
  EXPECT_EQ(material.baseColorTexture->texCoord, pbr.baseColorTexture.texCoord);
  EXPECT_EQ(material.normalScale, same.normalTexture.scale);
  EXPECT_THAT(same.emissiveFactor,
              ElementsAre(material.emissiveFactor.r, material.emissiveFactor.g, material.emissiveFactor.b));
  EXPECT_EQ(material.alphaCutoff, same.alphaCutoff);
  EXPECT_EQ(material.doubleSided, same.doubleSided);
  EXPECT_EQ(model.textures.at(0).source, other.textures.at(0).source);
  EXPECT_EQ(model.textures.at(0).sampler, other.textures.at(0).sampler);
  EXPECT_EQ(model.samplers.at(0).nearest, other.samplers.at(0).magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST);
  EXPECT_EQ(model.samplers.at(0).wrapS == Wrap::clampToEdge,
            other.samplers.at(0).wrapS == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);
  EXPECT_EQ(model.images.at(0).name, other.images.at(0).name);
}

TEST(TypedModel, TinyGltfIsNotTheOneInsideDraco) {
  // bool tinygltf::TinyGLTF::LoadASCIIFromString(Model*, string*, string*, char const*, unsigned, string const&,
  // unsigned)
  void* function = dlsym(RTLD_DEFAULT,
                         "_ZN8tinygltf8TinyGLTF19LoadASCIIFromStringEPNS_5ModelEPNSt7__cxx1112basic_"
                         "stringIcSt11char_traitsIcESaIcEEES9_PKcjRKS8_j");
  ASSERT_NE(function, nullptr);
  Dl_info place{};
  ASSERT_NE(dladdr(function, &place), 0);
  EXPECT_NE(std::string(place.dli_fname).find("libtinygltf"), std::string::npos) << place.dli_fname;
}

} // namespace
} // namespace gnomon
