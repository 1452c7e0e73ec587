#include "renderer/scene/decode/draco_primitives.h"

#include <set>

#include "renderer/scene/decode/draco_stream.h"

namespace gnomon {

namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

const char* typeName(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
      return "BYTE";
    case ComponentType::uint8:
      return "UNSIGNED_BYTE";
    case ComponentType::int16:
      return "SHORT";
    case ComponentType::uint16:
      return "UNSIGNED_SHORT";
    case ComponentType::uint32:
      return "UNSIGNED_INT";
    case ComponentType::float32:
      break;
  }
  return "FLOAT";
}

std::string shapeText(ComponentType type, int components) {
  return std::to_string(components) + " x " + typeName(type);
}

class PrimitiveDecoding {
 public:
  PrimitiveDecoding(const LoadContext& load, const gltf::Primitive& primitive, std::string pointer)
      : document_(load.document),
        limits_(load.limits),
        findings_(load.findings),
        primitive_(primitive),
        pointer_(std::move(pointer)) {}

  std::optional<DracoPrimitive> decode(DecodeBudget& budget) {
    const std::string at = pointer_ + "/extensions/" + kExtension;
    if (primitive_.mode != PrimitiveMode::triangles) {
      findings_.unsupported(pointer_ + "/mode", "Draco data is only supported for triangle lists.");
      return std::nullopt;
    }
    const auto ids = idsOf(at + "/attributes");
    if (!ids) return std::nullopt;
    DracoClaims claims{accessorOf("POSITION").count, std::nullopt};
    if (primitive_.indices >= 0) {
      claims.triangles = document_.model.accessors[static_cast<std::size_t>(primitive_.indices)].count / 3;
    }
    std::set<std::uint32_t> wanted;
    for (const auto& [name, id] : *ids) wanted.insert(id);
    const auto mesh = decodeDraco(document_.bufferViews[primitive_.draco->bufferView], claims, wanted, limits_, budget,
                                  at, findings_);
    if (!mesh) return std::nullopt;
    return viewed(*mesh, *ids, at + "/attributes");
  }

 private:
  const gltf::Accessor& accessorOf(const std::string& name) const {
    return document_.model.accessors[static_cast<std::size_t>(primitive_.attributes.at(name))];
  }

  /// The ids of the attributes by name; the primitive has each of them, and POSITION is among them.
  std::optional<std::map<std::string, std::uint32_t>> idsOf(const std::string& pointer) const {
    const std::map<std::string, std::uint32_t>& ids = primitive_.draco->attributes;
    for (const auto& [name, id] : ids) {
      if (!primitive_.attributes.contains(name)) {
        findings_.invalid(pointerTo(pointer, name), "The primitive has no such attribute.");
        return std::nullopt;
      }
    }
    if (!ids.contains("POSITION")) {
      findings_.invalid(pointer, "The Draco data has no positions.");
      return std::nullopt;
    }
    return ids;
  }

  std::optional<DracoPrimitive> viewed(const DracoMesh& mesh, const std::map<std::string, std::uint32_t>& ids,
                                       const std::string& pointer) {
    DracoPrimitive decoded;
    for (const auto& [name, id] : ids) {
      const DracoAttribute& attribute = mesh.attributes.at(id);
      const gltf::Accessor& accessor = accessorOf(name);
      const int components = componentsOf(accessor.type);
      const ComponentType type = accessor.componentType;
      if (attribute.components != components || attribute.type != type) {
        findings_.invalid(pointerTo(pointer, name), "The type of the Draco data differs from that of the accessor.",
                          shapeText(type, components), shapeText(attribute.type, attribute.components));
        return std::nullopt;
      }
      if (accessor.count != accessorOf("POSITION").count) continue; // told where the accessors are gathered
      AccessorView view;
      view.count = mesh.points;
      view.components = components;
      view.componentType = type;
      view.normalized = accessor.normalized && type != ComponentType::float32;
      view.stride = bytesOf(type) * static_cast<std::size_t>(components);
      decoded.storage.push_back(attribute.bytes);
      view.data = decoded.storage.back().data();
      decoded.attributes[name] = view;
    }
    const auto* corners = reinterpret_cast<const std::uint8_t*>(mesh.corners.data());
    decoded.storage.emplace_back(corners, corners + mesh.corners.size() * sizeof(std::uint32_t));
    decoded.indices.componentType = ComponentType::uint32;
    decoded.indices.count = mesh.corners.size();
    decoded.indices.stride = sizeof(std::uint32_t);
    decoded.indices.data = decoded.storage.back().data();
    return decoded;
  }

  const GltfDocument& document_;
  const Limits& limits_;
  Findings& findings_;
  const gltf::Primitive& primitive_; ///< with `draco`
  std::string pointer_;
};

} // namespace

DracoPrimitives decodeDracoPrimitives(const LoadContext& load) {
  const gltf::Model& model = load.document.model;
  DracoPrimitives decoded;
  DecodeBudget budget(load.limits.maxDecodedBytes, load.document.decodedBytes);
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    const gltf::Mesh& mesh = model.meshes[m];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      if (!mesh.primitives[p].draco) continue;
      const std::string pointer = pointerTo(pointerTo("/meshes", m) + "/primitives", p);
      auto primitive = PrimitiveDecoding(load, mesh.primitives[p], pointer).decode(budget);
      if (!primitive) return {};
      decoded.emplace(std::pair(m, p), *std::move(primitive));
    }
  }
  return decoded;
}

} // namespace gnomon
