#include "renderer/export/baked_glb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "renderer/bake/mapped_mesh.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/core/srgb.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {
namespace {

using nlohmann::json;

template <class T>
std::span<const std::uint8_t> bytesOfAll(const std::vector<T>& values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

std::uint8_t encodedSrgb(float linear) {
  const float value = std::clamp(linear, 0.0f, 1.0f);
  return static_cast<std::uint8_t>(std::lround(srgbOf(value) * 255));
}

float highestOf(const IrradianceMap& map) {
  float highest = 0;
  for (const glm::vec3& texel : map.texels) highest = std::max({highest, texel.r, texel.g, texel.b});
  return highest > 0 ? highest : 1;
}

Image pictureOf(const IrradianceMap& map, float highest) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(map.texels.size() * 3);
  for (const glm::vec3& texel : map.texels) {
    for (int channel = 0; channel < 3; ++channel) pixels.push_back(encodedSrgb(texel[channel] / highest));
  }
  return {map.width, map.height, {"R", "G", "B"}, std::move(pixels)};
}

/// A node's matrix must be a turn and a scale: another one moves the vertices themselves.
bool isTurnAndScale(const glm::dmat4& matrix) {
  const glm::dmat3 axes(matrix);
  constexpr double kSlack = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &a = axes[i], &b = axes[(i + 1) % 3];
    if (std::abs(glm::dot(a, b)) > kSlack * glm::length(a) * glm::length(b)) return false;
  }
  return true;
}

class GlbWriter {
 public:
  GlbWriter(const Scene& scene, const LightMapLayout& layout) : scene_(scene), layout_(layout) {
    draft.json = {{"asset", {{"version", "2.0"}, {"generator", "Gnomon"}}}, {"scene", 0}};
    draft.json["scenes"].push_back({{"nodes", json::array()}});
  }

  void addInstance(const Instance& instance, std::size_t index, int material) {
    const Primitive& primitive = scene_.primitives[static_cast<std::size_t>(instance.primitive)];
    const Material& look = scene_.materials[static_cast<std::size_t>(materialOf(scene_, instance))];
    const MappedMesh mesh = mappedMesh(scene_, primitive, layout_, layout_.firstCorner[index]);
    if (mesh.indices.empty()) return;
    const bool placed = isTurnAndScale(instance.worldFromLocal);
    json attributes = attributesOf(mesh, look, placed ? glm::dmat4(1) : instance.worldFromLocal, primitive.hasTangents);
    const json part = {{"attributes", std::move(attributes)},
                       {"indices", addAccessor(mesh.indices, 5125, "SCALAR")},
                       {"material", material}};
    json node = {{"mesh", draft.json.contains("meshes") ? draft.json["meshes"].size() : 0}};
    draft.json["meshes"].push_back({{"primitives", {part}}});
    if (placed) node["matrix"] = columnsOf(instance.worldFromLocal);
    addNode(std::move(node), instance.node);
  }

  void addCamera(const SceneCamera& camera) {
    json lens;
    if (camera.perspective) {
      const Perspective& perspective = *camera.perspective;
      lens = {{"type", "perspective"},
              {"perspective",
               {{"yfov", glm::radians(perspective.fovYDegrees)}, {"znear", perspective.near.value_or(0.1)}}}};
      if (perspective.far) lens["perspective"]["zfar"] = *perspective.far;
    } else {
      return;
    }
    const glm::dvec3 right = glm::cross(camera.forward, camera.up);
    glm::dmat4 matrix(glm::dvec4(right, 0), glm::dvec4(camera.up, 0), glm::dvec4(-camera.forward, 0),
                      glm::dvec4(camera.eye, 1));
    json node = {{"camera", draft.json.contains("cameras") ? draft.json["cameras"].size() : 0},
                 {"matrix", columnsOf(matrix)}};
    draft.json["cameras"].push_back(std::move(lens));
    addNode(std::move(node), camera.node);
  }

  Bytes file() {
    draft.binary.resize((draft.binary.size() + 3) / 4 * 4);
    draft.json["buffers"].push_back({{"byteLength", draft.binary.size()}});
    std::string text = draft.json.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    Bytes glb;
    const auto number = [&glb](std::size_t value) {
      for (int i = 0; i < 4; ++i) glb.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    };
    constexpr std::size_t kGltf = 0x46546C67, kJson = 0x4E4F534A, kBin = 0x004E4942;
    for (const std::size_t value : {kGltf, std::size_t{2}, 28 + text.size() + draft.binary.size()}) number(value);
    for (const std::size_t value : {text.size(), kJson}) number(value);
    glb.insert(glb.end(), text.begin(), text.end());
    for (const std::size_t value : {draft.binary.size(), kBin}) number(value);
    glb.insert(glb.end(), draft.binary.begin(), draft.binary.end());
    return glb;
  }

  GlbDraft draft;

 private:
  static json columnsOf(const glm::dmat4& matrix) {
    json columns = json::array();
    for (int i = 0; i < 16; ++i) columns.push_back(matrix[i / 4][i % 4]);
    return columns;
  }

  void addNode(json node, int original) {
    const std::string& name = scene_.nodes[static_cast<std::size_t>(original)].name;
    if (!name.empty()) node["name"] = name;
    draft.json["scenes"][0]["nodes"].push_back(draft.json.contains("nodes") ? draft.json["nodes"].size() : 0);
    draft.json["nodes"].push_back(std::move(node));
  }

  template <class T>
  std::size_t addAccessor(const std::vector<T>& values, int componentType, const char* type) {
    draft.json["accessors"].push_back({{"bufferView", draft.addView(bytesOfAll(values))},
                                       {"componentType", componentType},
                                       {"count", values.size()},
                                       {"type", type}});
    return draft.json["accessors"].size() - 1;
  }

  json attributesOf(const MappedMesh& mesh, const Material& look, const glm::dmat4& moved, bool tangents) {
    constexpr int kFloat = 5126, kUnsignedShort = 5123;
    const glm::dmat3 turned = normalMatrix(glm::dmat3(moved));
    const glm::vec2 texels(layout_.width, layout_.height);
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangent;
    std::vector<glm::vec2> uv0, uv1, map;
    std::vector<glm::u16vec4> colors;
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (const MappedVertex& each : mesh.vertices) {
      const VertexAttributes& vertex = scene_.attributes[each.vertex];
      const glm::vec3 position(moved * glm::dvec4(glm::dvec3(scene_.positions[each.vertex]), 1));
      low = glm::min(low, position);
      high = glm::max(high, position);
      positions.push_back(position);
      normals.emplace_back(unitOr(turned * glm::dvec3(vertex.normal), {0, 1, 0}));
      tangent.emplace_back(unitOr(glm::dmat3(moved) * glm::dvec3(vertex.tangent), {1, 0, 0}), vertex.tangent.w);
      uv0.push_back(vertex.uv0);
      uv1.push_back(vertex.uv1);
      map.push_back(each.corner / texels);
      colors.push_back(vertex.color);
    }
    json attributes = {{"POSITION", addAccessor(positions, kFloat, "VEC3")},
                       {"NORMAL", addAccessor(normals, kFloat, "VEC3")},
                       {"TEXCOORD_0", addAccessor(uv0, kFloat, "VEC2")},
                       {"TEXCOORD_1", addAccessor(map, kFloat, "VEC2")}};
    json& bounds = draft.json["accessors"][attributes["POSITION"].get<std::size_t>()];
    bounds["min"] = {low.x, low.y, low.z};
    bounds["max"] = {high.x, high.y, high.z};
    if (tangents && look.normal) attributes["TANGENT"] = addAccessor(tangent, kFloat, "VEC4");
    if (readsUv(look, 1)) attributes["TEXCOORD_2"] = addAccessor(uv1, kFloat, "VEC2");
    if (look.hasVertexColors) {
      attributes["COLOR_0"] = addAccessor(colors, kUnsignedShort, "VEC4");
      draft.json["accessors"].back()["normalized"] = true;
    }
    return attributes;
  }

  const Scene& scene_;
  const LightMapLayout& layout_;
};

Problem tooLarge(std::size_t most) {
  return {ProblemCode::tooLarge, "", "The scene with its light map is too large for a GLB.",
          std::to_string(most) + " bytes"};
}

} // namespace

Result<Bytes> bakedGlb(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes,
                       const LightMapLayout& layout, const IrradianceMap& map, std::size_t mostBytes) {
  constexpr int kPngLevel = 2;
  const auto isVisible = [&](const Instance& instance) { return switchesOf(nodes, instance.node).visible; };
  GlbWriter writer(scene, layout);
  const float highest = highestOf(map);
  const auto picture = encodePng(pictureOf(map, highest), kPngLevel);
  if (!picture) return picture.problems();
  json& document = writer.draft.json;
  document["samplers"].push_back({{"wrapS", 33071}, {"wrapT", 33071}, {"magFilter", 9729}, {"minFilter", 9729}});
  document["textures"].push_back({{"source", writer.draft.addPng(*picture)}, {"sampler", 0}});
  std::vector<std::uint8_t> used(scene.materials.size(), 0);
  for (const Instance& instance : view.instances) {
    if (isVisible(instance)) used[static_cast<std::size_t>(materialOf(scene, instance))] = 1;
  }
  const auto materials = addMaterials(scene, used, 0, highest, writer.draft);
  if (!materials) return materials.problems();
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const Instance& instance = view.instances[i];
    if (!isVisible(instance)) continue;
    writer.addInstance(instance, i, (*materials)[static_cast<std::size_t>(materialOf(scene, instance))]);
    if (writer.draft.binary.size() > mostBytes) return tooLarge(mostBytes);
  }
  for (const SceneCamera& camera : view.cameras) writer.addCamera(camera);
  Bytes file = writer.file();
  if (file.size() > mostBytes) return tooLarge(mostBytes);
  return file;
}

} // namespace gnomon
