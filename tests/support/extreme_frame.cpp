#include "tests/support/extreme_frame.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "protocol/json/json_codec.h"
#include "tests/renderer/made_grids.h"

namespace gnomon::testing {
namespace {

using nlohmann::json;

double sign(Choices& choices) {
  return choices.oneIn(2) ? -1 : 1;
}

/// What a file may hold; half of it lies within reach of a scene.
double extreme(Choices& choices) {
  if (choices.oneIn(2)) return choices.of({1.9e9, 1e9, 1e-9, 1e8, 1e6, 1e-20, 1e-38, 0.0, 1e-45, 30.0}) * sign(choices);
  const double size =
      choices.of({1e9, 1e-9, 1e11, 1e30, 3.4e38, 1e-38, 1e-45, 1e19, 1e18, 1e8, 1.9e9, 1e7, 1e5, 0.0, 1e-20, 1e-30});
  return std::min(3.4e38, size * (choices.oneIn(2) ? 1 : choices.within(0.5, 1.5))) * sign(choices);
}

/// What a request may say of most lengths and places.
double extremeAllowed(Choices& choices) {
  return choices.of({1e9, 1e-9, 9.9e8, 1e8, 1e6, 1e-6, 1e-300, 0.0, 1e-38, 1e-20, 1e3}) * sign(choices);
}

json extremes(Choices& choices, std::size_t count) {
  json numbers = json::array();
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(choices.oneIn(3) ? 1.0 : extreme(choices));
  return numbers;
}

/// Some of an accessor's floats, or all by the same factor.
void changeFloats(Choices& choices, GlbBuilder& builder) {
  const json& accessors = builder.json["accessors"];
  json& accessor = builder.json["accessors"][std::size_t(choices.byte()) % accessors.size()];
  if (accessor.value("componentType", 0) != 5126) return;
  const json& view = builder.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t first = view.value("byteOffset", std::size_t{0});
  const std::size_t floats = view["byteLength"].get<std::size_t>() / sizeof(float);
  if (floats == 0) return;
  accessor.erase("min");
  accessor.erase("max");
  const auto change = [&](std::size_t at, const auto& to) {
    float value = 0;
    std::memcpy(&value, &builder.binary[first + at * sizeof value], sizeof value);
    value = static_cast<float>(to(double{value}));
    std::memcpy(&builder.binary[first + at * sizeof value], &value, sizeof value);
  };
  if (choices.oneIn(4)) {
    const double factor = extreme(choices);
    for (std::size_t i = 0; i < floats; ++i) {
      change(i, [&](double value) { return std::clamp(value * factor, -3.4e38, 3.4e38); });
    }
    return;
  }
  for (int left = 1 + choices.below(4); left > 0; --left) {
    const std::size_t at = (std::size_t(choices.byte()) << 8 | choices.byte()) % floats;
    const double to = extreme(choices);
    change(at, [&](double) { return to; });
  }
}

void changeNode(Choices& choices, json& node) {
  node.erase("matrix");
  switch (choices.below(4)) {
    case 0:
      node["translation"] = extremes(choices, 3);
      break;
    case 1:
      node["scale"] = extremes(choices, 3);
      break;
    case 2: {
      const double all = extreme(choices);
      node["scale"] = {all, all, all};
      break;
    }
    default:
      for (const char* part : {"translation", "rotation", "scale"}) node.erase(part);
      node["matrix"] = extremes(choices, 16);
      for (const std::size_t zero : {3, 7, 11}) node["matrix"][zero] = 0;
      node["matrix"][15] = 1;
      break;
  }
}

/// The frame looks through the camera, and the light shines where it has none of its own.
void addCameraAndLight(Choices& choices, GlbBuilder& builder, json& spec) {
  const double near = std::abs(extreme(choices));
  json camera = {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", near}, {"zfar", 2 * near}}}};
  if (choices.oneIn(2)) {
    const double size = extreme(choices);
    camera = {{"type", "orthographic"},
              {"orthographic", {{"xmag", size}, {"ymag", size}, {"znear", 0}, {"zfar", near}}}};
  }
  const int eye = builder.addRoot({{"camera", builder.add("cameras", camera)}, {"translation", extremes(choices, 3)}});
  spec["camera"] = {{"node", eye}};
  const char* type = choices.of({"point", "spot", "directional"});
  json light = {{"type", type}, {"intensity", std::abs(extreme(choices))}};
  if (light["type"] == "spot") light["spot"] = {{"outerConeAngle", 0.7}};
  if (light["type"] != "directional" && choices.oneIn(2)) light["range"] = std::abs(extreme(choices));
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  builder.addRoot({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", extremes(choices, 3)}});
}

/// More triangles than are sorted for rays with care.
void addManyTriangles(GlbBuilder& builder, float size) {
  constexpr int kCells = 96;
  std::vector<Point> points;
  std::vector<std::uint32_t> indices;
  for (int z = 0; z <= kCells; ++z) {
    for (int x = 0; x <= kCells; ++x) {
      points.push_back({size * float(x - kCells / 2) / kCells, 0, size * float(z - kCells / 2) / kCells});
      if (x == kCells || z == kCells) continue;
      const auto at = std::uint32_t(z * (kCells + 1) + x);
      const std::uint32_t below = at + kCells + 1;
      for (const std::uint32_t corner : {at, below, at + 1, at + 1, below, below + 1}) indices.push_back(corner);
    }
  }
  const int positions = builder.addPoints(points);
  builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", builder.addIndices(indices)}}));
}

/// A morph target of the first mesh, or an animation of the first node.
void addMotion(Choices& choices, GlbBuilder& builder, json& spec) {
  json& primitive = builder.json["meshes"][0]["primitives"][0];
  const auto positions = primitive["attributes"]["POSITION"].get<std::size_t>();
  const auto count = builder.json["accessors"][positions]["count"].get<std::size_t>();
  if (choices.oneIn(2)) {
    std::vector<float> moves(3 * count);
    for (float& move : moves) move = choices.oneIn(4) ? static_cast<float>(extreme(choices)) : 0.0f;
    primitive["targets"] = {{{"POSITION", builder.addAccessor(moves, "VEC3", 5126, count)}}};
    builder.json["meshes"][0]["weights"] = {extreme(choices)};
    return;
  }
  const int times = builder.addAccessor(std::vector<float>{0, 1}, "SCALAR", 5126, 2);
  builder.json["accessors"][std::size_t(times)]["min"] = {0};
  builder.json["accessors"][std::size_t(times)]["max"] = {1};
  std::vector<float> values{1, 1, 1, 1, 1, 1};
  for (std::size_t i = 3; i < 6; ++i) values[i] = static_cast<float>(extreme(choices));
  const int output = builder.addAccessor(values, "VEC3", 5126, 2);
  builder.json["nodes"][0].erase("matrix");
  builder.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", output}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", choices.of({"translation", "scale"})}}}}}}}};
  spec["animation"] = {{"index", 0}, {"timeSeconds", choices.of({1.0, 0.5, 1e-9})}};
}

void addVolume(Choices& choices, ExtremeFrame& frame) {
  frame.bundle.files["grid.npy"] = byteGrid(3, 3, 3, [](int x, int y, int z) { return 20 * (x + y + z); });
  json volume = {{"file", "grid.npy"},
                 {"transferFunction", {{{"value", 0}, {"extinction", choices.of({0.1, 1e6, 1e-9})}}}}};
  json least = json::array(), most = json::array();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = extremeAllowed(choices);
    const double b = extremeAllowed(choices);
    least.push_back(std::min(a, b));
    most.push_back(std::max(a, b));
  }
  volume["box"] = {{"min", least}, {"max", most}};
  if (choices.oneIn(2)) volume["node"] = 0;
  frame.spec["volumes"] = {volume};
}

/// The places of all numbers that are no whole ones.
void findNumbers(json& value, std::vector<json*>& numbers) {
  if (value.is_number_float()) numbers.push_back(&value);
  if (!value.is_structured()) return;
  for (json& member : value) findNumbers(member, numbers);
}

/// Numbers that may be extreme.
void changeSpec(Choices& choices, json& spec) {
  std::vector<json*> numbers;
  findNumbers(spec, numbers);
  for (int left = 4 * choices.below(4); left > 0 && !numbers.empty(); --left) {
    json& number = *numbers[choices.byte() % numbers.size()];
    const json before = std::exchange(number, extremeAllowed(choices));
    if (!decodeFrameSpec(spec.dump())) number = before;
  }
  if (choices.oneIn(6) && !spec["camera"].contains("node")) {
    spec["camera"]["eye"] = {extremeAllowed(choices), extremeAllowed(choices), extremeAllowed(choices)};
    spec["camera"]["target"] = {0, 0, 0};
    spec["camera"].erase("orbit");
  }
}

} // namespace

ExtremeFrame extremeFrame(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kExtremeBytes = 128;
  constexpr std::size_t kSpecBytes = 256;
  const std::size_t first = std::min(kExtremeBytes, bytes.size());
  const std::size_t second = std::min(first + kSpecBytes, bytes.size());
  Choices choices(bytes.first(first));
  Choices ofSpec(bytes.subspan(first, second - first));
  Choices ofScene(bytes.subspan(second));
  ChosenScene scene = chosenScene(ofScene);
  ExtremeFrame frame{{}, chosenSpec(ofSpec, scene)};
  frame.spec["width"] = 32;
  frame.spec["height"] = 24;
  const bool isLarge = choices.oneIn(4);
  if (isLarge) addManyTriangles(scene.builder, choices.of({1.0f, 30.0f, 1e-6f, 1e8f}));
  if (choices.oneIn(4)) addMotion(choices, scene.builder, frame.spec);
  for (int left = choices.of({1, 1, 2, 0}); left > 0; --left) changeFloats(choices, scene.builder);
  if (choices.oneIn(3)) {
    json& nodes = scene.builder.json["nodes"];
    changeNode(choices, nodes[choices.byte() % nodes.size()]);
  }
  if (choices.oneIn(4)) addCameraAndLight(choices, scene.builder, frame.spec);
  if (choices.oneIn(6)) addVolume(choices, frame);
  changeSpec(choices, frame.spec);
  json& shadow = frame.spec["shadow"];
  shadow["technique"] = choices.of({"rayTraced", "rayTraced", "shadowMap", "lightMap"});
  shadow["lightMap"] = {{"size", 64}};
  if (isLarge && shadow["technique"] == "lightMap") shadow["technique"] = "rayTraced";
  if (choices.oneIn(24)) frame.spec["quality"] = {{"maxError", 0.01}};
  frame.bundle.model = scene.builder.glb();
  return frame;
}

} // namespace gnomon::testing
