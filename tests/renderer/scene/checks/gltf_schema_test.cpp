#include "renderer/scene/checks/gltf_schema.h"

#include <set>

#include "renderer/scene/checks/gltf_fields.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::IsEmpty;

Problems check(json document) {
  Findings findings;
  checkSchema(document, findings);
  return findings.takeProblems();
}

/// A document that holds one of everything and passes.
json sound() {
  return json::parse(R"({
    "asset": {"version": "2.0"},
    "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "camera": 0, "skin": 0, "children": [1], "extensions": {"KHR_lights_punctual": {"light": 0}}},
              {"rotation": [0, 0, 0, 1]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 0, "material": 0, "targets": [{"POSITION": 0}]}]}],
    "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3", "bufferView": 0,
                   "sparse": {"count": 1, "indices": {"bufferView": 0, "componentType": 5123}, "values": {"bufferView": 0}}}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0},
                   "occlusionTexture": {"index": 0}, "emissiveTexture": {"index": 0}}],
    "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33071}], "images": [{"bufferView": 0}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
    "skins": [{"joints": [1], "skeleton": 1, "inverseBindMatrices": 0}],
    "animations": [{"samplers": [{"input": 0, "output": 0}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
  })");
}

TEST(GltfSchema, PassesASoundDocument) {
  EXPECT_THAT(check(sound()), IsEmpty());
}

TEST(GltfSchema, EveryIndexIsHeldAgainstWhatItNames) {
  for (const char* pointer : {"/scene",
                              "/scenes/0/nodes/0",
                              "/nodes/0/mesh",
                              "/nodes/0/camera",
                              "/nodes/0/skin",
                              "/nodes/0/children/0",
                              "/nodes/0/extensions/KHR_lights_punctual/light",
                              "/meshes/0/primitives/0/attributes/POSITION",
                              "/meshes/0/primitives/0/indices",
                              "/meshes/0/primitives/0/material",
                              "/meshes/0/primitives/0/targets/0/POSITION",
                              "/accessors/0/bufferView",
                              "/accessors/0/sparse/indices/bufferView",
                              "/accessors/0/sparse/values/bufferView",
                              "/bufferViews/0/buffer",
                              "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
                              "/materials/0/normalTexture/index",
                              "/materials/0/occlusionTexture/index",
                              "/materials/0/emissiveTexture/index",
                              "/textures/0/source",
                              "/textures/0/sampler",
                              "/images/0/bufferView",
                              "/skins/0/joints/0",
                              "/skins/0/skeleton",
                              "/skins/0/inverseBindMatrices",
                              "/animations/0/channels/0/sampler",
                              "/animations/0/channels/0/target/node",
                              "/animations/0/samplers/0/input",
                              "/animations/0/samplers/0/output"}) {
    for (const json& lie : {json(77), json(-1), json(4294967296), json(18446744073709551615u), json(0.5), json("0"),
                            json(nullptr), json(true), json::array({0}), json::object()}) {
      json document = sound();
      document.at(json::json_pointer(pointer)) = lie;
      EXPECT_THAT(check(document), Contains(ProblemAt(ProblemCode::invalidScene, pointer))) << pointer << " = " << lie;
    }
  }
}

TEST(GltfSchema, TakesWholeNumbersWithAFraction) {
  json document = sound();
  document["accessors"][0]["count"] = 3.0;
  document["nodes"][0]["mesh"] = 0.0;
  Findings findings;
  checkSchema(document, findings);
  EXPECT_FALSE(findings.refused());
  EXPECT_TRUE(document["accessors"][0]["count"].is_number_integer());
}

TEST(GltfSchema, RefusesValuesOutOfRange) {
  const std::pair<const char*, json> lies[] = {
      {"/accessors/0/count", -1},
      {"/accessors/0/count", 1e300},
      {"/accessors/0/componentType", 5124},
      {"/accessors/0/type", "VEC5"},
      {"/accessors/0/type", "VEC2 VEC3"},
      {"/accessors/0/type", ""},
      {"/accessors/0/sparse/indices/componentType", 5126},
      {"/bufferViews/0/byteLength", -1},
      {"/samplers/0/wrapS", 1},
      {"/cameras/0/type", "fisheye"},
      {"/cameras/0/perspective/znear", 0},
      {"/extensions/KHR_lights_punctual/lights/0/type", "area"},
      {"/nodes/1/rotation/3", "one"},
  };
  for (const auto& [pointer, lie] : lies) {
    json document = sound();
    document.at(json::json_pointer(pointer)) = lie;
    EXPECT_THAT(check(document), Contains(ProblemAt(ProblemCode::invalidScene, pointer))) << pointer << " = " << lie;
  }
}

TEST(GltfSchema, RefusesMissingMembers) {
  for (const auto& [parent, key] : {std::pair<const char*, const char*>{"/accessors/0", "count"},
                                    {"/bufferViews/0", "buffer"},
                                    {"/meshes/0", "primitives"},
                                    {"/meshes/0/primitives/0", "attributes"},
                                    {"/accessors/0/sparse", "values"},
                                    {"/cameras/0", "type"},
                                    {"/materials/0/normalTexture", "index"}}) {
    json document = sound();
    document.at(json::json_pointer(parent)).erase(key);
    EXPECT_THAT(check(document), Contains(ProblemAt(ProblemCode::invalidScene, std::string(parent) + "/" + key)));
  }
}

TEST(GltfSchema, RefusesWrongArrays) {
  json document = sound();
  document["nodes"][1]["rotation"] = {0, 0, 1};
  document["nodes"][0]["children"] = {1, 1};
  document["meshes"] = json::object();
  const Problems problems = check(document);
  EXPECT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, "/nodes/1/rotation")));
  EXPECT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, "/nodes/0/children/1")));
  EXPECT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, "/meshes")));
}

TEST(GltfSchema, TellsManyProblemsButNotAllOfThem) {
  json document = sound();
  document["nodes"] = json::array();
  for (int i = 0; i < 1000; ++i) document["nodes"].push_back({{"mesh", 99}});
  EXPECT_EQ(check(document).size(), 32u);
}

TEST(GltfSchema, EscapesPointers) {
  json document = sound();
  document["meshes"][0]["primitives"][0]["attributes"] = {{"_A/B~C", 99}};
  EXPECT_THAT(check(document),
              Contains(ProblemAt(ProblemCode::invalidScene, "/meshes/0/primitives/0/attributes/_A~1B~0C")));
}

TEST(GltfSchema, EveryObjectOfTheTableHasRows) {
  std::set<std::string_view> owners;
  for (const GltfField& field : gltfFields()) owners.insert(field.owner);
  for (const GltfField& field : gltfFields()) {
    if (field.kind != FieldKind::object && field.kind != FieldKind::objects) continue;
    EXPECT_TRUE(owners.count(field.of)) << field.owner << "." << field.key << " of " << field.of;
  }
}

} // namespace
} // namespace gnomon
