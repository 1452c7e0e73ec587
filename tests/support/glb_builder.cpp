#include "tests/support/glb_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>

namespace gnomon::testing {

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

void append32(Bytes& bytes, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift & 0xFF));
}

template <class Content>
void appendChunk(Bytes& bytes, std::uint32_t type, const Content& content, std::uint8_t padding) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  append32(bytes, padded);
  append32(bytes, type);
  bytes.insert(bytes.end(), content.begin(), content.end());
  bytes.insert(bytes.end(), padded - content.size(), padding);
}

/// Unless a number is not finite.
void addBounds(const std::vector<Point>& points, nlohmann::json& accessor) {
  Point least{HUGE_VALF, HUGE_VALF, HUGE_VALF};
  Point most{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
  for (const Point& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(point[axis])) return;
      least[axis] = std::min(least[axis], point[axis]);
      most[axis] = std::max(most[axis], point[axis]);
    }
  }
  if (points.empty()) return;
  accessor["min"] = least;
  accessor["max"] = most;
}

/// The names of all extensions in it.
void findExtensions(const nlohmann::json& value, std::set<std::string>& names) {
  for (const auto& [key, member] : value.items()) {
    if (key == "extras" || !member.is_structured()) continue;
    if (key == "extensions" && member.is_object()) {
      for (const auto& [name, extension] : member.items()) names.insert(name);
    }
    findExtensions(member, names);
  }
}

/// `extensionsUsed`, where the document does not have it and needs it.
void listExtensions(nlohmann::json& document) {
  if (document.contains("extensionsUsed")) return;
  std::set<std::string> names;
  findExtensions(document, names);
  if (!names.empty()) document["extensionsUsed"] = names;
}

/// The whole number of a member; `none` where there is no such number.
std::size_t numberAt(const nlohmann::json& object, const char* key, std::size_t none) {
  const auto member = object.find(key);
  if (member == object.end() || !member->is_number_integer() || *member < 0) return none;
  return member->get<std::size_t>();
}

/// The element of an array of the root; nullptr where there is none.
nlohmann::json* elementOf(nlohmann::json& document, const char* key, std::size_t index) {
  const auto array = document.find(key);
  if (array == document.end() || !array->is_array() || index >= array->size()) return nullptr;
  return &(*array)[index];
}

/// The min and max of positions that have neither and are packed floats.
void boundPositions(nlohmann::json& document, const Bytes& binary) {
  for (std::size_t m = 0; const nlohmann::json* mesh = elementOf(document, "meshes", m); ++m) {
    if (!mesh->contains("primitives") || !(*mesh)["primitives"].is_array()) continue;
    for (const nlohmann::json& primitive : (*mesh)["primitives"]) {
      if (!primitive.contains("attributes")) continue;
      nlohmann::json* accessor =
          elementOf(document, "accessors", numberAt(primitive["attributes"], "POSITION", SIZE_MAX));
      if (!accessor || accessor->contains("min") || accessor->contains("max")) continue;
      if (numberAt(*accessor, "componentType", 0) != 5126 || accessor->contains("sparse")) continue;
      const nlohmann::json* view = elementOf(document, "bufferViews", numberAt(*accessor, "bufferView", SIZE_MAX));
      if (!view || view->contains("byteStride")) continue;
      const std::size_t offset = numberAt(*view, "byteOffset", 0) + numberAt(*accessor, "byteOffset", 0);
      const std::size_t count = numberAt(*accessor, "count", 0);
      if (offset > binary.size() || count > (binary.size() - offset) / sizeof(Point)) continue;
      std::vector<Point> points(count);
      std::memcpy(points.data(), binary.data() + offset, count * sizeof(Point));
      addBounds(points, *accessor);
    }
  }
}

} // namespace

Bytes makeGlb(std::string_view json, const Bytes& binary) {
  Bytes chunks;
  appendChunk(chunks, kJsonChunk, json, ' ');
  if (!binary.empty()) appendChunk(chunks, kBinaryChunk, binary, 0);
  Bytes bytes;
  append32(bytes, kMagic);
  append32(bytes, 2);
  append32(bytes, 12 + chunks.size());
  bytes.insert(bytes.end(), chunks.begin(), chunks.end());
  return bytes;
}

int GlbBuilder::add(const char* array, nlohmann::json element) {
  json[array].push_back(std::move(element));
  return static_cast<int>(json[array].size()) - 1;
}

int GlbBuilder::addView(const void* data, std::size_t bytes, int stride) {
  binary.resize((binary.size() + 3) / 4 * 4);
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes}};
  if (stride != 0) view["byteStride"] = stride;
  const auto* first = static_cast<const std::uint8_t*>(data);
  binary.insert(binary.end(), first, first + bytes);
  return add("bufferViews", std::move(view));
}

int GlbBuilder::addPoints(const std::vector<Point>& points) {
  const int accessor = addAccessor(points, "VEC3", 5126, points.size());
  addBounds(points, json["accessors"].back());
  return accessor;
}

int GlbBuilder::addIndices(const std::vector<std::uint32_t>& indices) {
  return addAccessor(indices, "SCALAR", 5125, indices.size());
}

int GlbBuilder::addShortIndices(const std::vector<std::uint16_t>& indices) {
  return addAccessor(indices, "SCALAR", 5123, indices.size());
}

int GlbBuilder::addMesh(nlohmann::json primitive) {
  return add("meshes", {{"primitives", nlohmann::json::array({std::move(primitive)})}});
}

int GlbBuilder::addMeshNode(int mesh) {
  return addRoot({{"mesh", mesh}});
}

int GlbBuilder::addRoot(nlohmann::json node) {
  const int index = add("nodes", std::move(node));
  json["scenes"][0]["nodes"].push_back(index);
  return index;
}

Bytes GlbBuilder::glb() const {
  nlohmann::json document = json;
  listExtensions(document);
  boundPositions(document, binary);
  if (!binary.empty() && !document.contains("buffers")) {
    document["buffers"] = nlohmann::json::array({{{"byteLength", binary.size()}}});
  }
  return makeGlb(document.dump(), binary);
}

SceneBundle GlbBuilder::bundle() const {
  return {glb(), {}};
}

GlbBuilder cube() {
  std::vector<Point> positions;
  std::vector<Point> normals;
  std::vector<std::uint16_t> indices;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const auto first = static_cast<std::uint16_t>(positions.size());
      for (int corner = 0; corner < 4; ++corner) {
        Point position{};
        Point normal{};
        position[axis] = side;
        normal[axis] = side;
        position[(axis + 1) % 3] = corner == 0 || corner == 3 ? -1.0f : 1.0f;
        position[(axis + 2) % 3] = (corner < 2 ? -1.0f : 1.0f) * side; // counter-clockwise from outside
        positions.push_back(position);
        normals.push_back(normal);
      }
      for (const int corner : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(first + corner));
    }
  }
  GlbBuilder builder;
  const int position = builder.addPoints(positions);
  const int normal = builder.addPoints(normals);
  builder.addMeshNode(builder.addMesh(
      {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", builder.addShortIndices(indices)}}));
  return builder;
}

GlbBuilder plane() {
  GlbBuilder builder;
  const int position = builder.addPoints({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}});
  const int normal = builder.addPoints({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
  const int texCoord = builder.addAccessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 5126, 4);
  builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", texCoord}}},
                       {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}}));
  return builder;
}

GlbBuilder triangle() {
  GlbBuilder builder;
  const int position = builder.addPoints({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", position}}}}));
  return builder;
}

} // namespace gnomon::testing
