#include "tests/support/chosen_scene.h"

#include <algorithm>
#include <cmath>

#include "renderer/image/picture_encode.h"

namespace gnomon::testing {
namespace {

using nlohmann::json;

json vector(Choices& choices, double reach) {
  return {choices.within(0, reach), choices.within(0, -reach), choices.within(-reach, reach)};
}

/// A turn about some axis; its first is none.
json turn(Choices& choices) {
  const double half = choices.within(0, 3.14);
  const double azimuth = choices.within(0, 6.28);
  const double height = choices.within(0, 1);
  const double ring = std::sqrt(1 - height * height) * std::sin(half);
  return {ring * std::cos(azimuth), height * std::sin(half), ring * std::sin(azimuth), std::cos(half)};
}

int addTexture(Choices& choices, GlbBuilder& builder, bool normals) {
  Image image{1 + choices.below(16), 1 + choices.below(16), {"R", "G", "B", "A"}, std::vector<std::uint8_t>{}};
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  const int kinds = 1 + choices.below(4); // texels repeat, so that few bytes make a picture
  std::vector<std::array<std::uint8_t, 4>> texels;
  for (int i = 0; i < kinds; ++i) {
    const auto near = [&](int value) { return static_cast<std::uint8_t>(value + choices.below(48) - 24); };
    if (normals) {
      texels.push_back({near(128), near(128), 255, 255});
    } else {
      texels.push_back({near(170), near(170), near(170), choices.byte()});
    }
  }
  const int step = 1 + choices.below(7);
  for (int i = 0; i < image.width * image.height; ++i) {
    const auto& texel = texels[static_cast<std::size_t>((i + i / image.width) / step % kinds)];
    pixels.insert(pixels.end(), texel.begin(), texel.end());
  }
  const Bytes file = *encodePng(image, 1);
  const int view = builder.addView(file);
  const int source = builder.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
  const int sampler = builder.add("samplers", {{"magFilter", choices.of({9729, 9728})},
                                               {"minFilter", choices.of({9729, 9728, 9987, 9986, 9985, 9984})},
                                               {"wrapS", choices.of({10497, 33071, 33648})},
                                               {"wrapT", choices.of({10497, 33071, 33648})}});
  return builder.add("textures", {{"source", source}, {"sampler", sampler}});
}

void addMaterial(Choices& choices, GlbBuilder& builder) {
  json pbr = {{"baseColorFactor",
               {choices.within(0.8, 0.05), choices.within(0.8, 0.05), choices.within(0.8, 0.05), choices.within(1, 0)}},
              {"roughnessFactor", choices.within(1, 0.3)},
              {"metallicFactor", choices.oneIn(4) ? 1 : 0}};
  if (choices.oneIn(2)) pbr["baseColorTexture"] = {{"index", addTexture(choices, builder, false)}};
  json material = {{"pbrMetallicRoughness", pbr}};
  const char* mode = choices.of({"OPAQUE", "OPAQUE", "MASK", "BLEND"});
  material["alphaMode"] = mode;
  if (mode == std::string("MASK")) material["alphaCutoff"] = choices.within(0.5, 0);
  material["doubleSided"] = !choices.oneIn(4);
  if (choices.oneIn(4)) material["normalTexture"] = {{"index", addTexture(choices, builder, true)}};
  if (choices.oneIn(8)) material["emissiveFactor"] = {choices.within(0, 1), 0.1, 0.2};
  if (choices.oneIn(8)) material["extensions"]["KHR_materials_unlit"] = json::object();
  if (choices.oneIn(8)) material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 0.6}};
  builder.add("materials", material);
}

/// The corners of one more triangle.
void addTriangle(Choices& choices, std::vector<Point>& points) {
  const auto point = [&](float reach) {
    const auto any = [&] { return static_cast<float>(choices.within(-reach, reach)); };
    return Point{any(), any(), any()};
  };
  const auto along = [](const Point& a, const Point& b, float share, float aside) {
    return Point{a[0] + share * (b[0] - a[0]) + aside, a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
  };
  const int kind = choices.below(8);
  if (kind == 1 && points.size() >= 3) { // shares an edge with the one before
    const Point second = points[points.size() - 1];
    const Point first = points[points.size() - 2];
    points.insert(points.end(), {second, first, point(1)});
    return;
  }
  const Point a = point(1);
  if (kind == 2) { // tiny
    const Point by = point(1e-3f);
    points.insert(points.end(), {a, {a[0] + by[0], a[1] + by[1], a[2]}, {a[0], a[1] + by[0], a[2] + by[2]}});
    return;
  }
  Point b = point(1);
  Point c = point(1);
  if (kind == 3) c = along(a, b, 0.3f, static_cast<float>(choices.factor(1e-2, 1e-7))); // a sliver
  if (kind == 4) c = along(a, b, 0.5f, 0);                                              // of no area
  if (kind == 5) c = b;
  if (kind == 6) { // upright, along the axes
    b = {a[0], a[1] + 1, a[2]};
    c = {a[0] + 1, a[1], a[2]};
  }
  points.insert(points.end(), {a, b, c});
}

void addMesh(Choices& choices, GlbBuilder& builder, int materials) {
  std::vector<Point> points;
  const int triangles = 1 + choices.below(10);
  for (int i = 0; i < triangles; ++i) addTriangle(choices, points);
  json attributes = {{"POSITION", builder.addPoints(points)}};
  if (choices.oneIn(2)) {
    std::vector<Point> normals;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double azimuth = choices.within(0, 6.28);
      normals.push_back(
          {static_cast<float>(0.6 * std::cos(azimuth)), 0.8f, static_cast<float>(0.6 * std::sin(azimuth))});
    }
    attributes["NORMAL"] = builder.addPoints(normals);
  }
  std::vector<float> coordinates;
  for (std::size_t i = 0; i < 2 * points.size(); ++i) coordinates.push_back(static_cast<float>(choices.within(0, 2)));
  attributes["TEXCOORD_0"] = builder.addAccessor(coordinates, "VEC2", 5126, points.size());
  if (choices.oneIn(4)) {
    std::vector<std::uint8_t> colors;
    for (std::size_t i = 0; i < 4 * points.size(); ++i)
      colors.push_back(static_cast<std::uint8_t>(255 - choices.byte() / 2));
    attributes["COLOR_0"] = builder.addAccessor(colors, "VEC4", 5121, points.size(), true);
  }
  json primitive = {{"attributes", attributes}, {"material", choices.below(materials)}};
  if (choices.oneIn(2)) {
    std::vector<std::uint32_t> indices(points.size());
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
    primitive["indices"] = builder.addIndices(indices);
  }
  builder.addMesh(primitive);
}

json scaleOf(Choices& choices) {
  const auto each = [&] { return choices.factor(1, 3); };
  switch (choices.below(12)) {
    case 0:
    case 1:
      return {1, 1, 1};
    case 2:
    case 3:
      return {-each(), each(), each()};
    case 4:
      return {each(), 0, each()}; // flat
    case 5:
      return {1e-3, 1e-3, 1e-3};
    case 6:
      return {10 * each(), each(), 0.1 * each()};
    default:
      return {each(), each(), each()};
  }
}

json placed(Choices& choices, int mesh) {
  return {
      {"mesh", mesh}, {"translation", vector(choices, 2)}, {"rotation", turn(choices)}, {"scale", scaleOf(choices)}};
}

} // namespace

ChosenScene chosenScene(Choices& choices) {
  ChosenScene scene;
  GlbBuilder& builder = scene.builder;
  const bool floor = !choices.oneIn(4);
  if (floor) {
    builder = plane();
    builder.json.erase("scenes");
    builder.json["nodes"][0].update({{"translation", {0, -1.5, 0}}, {"scale", {8, 1, 8}}});
  }
  builder.json["extensionsUsed"] = {"KHR_materials_unlit", "KHR_materials_transmission"};

  const int materials = 1 + choices.below(3);
  for (int i = 0; i < materials; ++i) addMaterial(choices, builder);
  const int firstMesh = floor ? 1 : 0;
  const int meshes = 1 + choices.below(3);
  for (int i = 0; i < meshes; ++i) addMesh(choices, builder, materials);

  json children = floor ? json::array({0}) : json::array();
  const int placements = 1 + choices.below(5);
  for (int i = 0; i < placements; ++i) {
    const int mesh = firstMesh + choices.below(meshes);
    children.push_back(builder.add("nodes", placed(choices, mesh)));
  }
  scene.nodes = static_cast<int>(children.size());
  if (choices.oneIn(4)) { // sheared: turned, and stretched by what is above
    json above = {
        {"children", json::array({children.back()})}, {"scale", scaleOf(choices)}, {"rotation", turn(choices)}};
    children.back() = builder.add("nodes", above);
  }
  scene.scale = choices.of({1.0, 1.0, 1.0, 1e-3, 1e3, 1e5});
  if (choices.oneIn(8)) scene.centre = {1e5 * scene.scale, 0, -1e5 * scene.scale};
  builder.addRoot(
      {{"children", children}, {"scale", {scene.scale, scene.scale, scene.scale}}, {"translation", scene.centre}});
  return scene;
}

} // namespace gnomon::testing
