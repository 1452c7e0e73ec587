#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "renderer/core/parallel.h"
#include "tests/bench/bench_scenes.h"
#include "tests/bench/hall_textures.h"
#include "tests/bench/sheets.h"
#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

using glm::vec2;
using glm::vec3;
using testing::GlbBuilder;

constexpr float kLength = 30, kWidth = 12, kStorey = 6; // metres
constexpr float kAisle = 0.45f * kWidth;                // from the middle to the columns
constexpr int kColumns = 9;                             // along each side
constexpr float kBay = kLength / kColumns;

struct MaterialKind {
  Stuff stuff;
  vec3 color;
};
enum Look {
  floorStone,
  lowerWall,
  upperWall,
  arches,
  lightColumns,
  darkColumns,
  ceiling,
  roof,
  cornice,
  vases,
  relief,
  firstCurtain
};
constexpr int kCurtains = 9;
constexpr int kOpaque = firstCurtain + kCurtains;
constexpr int kPlants = 3;

MaterialKind kindOf(int look) {
  constexpr std::array<MaterialKind, firstCurtain> kStone{{{Stuff::bricks, {0.75f, 0.68f, 0.6f}},
                                                           {Stuff::bricks, {0.72f, 0.6f, 0.48f}},
                                                           {Stuff::bricks, {0.68f, 0.56f, 0.5f}},
                                                           {Stuff::stone, {0.75f, 0.7f, 0.62f}},
                                                           {Stuff::stone, {0.7f, 0.66f, 0.6f}},
                                                           {Stuff::stone, {0.62f, 0.6f, 0.58f}},
                                                           {Stuff::bricks, {0.7f, 0.66f, 0.6f}},
                                                           {Stuff::bricks, {0.6f, 0.3f, 0.2f}},
                                                           {Stuff::stone, {0.65f, 0.6f, 0.5f}},
                                                           {Stuff::stone, {0.55f, 0.5f, 0.42f}},
                                                           {Stuff::stone, {0.7f, 0.62f, 0.45f}}}};
  if (look < firstCurtain) return kStone[static_cast<std::size_t>(look)];
  if (look >= kOpaque) return {Stuff::leaves, {0.3f, 0.5f, 0.16f}};
  constexpr std::array<vec3, 3> kDyes{{{0.6f, 0.1f, 0.1f}, {0.1f, 0.35f, 0.15f}, {0.12f, 0.16f, 0.5f}}};
  return {Stuff::cloth, kDyes[static_cast<std::size_t>(look) % 3]};
}

int addImage(GlbBuilder& glb, const Bytes& file, const char* type) {
  const int image = glb.add("images", {{"bufferView", glb.addView(file)}, {"mimeType", type}});
  return glb.add("textures", {{"source", image}});
}

void addMaterials(GlbBuilder& glb) {
  std::vector<MaterialTextures> textures(kOpaque + kPlants);
  forEach(textures.size(), [&](std::size_t i) {
    const MaterialKind kind = kindOf(static_cast<int>(i));
    textures[i] = texturesOf(kind.stuff, kind.color, static_cast<unsigned>(i));
  });
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const bool plant = i >= kOpaque;
    nlohmann::json material;
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] =
        addImage(glb, textures[i].baseColor, plant ? "image/png" : "image/jpeg");
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"] =
        addImage(glb, textures[i].roughness, "image/jpeg");
    material["normalTexture"]["index"] = addImage(glb, textures[i].normal, "image/jpeg");
    material["doubleSided"] = i >= firstCurtain;
    if (plant) material["alphaMode"] = "MASK";
    glb.add("materials", std::move(material));
  }
}

/// `side`: -1 or 1, the arcades to the left and right of who looks along x.
void addShell(GlbBuilder& glb, float side) {
  const auto along = [side](float share) { return kLength * (0.5f - share) * side; };
  for (const int storey : {0, 1}) {
    addSheet(glb, storey == 0 ? lowerWall : upperWall,
             [=](vec2 at) {
               const float wave = 0.03f * std::sin(40 * at.x) * std::sin(9 * at.y);
               return vec3(along(at.x), kStorey * (static_cast<float>(storey) + at.y), side * (0.8f * kWidth + wave));
             },
             70, 20, {16, 3});
  }
  for (const auto& [look, height, down] :
       {std::tuple{ceiling, kStorey, true}, {ceiling, kStorey + 0.3f, false}, {roof, 2 * kStorey, true}}) {
    addSheet(glb, look,
             [=, height = height, down = down](vec2 at) {
               return vec3(along(down ? at.x : 1 - at.x), height, side * (kAisle + at.y * 0.35f * kWidth));
             },
             100, 12, {16, 2});
  }
  addSheet(glb, cornice,
           [=](vec2 at) {
             return vec3(along(at.x), 2 * kStorey + 1.2f * at.y, side * kAisle + 0.1f * std::sin(300 * at.x) * at.y);
           },
           300, 10, {20, 1});
}

void addArcade(GlbBuilder& glb, float side, int storey) {
  constexpr float kShaft = 3.8f; // metres to where arches begin
  const float z = side * kAisle, y = 6.3f * static_cast<float>(storey);
  for (int i = 0; i < kColumns; ++i) {
    const float x = kBay * (static_cast<float>(i) + 0.5f) - kLength / 2;
    const auto column = turned({x, y, z}, kShaft, [](vec2 at) {
      const float foot = at.y / 0.06f, head = (1 - at.y) / 0.07f;
      return 0.33f + 0.12f * std::exp(-foot * foot) + 0.14f * std::exp(-head * head) +
             0.012f * std::cos(24 * glm::pi<float>() * at.x);
    });
    addSheet(glb, i % 2 == 0 ? darkColumns : lightColumns, column, 28, 18, {3, 4});
    if (i + 1 == kColumns) continue;
    const auto arch = [=](float share, float aside) {
      const float angle = glm::pi<float>() * share;
      return vec3(x + kBay / 2 - (kBay / 2 - 0.2f) * std::cos(angle), y + kShaft + 1.4f * std::sin(angle), z + aside);
    };
    addSheet(glb, arches, [=](vec2 at) { return arch(at.x, 0.5f * (at.y - 0.5f)); }, 40, 8, {4, 1});
    for (const float face : {-1.0f, 1.0f}) {
      addSheet(glb, face > 0 ? lowerWall : arches,
               [=](vec2 at) {
                 const vec3 low = arch(face > 0 ? at.x : 1 - at.x, 0.25f * face);
                 return vec3(low.x, glm::mix(low.y, y + kStorey, at.y), low.z);
               },
               40, 8, {4, 1});
    }
  }
}

void addCurtains(GlbBuilder& glb, float side) {
  for (int i = 0; i + 1 < kColumns; ++i) {
    const float x = kBay * static_cast<float>(i + 1) - kLength / 2;
    addSheet(glb, firstCurtain + (side > 0 ? i : i + 1),
             [=](vec2 at) {
               const float fold = 0.18f * std::sin(26 * at.x + static_cast<float>(i)) * (1.1f - 0.6f * at.y);
               return vec3(x + 2.4f * (at.x - 0.5f), 1.2f + 3.6f * at.y, 0.98f * side * kAisle + fold);
             },
             54, 22, {2, 3});
  }
}

void addPlants(GlbBuilder& glb, float side, std::mt19937& random) {
  std::uniform_real_distribution<float> any(0, 1);
  for (int i = 0; i < 5; ++i) {
    const vec3 foot(kLength * static_cast<float>(i + 1) / 6 - kLength / 2, 0, side * 0.25f * kWidth);
    addSheet(glb, vases,
             turned(foot, 0.9f,
                    [](vec2 at) {
                      return 0.25f + 0.3f * std::sin(0.8f * glm::pi<float>() * at.y) + 0.05f * std::cos(20 * at.y);
                    }),
             40, 30, {3, 1});
    Sheets plant;
    for (int leaf = 0; leaf < 60; ++leaf) {
      const float angle = any(random) * glm::two_pi<float>(), rise = 0.2f + 1.1f * any(random);
      const vec3 from = foot + vec3(0.2f * std::cos(angle), 0.9f + 0.6f * any(random), 0.2f * std::sin(angle));
      const vec3 way(std::cos(angle) * std::cos(rise), std::sin(rise), std::sin(angle) * std::cos(rise));
      const vec3 aside = glm::normalize(glm::cross(way, vec3(0, 1, 0)));
      plant.add(
          [=](vec2 at) {
            return from + 0.7f * at.y * way + 0.6f * (at.x - 0.5f) * aside - vec3(0, 0.3f * at.y * at.y, 0);
          },
          3, 6, {1, 1});
    }
    plant.addTo(glb, kOpaque + i % kPlants);
  }
}

GlbBuilder hall() {
  GlbBuilder glb;
  addMaterials(glb);
  addSheet(glb, floorStone, [](vec2 at) { return vec3(kLength * (at.y - 0.5f), 0, 1.6f * kWidth * (at.x - 0.5f)); }, 60,
           100, {10, 16});
  for (const float end : {-1.0f, 1.0f}) {
    addSheet(glb, arches,
             [=](vec2 at) { return vec3(end * kLength / 2, 2 * kStorey * at.y, end * 1.6f * kWidth * (at.x - 0.5f)); },
             60, 60, {6, 6});
    addSheet(glb, relief,
             [=](vec2 at) {
               const float angle = glm::two_pi<float>() * at.x, r = 1.3f * std::sqrt(glm::clamp(at.y, 1e-4f, 1.0f));
               const float out = 0.8f * std::sqrt(glm::clamp(1 - at.y, 1e-4f, 1.0f)) +
                                 0.08f * std::sin(9 * angle) * std::sin(12 * at.y);
               return vec3(end * (kLength / 2 - 0.02f - out), 3.2f + r * std::sin(angle), -end * r * std::cos(angle));
             },
             100, 60, {2, 2});
  }
  std::mt19937 random(3);
  for (const float side : {-1.0f, 1.0f}) {
    addShell(glb, side);
    for (const int storey : {0, 1}) addArcade(glb, side, storey);
    addCurtains(glb, side);
    addPlants(glb, side, random);
  }
  return glb;
}

} // namespace

BenchScene hallScene(const std::filesystem::path& folder) {
  BenchScene scene{"hall", folder / "hall.glb", {}};
  testing::writeFile(scene.file, hall().glb());
  for (int frame = 0; frame < 20; ++frame) {
    const double x = -11 + 0.2 * frame;
    scene.path.push_back({{"camera",
                           {{"eye", {x, 4.5, 0.8}},
                            {"target", {x + 13, 3.6 + 0.02 * frame, 0}},
                            {"perspective", {{"fovYDegrees", 60}, {"near", 0.1}, {"far", 100}}}}},
                          {"lights", {{{"type", "directional"}, {"direction", {-0.25, -0.9, -0.3}}}}}});
  }
  return scene;
}

} // namespace gnomon::bench
