// What exporters get wrong and what changes no picture is repaired: the picture is that of the conforming file, the
// summary and the report tell of it, and a file that has to conform is refused.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <set>

#include "renderer/image/picture_encode.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using nlohmann::json;
using testing::floatsOf;
using testing::GlbBuilder;
using testing::renderJson;
using testing::sceneOf;

/// A ground, and a quad with a picture that stands on it: node 1, material 1.
GlbBuilder reference() {
  GlbBuilder builder;
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 16; ++i) {
    for (const int step : {17, 53, 91}) texels.push_back(static_cast<std::uint8_t>(i * step % 256));
  }
  const Image image{4, 4, {"R", "G", "B"}, texels};
  builder.add("images", {{"bufferView", builder.addView(*encodePng(image, 1))}, {"mimeType", "image/png"}});
  builder.add("textures", {{"source", 0}});
  builder.add("materials",
              {{"pbrMetallicRoughness", {{"baseColorFactor", {0.7, 0.7, 0.7, 1}}, {"metallicFactor", 0}}}});
  builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}}}});
  const auto addQuad = [&](const std::vector<testing::Point>& corners, const testing::Point& normal, int material) {
    const json attributes = {
        {"POSITION", builder.addPoints(corners)},
        {"NORMAL", builder.addPoints({normal, normal, normal, normal})},
        {"TEXCOORD_0", builder.addAccessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 5126, 4)}};
    builder.addMeshNode(builder.addMesh({{"attributes", attributes},
                                         {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})},
                                         {"material", material}}));
  };
  addQuad({{-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}}, {0, 1, 0}, 0);
  addQuad({{-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}}, {0, 0, 1}, 1);
  return builder;
}

/// Of an exporter: what it makes of a file, and what is said of that.
struct Mistake {
  const char* told;
  void (*make)(GlbBuilder&);
  bool isViolation = true; ///< refused where the file has to conform
};

json& quad(GlbBuilder& file) {
  return file.json["meshes"][1]["primitives"][0];
}

json& pbr(GlbBuilder& file) {
  return file.json["materials"][1]["pbrMetallicRoughness"];
}

void addChild(GlbBuilder& file, json node) {
  file.json["nodes"].push_back(std::move(node));
}

void useExtension(GlbBuilder& file, const char* name) {
  file.json["extensionsUsed"].push_back(name);
}

void addLight(GlbBuilder& file, json light) {
  json& lights = file.json["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back(std::move(light));
  file.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}, {"translation", {0, 3, 3}}});
}

void addAnimation(GlbBuilder& file, const std::vector<float>& times, const char* interpolation) {
  const std::vector<testing::Point> places(times.size(), {0, 5, 0});
  const json sampler = {{"input", file.addAccessor(times, "SCALAR", 5126, times.size())},
                        {"output", file.addPoints(places)},
                        {"interpolation", interpolation}};
  const json channel = {{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}};
  file.add("animations", {{"samplers", {sampler}}, {"channels", {channel}}});
}

constexpr Mistake kMistakes[] = {
    {"beyond its limit by rounding",
     [](GlbBuilder& file) {
       pbr(file)["baseColorFactor"] = {1.00000012, 1, 1, 1};
     }},
    {"beyond its limit by rounding", [](GlbBuilder& file) { pbr(file)["roughnessFactor"] = 1.0000001192092896; }},
    {"beyond its limit by rounding", [](GlbBuilder& file) { pbr(file)["metallicFactor"] = -1e-7; }},
    {"last row of a matrix",
     [](GlbBuilder& file) {
       file.json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.99999994};
     }},
    {"in no list", [](GlbBuilder& file) { file.json["materials"][1]["alphaMode"] = "opaque"; }},
    {"in no list",
     [](GlbBuilder& file) {
       file.json["textures"][0]["sampler"] = file.add("samplers", {{"magFilter", 9987}, {"wrapS", 10496}});
     }},
    {"the light is left out",
     [](GlbBuilder& file) {
       addLight(file, {{"type", "ambient"}});
     }},
    {"the light is left out",
     [](GlbBuilder& file) {
       addLight(file, {{"type", "point"}, {"range", 0}});
     }},
    {"the light is left out",
     [](GlbBuilder& file) {
       addLight(file, {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.9}, {"outerConeAngle", 0.5}}}});
     }},
    {"the camera is left out",
     [](GlbBuilder& file) {
       file.addRoot({{"camera",
                      file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 3.5}, {"znear", 1}}}})}});
     }},
    {"the camera is left out",
     [](GlbBuilder& file) {
       file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0}}}});
     }},
    {"the animation's channels that use it are left out",
     [](GlbBuilder& file) {
       addAnimation(file, {0, 1}, "BEZIER");
     }},
    {"the animation's channel is left out",
     [](GlbBuilder& file) {
       addAnimation(file, {0, 1, 1, 2}, "LINEAR");
     }},
    {"what needs it is left out",
     [](GlbBuilder& file) {
       file.add("accessors",
                {{"bufferView", file.addView(Bytes(14))}, {"componentType", 5121}, {"count", 2}, {"type", "MAT2"}});
     }},
    {"what needs it is left out",
     [](GlbBuilder& file) {
       file.add("accessors", {{"componentType", 5130}, {"count", 2}, {"type", "SCALAR"}});
     }},
    {"what needs it is left out",
     [](GlbBuilder& file) {
       file.add("bufferViews", {{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 0}});
     }},
    {"textures that use it are left out",
     [](GlbBuilder& file) {
       file.add("images", {{"bufferView", file.addView(Bytes(64))}, {"mimeType", "image/png"}});
     }},
    {"what needs it is left out",
     [](GlbBuilder& file) {
       file.add("images", {{"uri", "gone.png"}});
     }},
    {"it is left out",
     [](GlbBuilder& file) {
       quad(file)["attributes"]["TEXCOORD_1"] = file.addAccessor(std::vector<float>(6), "VEC2", 5126, 3);
       file.json["materials"][1]["occlusionTexture"] = {{"index", 0}, {"texCoord", 1}, {"strength", 0}};
     }},
    {"the triangles that use it are left out",
     [](GlbBuilder& file) {
       quad(file)["indices"] = file.addShortIndices({0, 1, 2, 0, 1, 400, 0, 2, 3});
     }},
    {"the triangles that use it are left out",
     [](GlbBuilder& file) {
       quad(file)["indices"] = file.addShortIndices({0, 1, 2, 0, 2, 3, 65535, 0, 1});
     }},
    {"the primitive is left out",
     [](GlbBuilder& file) {
       json faulty = quad(file);
       faulty["attributes"]["POSITION"] = file.add("accessors", {{"bufferView", 0},
                                                                 {"componentType", 5126},
                                                                 {"count", 4000},
                                                                 {"type", "VEC3"},
                                                                 {"min", {0, 0, 0}},
                                                                 {"max", {1, 1, 1}}});
       file.json["meshes"][1]["primitives"].push_back(faulty);
     }},
    {"child of another",
     [](GlbBuilder& file) {
       addChild(file, {{"children", {1}}});
       file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size() - 1);
     }},
    {"child of another",
     [](GlbBuilder& file) {
       addChild(file, {{"children", {0}}, {"translation", {0, 4, 0}}, {"name", "tmpParent"}});
     }},
    {"listed twice", [](GlbBuilder& file) { file.json["scenes"][0]["nodes"].push_back(1); }},
    {"no elements", [](GlbBuilder& file) { file.json["skins"] = json::array(); }},
    {"not listed in `extensionsUsed`",
     [](GlbBuilder& file) {
       useExtension(file, "KHR_mesh_quantization");
       file.json["nodes"][0]["extensions"]["KHR_node_visibility"] = {{"visible", true}};
     }},
    {"not those of its elements",
     [](GlbBuilder& file) {
       file.json["accessors"][0]["max"] = {30, 0, 3};
     }},
    {"no min and max", [](GlbBuilder& file) { file.json["accessors"][0].erase("min"); }},
    {"byteStride is 0", [](GlbBuilder& file) { file.json["bufferViews"][1]["byteStride"] = 0; }},
    {"requires the extension",
     [](GlbBuilder& file) {
       useExtension(file, "KHR_materials_specular");
       file.json["extensionsRequired"].push_back("KHR_materials_specular");
       file.json["materials"][0]["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0}};
     }},
    {"changes no pixel",
     [](GlbBuilder& file) {
       useExtension(file, "KHR_xmp_json_ld");
       file.json["extensionsRequired"].push_back("KHR_xmp_json_ld");
     }},
};

/// From the side, in the light of a sun of the request.
const std::string kSpec = R"({"width":64,"height":48,"camera":{"eye":[3,3,5],"target":[0,0.8,0]},
    "lights":[{"sun":{"azimuthDegrees":200,"elevationDegrees":50}}],"views":["color","shadow","ids"],
    "output":{"format":"exr","exrPixelType":"float"}})";

void expectSamePicture(const SceneBundle& file, const Frame& expected, const std::vector<std::string>& told) {
  const ScenePtr scene = sceneOf(file);
  const Frame frame = renderJson(scene, kSpec);
  for (const std::size_t view : {0u, 1u, 2u}) EXPECT_EQ(floatsOf(frame, view), floatsOf(expected, view)) << view;
  for (const std::string& each : told) {
    EXPECT_THAT(summaryOf(*scene).warnings, ::testing::Contains(::testing::HasSubstr(each)));
    EXPECT_THAT(frame.report.warnings, ::testing::Contains(::testing::HasSubstr(each)));
  }
}

void expectRefusedAsStrict(SceneBundle file) {
  file.strict = true;
  EXPECT_FALSE(loadScene(file));
}

TEST(RepairedFiles, AConformingOneIsTakenAsItIs) {
  SceneBundle file = reference().bundle();
  file.strict = true;
  const ScenePtr scene = sceneOf(file);
  EXPECT_THAT(summaryOf(*scene).warnings, ::testing::IsEmpty());
  EXPECT_THAT(renderJson(scene, kSpec).report.warnings, ::testing::IsEmpty());
}

TEST(RepairedFiles, EachMistakeAloneChangesNoPicture) {
  const Frame expected = renderJson(sceneOf(reference()), kSpec);
  for (const Mistake& mistake : kMistakes) {
    GlbBuilder builder = reference();
    mistake.make(builder);
    SCOPED_TRACE(builder.json.dump());
    expectSamePicture(builder.bundle(), expected, {mistake.told});
    expectRefusedAsStrict(builder.bundle());
  }
}

TEST(RepairedFiles, SeveralMistakesTogetherChangeNoPicture) {
  const Frame expected = renderJson(sceneOf(reference()), kSpec);
  rc::check([&expected] {
    const auto chosen =
        *rc::gen::container<std::set<std::size_t>>(rc::gen::inRange<std::size_t>(0, std::size(kMistakes)));
    GlbBuilder builder = reference();
    std::vector<std::string> told;
    for (const std::size_t each : chosen) {
      kMistakes[each].make(builder);
      told.emplace_back(kMistakes[each].told);
    }
    const ScenePtr scene = sceneOf(builder);
    const Frame frame = renderJson(scene, kSpec);
    for (const std::size_t view : {0u, 1u, 2u}) RC_ASSERT(floatsOf(frame, view) == floatsOf(expected, view));
    RC_ASSERT(chosen.empty() || !frame.report.warnings.empty());
  });
}

/// The red of what a spot of the file lights from 10 m above a ground, seen from above in 4 m x 4 m. Radians.
std::vector<float> litBySpot(double inner, double outer) {
  GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"intensity", 1000}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}};
  builder.addRoot({{"translation", {0, 10, 0}},
                   {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                   {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const Json spec = {
      {"width", 64},
      {"height", 64},
      {"antialiasing", "none"},
      {"ambient", {{"intensity", 0}}},
      {"camera", {{"eye", {0, 5, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 4}}}}},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  std::vector<float> red;
  const Frame frame = renderJson(sceneOf(builder), spec.dump());
  const std::vector<float>& color = floatsOf(frame);
  const std::size_t channels = color.size() / (64 * 64);
  for (std::size_t i = 0; i < color.size(); i += channels) red.push_back(color[i]);
  return red;
}

TEST(RepairedFiles, ASpotWhoseConesAreTheSameHasASharpEdge) {
  for (const double degrees : {0.5, 2.0, 8.0}) {
    const double outer = degrees * std::acos(-1.0) / 180;
    const std::vector<float> sharp = litBySpot(outer, outer);
    const std::vector<float> wide = litBySpot(0.8, 0.9);
    const double radius = 10 * std::tan(outer);
    for (std::size_t i = 0; i < sharp.size(); ++i) {
      const double x = (static_cast<double>(i % 64) + 0.5) / 16 - 2;
      const double z = (static_cast<double>(i / 64) + 0.5) / 16 - 2;
      ASSERT_TRUE(std::isfinite(sharp[i])) << i;
      const double fromAxis = std::hypot(x, z);
      if (std::abs(fromAxis - radius) < 0.02) continue;
      EXPECT_NEAR(sharp[i], fromAxis < radius ? wide[i] : 0.0f, 1e-3f * wide[i]) << degrees << ' ' << x << ' ' << z;
    }
  }
}

} // namespace
} // namespace gnomon
