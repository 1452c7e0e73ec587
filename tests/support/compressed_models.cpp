#include "tests/support/compressed_models.h"

#include <algorithm>
#include <cmath>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>
#include <numbers>

namespace gnomon::testing {

namespace {

using nlohmann::json;

constexpr float kExtent = 3.0f; ///< half the width of a cube around the shapes, for quantization

std::int16_t snorm16(float value) {
  return static_cast<std::int16_t>(std::lround(value / kExtent * 32767.0f));
}

std::vector<std::int16_t> quantizedPositions(const Shape& shape) {
  std::vector<std::int16_t> quantized; // four a vertex: elements start at multiples of 4 bytes
  for (const glm::vec3& p : shape.positions)
    quantized.insert(quantized.end(), {snorm16(p.x), snorm16(p.y), snorm16(p.z), 0});
  return quantized;
}

std::vector<std::int8_t> quantizedNormals(const Shape& shape) {
  std::vector<std::int8_t> quantized;
  for (const glm::vec3& n : shape.normals) {
    for (int i = 0; i < 3; ++i) quantized.push_back(static_cast<std::int8_t>(std::lround(n[i] * 127.0f)));
    quantized.push_back(0);
  }
  return quantized;
}

json accessor(std::size_t count, const char* type, int componentType) {
  return {{"count", count}, {"type", type}, {"componentType", componentType}};
}

template <class T>
std::uint32_t addDraco(draco::Mesh& mesh, draco::GeometryAttribute::Type type, std::int8_t components,
                       const std::vector<T>& values) {
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<std::uint8_t>(components), draco::DT_FLOAT32, false, sizeof(T), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
  }
  return mesh.attribute(id)->unique_id();
}

/// Appends a compressed view; returns its index. The fallback buffer is buffer 1.
int addMeshopt(GlbBuilder& builder, const std::string& name, const std::vector<std::uint8_t>& compressed,
               json extension, std::size_t& decoded) {
  builder.binary.resize((builder.binary.size() + 3) / 4 * 4);
  const std::size_t length = extension["count"].get<std::size_t>() * extension["byteStride"].get<std::size_t>();
  extension["buffer"] = 0;
  extension["byteOffset"] = builder.binary.size();
  extension["byteLength"] = compressed.size();
  builder.binary.insert(builder.binary.end(), compressed.begin(), compressed.end());
  json view = {{"buffer", 1}, {"byteOffset", decoded}, {"byteLength", length}};
  if (extension["mode"] == "ATTRIBUTES") view["byteStride"] = extension["byteStride"];
  view["extensions"][name] = std::move(extension);
  decoded += (length + 3) / 4 * 4;
  return builder.add("bufferViews", std::move(view));
}

template <class T>
std::vector<std::uint8_t> encodedVertices(const std::vector<T>& vertices, std::size_t count) {
  const std::size_t size = vertices.size() * sizeof(T) / count;
  std::vector<std::uint8_t> bytes(meshopt_encodeVertexBufferBound(count, size));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices.data(), count, size));
  return bytes;
}

} // namespace

Shape torus(int segments) {
  Shape shape;
  const auto side = static_cast<std::uint32_t>(segments) + 1;
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const glm::vec2 uv = glm::vec2(i, j) / static_cast<float>(segments);
      const glm::vec2 angle = uv * 2.0f * std::numbers::pi_v<float>;
      const glm::vec3 outwards(std::cos(angle.x), 0, std::sin(angle.x));
      const glm::vec3 normal = outwards * std::cos(angle.y) + glm::vec3(0, std::sin(angle.y), 0);
      shape.positions.push_back(outwards * 2.0f + normal * 0.75f);
      shape.normals.push_back(normal);
      shape.texCoords.push_back(uv);
    }
  }
  for (std::uint32_t i = 0; i + 1 < side; ++i) {
    for (std::uint32_t j = 0; j + 1 < side; ++j) {
      const std::uint32_t a = i * side + j;
      shape.indices.insert(shape.indices.end(), {a, a + 1, a + side, a + 1, a + side + 1, a + side});
    }
  }
  return shape;
}

GlbBuilder plainModel(const Shape& shape) {
  GlbBuilder builder;
  const std::size_t count = shape.positions.size();
  const int positions = builder.addAccessor(shape.positions, "VEC3", 5126, count);
  const int normals = builder.addAccessor(shape.normals, "VEC3", 5126, count);
  const int texCoords = builder.addAccessor(shape.texCoords, "VEC2", 5126, count);
  builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texCoords}}},
                       {"indices", builder.addIndices(shape.indices)}}));
  return builder;
}

GlbBuilder quantizedModel(const Shape& shape) {
  GlbBuilder builder;
  const std::size_t count = shape.positions.size();
  json positions = accessor(count, "VEC3", 5122);
  positions["normalized"] = true;
  positions["bufferView"] = builder.addView(quantizedPositions(shape), 8);
  json normals = accessor(count, "VEC3", 5120);
  normals["normalized"] = true;
  normals["bufferView"] = builder.addView(quantizedNormals(shape), 4);
  const int position = builder.add("accessors", positions);
  const int normal = builder.add("accessors", normals);
  const int mesh = builder.addMesh(
      {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", builder.addIndices(shape.indices)}});
  builder.addRoot({{"mesh", mesh}, {"scale", {kExtent, kExtent, kExtent}}});
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  return builder;
}

GlbBuilder dracoModel(const Shape& shape, bool edgebreaker) {
  draco::Mesh mesh;
  mesh.SetNumFaces(shape.indices.size() / 3);
  mesh.set_num_points(static_cast<std::uint32_t>(shape.positions.size()));
  for (std::uint32_t face = 0; face < mesh.num_faces(); ++face) {
    const std::uint32_t* corners = &shape.indices[std::size_t{3} * face];
    mesh.SetFace(draco::FaceIndex(face),
                 {draco::PointIndex(corners[0]), draco::PointIndex(corners[1]), draco::PointIndex(corners[2])});
  }
  const std::uint32_t position = addDraco(mesh, draco::GeometryAttribute::POSITION, 3, shape.positions);
  const std::uint32_t normal = addDraco(mesh, draco::GeometryAttribute::NORMAL, 3, shape.normals);
  const std::uint32_t texCoord = addDraco(mesh, draco::GeometryAttribute::TEX_COORD, 2, shape.texCoords);
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING : draco::MESH_SEQUENTIAL_ENCODING);
  encoder.SetAttributeQuantization(0, 14);
  encoder.SetAttributeQuantization(1, 10);
  encoder.SetAttributeQuantization(2, 12);
  encoder.SetSpeedOptions(0, 0); // the smallest stream: by all the predictions that there are
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer encoded;
  if (!encoder.EncodeToBuffer(&encoded).ok()) return {};

  GlbBuilder builder;
  const int view = builder.addView(encoded.data(), encoded.size());
  const std::size_t points = encoder.num_encoded_points();
  const int positions = builder.add("accessors", accessor(points, "VEC3", 5126));
  const int normals = builder.add("accessors", accessor(points, "VEC3", 5126));
  const int texCoords = builder.add("accessors", accessor(points, "VEC2", 5126));
  const int indices = builder.add("accessors", accessor(shape.indices.size(), "SCALAR", 5125));
  json primitive = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texCoords}}},
                    {"indices", indices}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", texCoord}}}};
  builder.addMeshNode(builder.addMesh(std::move(primitive)));
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return builder;
}

GlbBuilder meshoptModel(const Shape& shape, const std::string& name) {
  const std::size_t count = shape.positions.size();
  std::vector<glm::vec4> directions;
  for (const glm::vec3& n : shape.normals) directions.emplace_back(n, 0);
  std::vector<std::int8_t> octahedral(4 * count);
  meshopt_encodeFilterOct(octahedral.data(), count, 4, 8, &directions.front().x);
  std::vector<std::uint32_t> exponential(3 * count);
  meshopt_encodeFilterExp(exponential.data(), count, 12, 20, &shape.positions.front().x);
  std::vector<std::uint8_t> triangles(meshopt_encodeIndexBufferBound(shape.indices.size(), count));
  triangles.resize(
      meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), shape.indices.data(), shape.indices.size()));

  GlbBuilder builder;
  std::size_t decoded = 0;
  const auto add = [&](json element, int view) {
    element["bufferView"] = view;
    return builder.add("accessors", std::move(element));
  };
  const int positions = add(
      accessor(count, "VEC3", 5126),
      addMeshopt(builder, name, encodedVertices(exponential, count),
                 {{"byteStride", 12}, {"count", count}, {"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}}, decoded));
  json normal = accessor(count, "VEC3", 5120);
  normal["normalized"] = true;
  const int normals =
      add(normal,
          addMeshopt(builder, name, encodedVertices(octahedral, count),
                     {{"byteStride", 4}, {"count", count}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}}, decoded));
  const int texCoords = add(accessor(count, "VEC2", 5126),
                            addMeshopt(builder, name, encodedVertices(shape.texCoords, count),
                                       {{"byteStride", 8}, {"count", count}, {"mode", "ATTRIBUTES"}}, decoded));
  const int indices =
      add(accessor(shape.indices.size(), "SCALAR", 5125),
          addMeshopt(builder, name, triangles,
                     {{"byteStride", 4}, {"count", shape.indices.size()}, {"mode", "TRIANGLES"}}, decoded));
  builder.addMeshNode(
      builder.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texCoords}}},
                       {"indices", indices}}));
  json fallback = {{"byteLength", decoded}};
  fallback["extensions"][name]["fallback"] = true;
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}}, fallback};
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {name};
  return builder;
}

} // namespace gnomon::testing
