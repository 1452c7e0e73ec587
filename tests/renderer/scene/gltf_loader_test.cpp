#include "renderer/scene/gltf_loader.h"

#include <rapidcheck.h>

#include "tests/renderer/scene/load.h"
#include "tests/support/compressed_models.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(GltfLoader, SummarizesTheDefaultScene) {
  testing::GlbBuilder builder = testing::cube();
  builder.addMeshNode(0);
  builder.json["nodes"][1]["translation"] = {5, 0, 0};
  builder.add("nodes", json::object()); // belongs to no scene
  builder.add("animations", {{"name", "still"}, {"channels", json::array()}, {"samplers", json::array()}});
  const SceneBundle bundle = builder.bundle();
  const SceneSummary summary = load(bundle).summary;
  EXPECT_EQ(summary.id, "");
  EXPECT_EQ(summary.bytes, bundle.model.size());
  EXPECT_GT(summary.memoryBytes, 24 * sizeof(VertexAttributes));
  EXPECT_EQ(summary.scenes, 1);
  EXPECT_EQ(summary.nodes, 2u);
  EXPECT_EQ(summary.meshes, 1u);
  EXPECT_EQ(summary.materials, 1u);
  EXPECT_EQ(summary.images, 0u);
  EXPECT_EQ(summary.triangles, 24u);
  EXPECT_EQ(summary.vertices, 24u);
  EXPECT_EQ(summary.instances, 2u);
  EXPECT_EQ(summary.skins + summary.joints + summary.morphTargets, 0u);
  ASSERT_EQ(summary.animations.size(), 1u);
  EXPECT_EQ(summary.animations[0].name, "still");
  EXPECT_EQ(summary.animations[0].durationSeconds, 0);
  EXPECT_EQ(summary.boundsMin, (std::array<double, 3>{-1, -1, -1}));
  EXPECT_EQ(summary.boundsMax, (std::array<double, 3>{6, 1, 1}));
  EXPECT_THAT(summary.warnings, ElementsAre(HasSubstr("2 places, the first is /animations/0/channels")));
}

TEST(GltfLoader, LoadsTheSameSceneFromTheSameBytes) {
  const Scene first = load(testing::cube());
  const Scene second = load(testing::cube());
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.indices, second.indices);
}

TEST(GltfLoader, TellsSeveralProblemsAtOnce) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["mesh"] = 99;
  builder.json["meshes"][0]["primitives"][0]["indices"] = 77;
  builder.json["scenes"][0]["nodes"][0] = -1;
  const Problems problems = problemsOf(builder);
  EXPECT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, "/nodes/0/mesh")));
  EXPECT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, "/meshes/0/primitives/0/indices")));
  EXPECT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, "/scenes/0/nodes/0")));
}

TEST(GltfLoader, TellsOfBuffersWithoutBytes) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["buffers"] = {{{"byteLength", builder.binary.size() + 1}}};
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/buffers/0/byteLength"));
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}}, {{"byteLength", 4}}};
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/buffers/1/uri"));
}

TEST(GltfLoader, ExtrasMayHoldAnything) {
  testing::GlbBuilder builder = testing::cube();
  const json extras = {{"a", {nullptr, true, {{"b", -1.5e300}}}}, {"mesh", 99}};
  builder.json["extras"] = extras;
  builder.json["nodes"][0]["extras"] = "text";
  builder.json["accessors"][0]["extras"] = extras;
  builder.json["meshes"][0]["extensions"] = {{"ACME_x", extras}};
  EXPECT_EQ(load(builder).summary.triangles, 12u);
}

TEST(GltfLoader, SurvivesAnyByteChange) {
  const Bytes sound = testing::plane().glb();
  EXPECT_TRUE(rc::check([&sound] {
    Bytes glb = sound;
    const int changes = *rc::gen::inRange(1, 6);
    for (int i = 0; i < changes; ++i) {
      glb[*rc::gen::inRange<std::size_t>(0, glb.size())] = *rc::gen::arbitrary<std::uint8_t>();
    }
    auto result = loadGltf({glb, {}});
    if (result) {
      RC_ASSERT((*result)->scenes.size() >= 1u);
    } else {
      RC_ASSERT(!result.problems().empty());
      for (const Problem& problem : result.problems()) {
        RC_ASSERT(!problem.detail.empty());
        RC_ASSERT(problem.code != ProblemCode::internal);
      }
    }
  }));
}

/// Every place in a JSON document.
void collectPlaces(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& places) {
  places.push_back(at);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) collectPlaces(member, at / key, places);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collectPlaces(value[i], at / i, places);
  }
}

void expectToSurviveAnyValueAnywhere(testing::GlbBuilder sound);

TEST(GltfLoader, SurvivesAnyValueAnywhere) {
  testing::GlbBuilder sound = testing::cube();
  sound.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  sound.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  sound.add("textures", {{"source", 0}, {"sampler", 0}});
  sound.add("samplers", {{"wrapS", 10497}});
  sound.add("images", {{"uri", "data:image/png;base64,iVBORw0KGgo="}});
  sound.add("skins", {{"joints", {0}}});
  sound.add("animations", {{"channels", {{{"sampler", 0}, {"target", {{"path", "scale"}, {"node", 0}}}}}},
                           {"samplers", {{{"input", 0}, {"output", 0}}}}});
  sound.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
  sound.json["nodes"][0].update(
      {{"camera", 0}, {"skin", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  expectToSurviveAnyValueAnywhere(sound);
}

TEST(GltfLoader, SurvivesAnyValueInCompressedModels) {
  expectToSurviveAnyValueAnywhere(testing::dracoModel(testing::torus(4)));
  expectToSurviveAnyValueAnywhere(testing::meshoptModel(testing::torus(4)));
}

TEST(GltfLoader, SurvivesAnyValueInModelsThatDeform) {
  testing::GlbBuilder sound = testing::triangle();
  sound.add("nodes", {{"translation", {0, 1, 0}}});
  const int joints = sound.addAccessor(std::vector<std::uint8_t>(12), "VEC4", 5121, 3);
  const int weights = sound.addAccessor(std::vector<float>(12, 0.25f), "VEC4", 5126, 3);
  const int matrices = sound.addAccessor(std::vector<glm::mat4>(1, glm::mat4(1)), "MAT4", 5126, 1);
  json& primitive = sound.json["meshes"][0]["primitives"][0];
  primitive["attributes"].update({{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
  primitive["targets"] = {{{"POSITION", 0}, {"NORMAL", 0}}};
  sound.json["meshes"][0]["weights"] = {0.5};
  sound.add("skins", {{"joints", {1}}, {"inverseBindMatrices", matrices}});
  sound.json["nodes"][0].update({{"skin", 0}, {"weights", {1}}});
  sound.add("nodes", {{"mesh", 0}});
  sound.json["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 0}};
  sound.json["scenes"][0]["nodes"] = {0, 1, 2};
  expectToSurviveAnyValueAnywhere(sound);
}

void expectToSurviveAnyValueAnywhere(testing::GlbBuilder sound) {
  if (!sound.json.contains("buffers")) sound.json["buffers"] = {{{"byteLength", sound.binary.size()}}};
  std::vector<json::json_pointer> places;
  collectPlaces(sound.json, json::json_pointer(), places);
  const json lies[] = {nullptr,
                       true,
                       0,
                       1,
                       -1,
                       2147483648,
                       9007199254740993,
                       1e300,
                       "",
                       "x",
                       json::array(),
                       json::array({0}),
                       json::object(),
                       18446744073709551615u};
  for (const auto& place : places) {
    for (const json& lie : lies) {
      json document = sound.json;
      document[place] = lie;
      auto result = loadGltf({testing::makeGlb(document.dump(), sound.binary), {}});
      if (result) continue;
      for (const Problem& problem : result.problems()) {
        ASSERT_FALSE(problem.detail.empty()) << place << " = " << lie;
        ASSERT_NE(problem.code, ProblemCode::internal) << place << " = " << lie;
      }
    }
  }
}

} // namespace
} // namespace gnomon
