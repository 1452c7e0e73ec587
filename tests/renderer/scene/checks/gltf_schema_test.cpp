#include "renderer/scene/checks/gltf_schema.h"

#include <numbers>
#include <set>
#include <tuple>

#include "renderer/scene/checks/gltf_fields.h"
#include "renderer/scene/document/read_model.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Problems check(json document) {
  Findings findings;
  checkSchema(document, findings);
  return findings.takeProblems();
}

/// What is said where nothing refuses the document, which is left as repaired.
std::vector<std::string> repair(json& document) {
  Findings findings;
  checkSchema(document, findings);
  EXPECT_THAT(findings.takeProblems(), IsEmpty());
  return findings.takeWarnings();
}

/// The reason for which the part that `pointer` leads into is left out; empty = it is sound.
std::string whyLeftOut(const json& document, std::string_view pointer) {
  std::size_t slash = 0;
  while (slash != std::string_view::npos) {
    slash = pointer.find('/', slash + 1);
    const json& part = document.at(json::json_pointer(std::string(pointer.substr(0, slash))));
    if (part.is_array() && !part.empty() && part[0].is_string()) return faultOf(part);
  }
  return {};
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
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
  })");
}

TEST(GltfSchema, PassesASoundDocument) {
  EXPECT_THAT(check(sound()), IsEmpty());
  json document = sound();
  EXPECT_THAT(repair(document), IsEmpty());
}

const json kNoIndices[] = {json(77),         json(-1),      json(4294967296), json(18446744073709551615u),
                           json(0.5),        json("0"),     json(nullptr),    json(true),
                           json::array({0}), json::object()};

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
                              "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
                              "/materials/0/normalTexture/index",
                              "/materials/0/occlusionTexture/index",
                              "/materials/0/emissiveTexture/index",
                              "/textures/0/source",
                              "/textures/0/sampler",
                              "/images/0/bufferView",
                              "/skins/0/joints/0",
                              "/skins/0/skeleton",
                              "/skins/0/inverseBindMatrices"}) {
    for (const json& lie : kNoIndices) {
      json document = sound();
      document.at(json::json_pointer(pointer)) = lie;
      EXPECT_THAT(check(document), Contains(ProblemAt(ProblemCode::invalidScene, pointer))) << pointer << " = " << lie;
    }
  }
}

TEST(GltfSchema, APartWithAnIndexThatNamesNothingIsLeftOut) {
  for (const char* pointer :
       {"/accessors/0/bufferView", "/accessors/0/sparse/indices/bufferView", "/accessors/0/sparse/values/bufferView",
        "/bufferViews/0/buffer", "/animations/0/channels/0/sampler", "/animations/0/channels/0/target/node",
        "/animations/0/samplers/0/input", "/animations/0/samplers/0/output"}) {
    for (const json& lie : kNoIndices) {
      json document = sound();
      document.at(json::json_pointer(pointer)) = lie;
      EXPECT_THAT(repair(document), ElementsAre(AllOf(HasSubstr("left out"), HasSubstr(pointer)))) << lie;
      EXPECT_THAT(whyLeftOut(document, pointer), HasSubstr(pointer)) << lie;
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

using Lie = std::pair<const char*, json>;

TEST(GltfSchema, APartWithAValueOutOfRangeIsLeftOut) {
  const Lie lies[] = {
      {"/accessors/0/count", -1},
      {"/accessors/0/count", 1e300},
      {"/accessors/0/componentType", 5124},
      {"/accessors/0/type", "VEC5"},
      {"/accessors/0/type", "VEC2 VEC3"},
      {"/accessors/0/type", ""},
      {"/accessors/0/sparse/indices/componentType", 5126},
      {"/bufferViews/0/byteLength", -1},
      {"/bufferViews/0/byteLength", 0},
      {"/buffers/0/byteLength", 0},
      {"/cameras/0/type", "fisheye"},
      {"/cameras/0/perspective/znear", 0},
      {"/cameras/0/perspective/yfov", 3.5},
      {"/animations/0/samplers/0/interpolation", "BEZIER"},
      {"/extensions/KHR_lights_punctual/lights/0/type", "area"},
      {"/extensions/KHR_lights_punctual/lights/0/range", 0},
  };
  for (const auto& [pointer, lie] : lies) {
    json document = sound();
    document[json::json_pointer(pointer)] = lie;
    EXPECT_THAT(repair(document), ElementsAre(AllOf(HasSubstr("left out"), HasSubstr(pointer)))) << lie;
    EXPECT_THAT(whyLeftOut(document, pointer), HasSubstr(pointer)) << lie;
    document = sound();
    document[json::json_pointer(pointer)] = lie;
    Findings strict(Conformance::strict);
    checkSchema(document, strict);
    EXPECT_THAT(strict.takeProblems(), ElementsAre(ProblemAt(ProblemCode::invalidScene, pointer))) << lie;
  }
}

TEST(GltfSchema, OtherValuesOutOfRangeAreRefused) {
  const Lie lies[] = {{"/nodes/1/rotation/3", "one"},
                      {"/materials/0/pbrMetallicRoughness/roughnessFactor", 1.001},
                      {"/materials/0/pbrMetallicRoughness/roughnessFactor", -0.001},
                      {"/materials/0/emissiveFactor/2", -1}};
  for (const auto& [pointer, lie] : lies) {
    json document = sound();
    document["materials"][0]["emissiveFactor"] = {0, 0, 0};
    document[json::json_pointer(pointer)] = lie;
    EXPECT_THAT(check(document), Contains(ProblemAt(ProblemCode::invalidScene, pointer))) << pointer << " = " << lie;
  }
}

TEST(GltfSchema, WhatIsOffByRoundingIsBroughtToTheLimit) {
  const std::tuple<const char*, json, double> lies[] = {
      {"/materials/0/pbrMetallicRoughness/roughnessFactor", 1.0000001, 1.0},
      {"/materials/0/pbrMetallicRoughness/metallicFactor", -0.00009, 0.0},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor/1", 1.00009, 1.0},
      {"/materials/0/occlusionTexture/strength", 1.00001, 1.0},
      {"/materials/0/alphaCutoff", -1e-9, 0.0},
      {"/cameras/0/perspective/yfov", 3.1417, std::numbers::pi},
      {"/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", 1.5708, std::numbers::pi / 2},
      {"/extensions/KHR_lights_punctual/lights/0/intensity", -1e-12, 0.0},
  };
  for (const auto& [pointer, lie, limit] : lies) {
    json document = sound();
    document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 1};
    document[json::json_pointer(pointer)] = lie;
    EXPECT_THAT(repair(document), ElementsAre(AllOf(HasSubstr("by rounding"), HasSubstr(pointer))));
    EXPECT_EQ(document.at(json::json_pointer(pointer)), limit) << pointer;
  }
}

TEST(GltfSchema, AValueThatIsInNoListCountsAsTheDefault) {
  const Lie lies[] = {
      {"/samplers/0/wrapS", 1},          {"/samplers/0/wrapT", "REPEAT"},      {"/samplers/0/magFilter", 9987},
      {"/samplers/0/minFilter", 0.5},    {"/materials/0/alphaMode", "opaque"}, {"/materials/0/alphaMode", 2},
      {"/meshes/0/primitives/0/mode", 7}};
  for (const auto& [pointer, lie] : lies) {
    json document = sound();
    document[json::json_pointer(pointer)] = lie;
    EXPECT_THAT(repair(document), ElementsAre(AllOf(HasSubstr("in no list"), HasSubstr(pointer))));
    EXPECT_FALSE(document.contains(json::json_pointer(pointer))) << pointer;
  }
}

TEST(GltfSchema, WhatIsListedTwiceCountsOnce) {
  json document = sound();
  document["nodes"][0]["children"] = {1, 1};
  document["scenes"][0]["nodes"] = {0, 0, 0};
  document["skins"][0]["joints"] = {1, 0, 1};
  EXPECT_THAT(repair(document), UnorderedElementsAre(HasSubstr("3 places, the first is /scenes/0/nodes/1"),
                                                     HasSubstr("/skins/0/joints/2")));
  EXPECT_EQ(document["nodes"][0]["children"], json::array({1}));
  EXPECT_EQ(document["scenes"][0]["nodes"], json::array({0}));
  EXPECT_EQ(document["skins"][0]["joints"], json::array({1, 0, 1})) << "vertices count them";
}

TEST(GltfSchema, TellsOfEmptyArraysAndOfWhatMeansNothingAlone) {
  json document = sound();
  document["nodes"][1]["children"] = json::array();
  document["nodes"][1]["weights"] = {1};
  document["accessors"][0].erase("bufferView");
  document["accessors"][0]["byteOffset"] = 0;
  EXPECT_THAT(repair(document), UnorderedElementsAre(HasSubstr("/nodes/1/children"), HasSubstr("/nodes/1/weights"),
                                                     HasSubstr("/accessors/0/byteOffset")));
}

TEST(GltfSchema, RefusesMissingMembers) {
  for (const auto& [parent, key] : {std::pair<const char*, const char*>{"/meshes/0", "primitives"},
                                    {"/meshes/0/primitives/0", "attributes"},
                                    {"/materials/0/normalTexture", "index"}}) {
    json document = sound();
    document.at(json::json_pointer(parent)).erase(key);
    EXPECT_THAT(check(document), Contains(ProblemAt(ProblemCode::invalidScene, std::string(parent) + "/" + key)));
  }
  for (const auto& [parent, key] : {std::pair<const char*, const char*>{"/accessors/0", "count"},
                                    {"/bufferViews/0", "buffer"},
                                    {"/accessors/0/sparse", "values"},
                                    {"/animations/0", "channels"},
                                    {"/cameras/0", "type"}}) {
    json document = sound();
    document.at(json::json_pointer(parent)).erase(key);
    EXPECT_THAT(repair(document), Contains(HasSubstr(std::string(parent) + "/" + key)));
    EXPECT_NE(whyLeftOut(document, parent), "");
  }
}

TEST(GltfSchema, RefusesWrongArrays) {
  json document = sound();
  document["nodes"][1]["rotation"] = {0, 0, 1};
  document["meshes"] = json::object();
  const Problems problems = check(document);
  EXPECT_THAT(problems, Contains(ProblemAt(ProblemCode::invalidScene, "/nodes/1/rotation")));
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
