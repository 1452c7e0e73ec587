#include "protocol/fields/json_schema.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/base/result.h"
#include "protocol/fields/field_codec.h"
#include "protocol/fields/field_list.h"
#include "protocol/openapi/openapi.h"
#include "protocol/report/reply_rows.h"
#include "protocol/spec/validate.h"
#include "tests/protocol/schema_check.h"
#include "tests/protocol/spec_generator.h"

namespace gnomon {
namespace {

const Json& document() {
  static const Json kDocument = openApi();
  return kDocument;
}

const Json& schemaNamed(const std::string& name) {
  return document().at("components").at("schemas").at(name);
}

std::string checkSpec(const Json& json) {
  return checkAgainstSchema(json, schemaNamed("FrameSpec"), document());
}

template <class T>
struct Unwrapped {
  using Type = T;
};
template <class T>
struct Unwrapped<std::optional<T>> : Unwrapped<T> {};
template <class T>
struct Unwrapped<std::vector<T>> : Unwrapped<T> {};

/// Every row of T, and of what T leads to, is a property with its description, unit and range.
template <Described T>
void expectRows(const Json& schema) {
  forEachField<T>([&]<class F>(const F& field) {
    using Member = typename F::Member;
    using Inner = typename Unwrapped<Member>::Type;
    if constexpr (Described<Inner>) {
      if (field.inlined) return expectRows<Inner>(schema);
    }
    const std::string name(field.name);
    ASSERT_TRUE(schema["properties"].contains(name)) << kRows<T>.name << "." << name;
    const Json& property = schema["properties"][name];
    EXPECT_EQ(property["description"].template get<std::string>().find(field.notes.says), 0u) << name;
    EXPECT_EQ(property.value("x-unit", ""), field.notes.unit) << name;
    if constexpr (Described<Inner>) expectRows<Inner>(schemaNamed(std::string(kRows<Inner>.name)));
  });
}

TEST(JsonSchema, EveryRowIsAProperty) {
  expectRows<FrameSpec>(schemaNamed("FrameSpec"));
  expectRows<FrameReply>(schemaNamed("FrameReply"));
  expectRows<SceneList>(schemaNamed("SceneList"));
  expectRows<Capabilities>(schemaNamed("Capabilities"));
}

TEST(JsonSchema, EveryObjectIsClosed) {
  for (const auto& [name, schema] : document()["components"]["schemas"].items()) {
    EXPECT_EQ(schema["type"], "object") << name;
    EXPECT_EQ(schema["additionalProperties"], false) << name;
    EXPECT_FALSE(schema["description"].get<std::string>().empty()) << name;
  }
}

TEST(JsonSchema, SaysWhatTheRowsSay) {
  const Json& spec = schemaNamed("FrameSpec")["properties"];
  EXPECT_EQ(
      spec["width"].dump(),
      R"({"type":"integer","minimum":1,"maximum":16384,)"
      R"("description":"Width of the picture. Time of shading grows with the number of pixels. Unit: pixels.","x-unit":"pixels","default":1280})");
  EXPECT_EQ(spec["views"]["uniqueItems"], true);
  EXPECT_EQ(spec["views"]["minItems"], 1);
  EXPECT_EQ(spec["views"]["default"].dump(), R"(["color"])");
  EXPECT_EQ(spec["lights"]["maxItems"], 256);
  const Json& fov = schemaNamed("Perspective")["properties"]["fovYDegrees"];
  EXPECT_EQ(fov["exclusiveMinimum"], 0);
  EXPECT_EQ(fov["exclusiveMaximum"], 180);
  EXPECT_EQ(schemaNamed("Filter")["properties"]["size"]["enum"].dump(), "[3,5,7]");
  EXPECT_EQ(schemaNamed("Output")["properties"]["exrPixelType"]["enum"].dump(), R"(["half","float"])");
  EXPECT_FALSE(schemaNamed("Camera")["properties"].contains("lookAt"));
}

TEST(JsonSchema, RepliesRequireWhatIsAlwaysThere) {
  EXPECT_EQ(schemaNamed("FrameReply")["required"].dump(), R"(["report","images"])");
  EXPECT_FALSE(schemaNamed("FrameSpec").contains("required"));
}

TEST(JsonSchema, TheDefaultsFit) {
  EXPECT_EQ(checkSpec(toJson(FrameSpec{})), "ok");
  EXPECT_EQ(checkSpec(Json::object()), "ok");
}

TEST(JsonSchema, EveryGoodSpecFits) {
  EXPECT_TRUE(rc::check([] {
    const FrameSpec spec = *anySpec();
    RC_ASSERT(checkSpec(toJson(spec)) == "ok");
  }));
}

TEST(JsonSchema, TwoPlacementsDoNotFit) {
  EXPECT_EQ(checkSpec({{"camera", {{"orbit", Json::object()}, {"fit", true}}}}), "/camera");
  EXPECT_EQ(checkSpec({{"camera", {{"up", {0, 1, 0}}, {"fit", true}}}}), "/camera");
  EXPECT_EQ(checkSpec({{"lights", Json::array({{{"direction", {0, 1, 0}}, {"sun", Json::object()}}})}}), "/lights/0");
}

/// Every place in the document, deepest last.
void collectPlaces(Json& value, std::vector<Json*>& places) {
  places.push_back(&value);
  if (value.is_structured()) {
    for (auto& inner : value) collectPlaces(inner, places);
  }
}

TEST(JsonSchema, AgreesWithTheDecoderOnSpoiledSpecs) {
  int refused = 0;
  EXPECT_TRUE(rc::check([&] {
    Json json = toJson(*anySpec());
    std::vector<Json*> places;
    collectPlaces(json, places);
    Json& spoiled = *places[*rc::gen::inRange<std::size_t>(0, places.size())];
    const std::vector<Json> spoilers = {nullptr,
                                        true,
                                        false,
                                        0,
                                        -1,
                                        3.7,
                                        6,
                                        1e12,
                                        1e-12,
                                        "color",
                                        "",
                                        Json::array(),
                                        Json::object(),
                                        {{"unknown", 1}},
                                        5e9,
                                        18446744073709551615u};
    spoiled = *rc::gen::elementOf(spoilers);
    const bool fits = checkSpec(json) == "ok";
    const Result<FrameSpec> spec = decodeFrameSpec(json.dump());
    if (spec) {
      RC_ASSERT(fits);
    } else if (fits) {
      // What the schema can't say are the rules across fields, and those alone: the values are all taken.
      ProblemList problems;
      FrameSpec taken;
      decodeValue(*readJson(json.dump(), problems), Notes{}, Place(), problems, taken);
      if (!problems.empty()) RC_FAIL(problems.problems()[0].pointer + " " + json.dump());
      RC_ASSERT(!brokenRules(taken).empty());
    }
    refused += !spec;
  }));
  EXPECT_GT(refused, 20);
}

TEST(JsonSchema, RepliesFitTheirs) {
  FrameReply reply;
  reply.report.stages = {{"queue", 1}, {"shade", 2}};
  reply.report.lights = {{.note = "x", .tiles = {{}, {}}}};
  reply.images = {{"color", "image/png", "AAAA"}};
  EXPECT_EQ(checkAgainstSchema(toJson(reply), schemaNamed("FrameReply"), document()), "ok");
  const SceneList list{{SceneSummary{.cameras = {{}}, .lights = {{}}, .extensionsUsed = {"KHR_x"}}}};
  EXPECT_EQ(checkAgainstSchema(toJson(list), schemaNamed("SceneList"), document()), "ok");
  EXPECT_EQ(checkAgainstSchema(toJson(Capabilities{}), schemaNamed("Capabilities"), document()), "ok");
  EXPECT_EQ(toJson(Capabilities{})["limits"]["maxSceneBytes"], kLimits.maxSceneBytes);
}

const FieldEntry& entryAt(const std::vector<FieldEntry>& entries, const std::string& path) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.path == path; });
  if (found == entries.end()) throw std::runtime_error("no field " + path);
  return *found;
}

TEST(FieldList, TellsEachFieldOnce) {
  std::set<std::string> paths;
  for (const FieldEntry& entry : frameFields()) {
    EXPECT_TRUE(paths.insert(entry.path).second) << entry.path;
    EXPECT_FALSE(entry.type.empty()) << entry.path;
    EXPECT_FALSE(entry.says.empty()) << entry.path;
  }
  for (const char* path : {"width", "camera.eye", "camera.orbit.distance", "lights[].sun.azimuthDegrees",
                           "lights[].shadow", "shadow.partition.splits", "output.exrPixelType"}) {
    EXPECT_TRUE(paths.contains(path)) << path;
  }
  EXPECT_FALSE(paths.contains("lights[].shadow.size"));
  EXPECT_FALSE(paths.contains("camera"));
}

TEST(FieldList, TellsTypeBoundsUnitAndDefault) {
  const std::vector<FieldEntry> entries = frameFields();
  const FieldEntry& width = entryAt(entries, "width");
  EXPECT_EQ(width.type, "whole number");
  EXPECT_EQ(width.allowed, "1..16384");
  EXPECT_EQ(width.unit, "pixels");
  EXPECT_EQ(width.preset, "1280");
  EXPECT_EQ(entryAt(entries, "shadow.filter.type").type, "hard | pcf | vsm | evsm | msm | pcss");
  EXPECT_EQ(entryAt(entries, "shadow.filter.size").allowed, "3, 5 or 7");
  EXPECT_EQ(entryAt(entries, "camera.eye").preset, "");
  EXPECT_EQ(entryAt(entries, "camera.node").type, "whole number or string");
}

TEST(FieldList, TheTableHasARowForEachFieldAndFiveCellsInEach) {
  const std::string table = fieldTable();
  std::size_t rows = 0;
  for (std::size_t begin = 0; begin < table.size(); ++rows) {
    const std::size_t end = table.find('\n', begin);
    const std::string row = table.substr(begin, end - begin);
    std::size_t bars = 0;
    for (std::size_t i = 0; i < row.size(); ++i) bars += row[i] == '|' && (i == 0 || row[i - 1] != '\\');
    EXPECT_EQ(bars, 6u) << row;
    begin = end + 1;
  }
  EXPECT_EQ(rows, frameFields().size() + 2);
  EXPECT_THAT(table, testing::HasSubstr(R"(| `atlas.samples` | whole number | 1 or 4 | `1` | Depths in each texel)"));
  EXPECT_THAT(table, testing::HasSubstr(
                         R"(| `shadow.filter.type` | hard \| pcf \| vsm \| evsm \| msm \| pcss |  | `"pcf"` | How)"));
  EXPECT_THAT(table, testing::HasSubstr("hard = one sample, a sharp edge; pcf = ")) << "what each value means";
}

TEST(FieldList, TheHelpNamesEachField) {
  const std::string help = fieldHelp();
  for (const FieldEntry& entry : frameFields()) EXPECT_THAT(help, testing::HasSubstr("  " + entry.path + " "));
}

} // namespace
} // namespace gnomon
