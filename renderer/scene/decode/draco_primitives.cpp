#include "renderer/scene/decode/draco_primitives.h"

#include <set>

#include "renderer/scene/decode/draco_stream.h"
#include "renderer/scene/gltf_json.h"

namespace gnomon {

namespace {

using nlohmann::json;

constexpr const char* kExtension = "KHR_draco_mesh_compression";

const char* nameOf(ComponentType type) {
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
  return std::to_string(components) + " x " + nameOf(type);
}

class PrimitiveDecoding {
 public:
  /// `source`: the primitive as the file has it, with its indices.
  PrimitiveDecoding(const GltfDocument& document, const tinygltf::Primitive& primitive, const json& source,
                    std::string pointer, Findings& findings)
      : document_(document),
        primitive_(primitive),
        source_(source),
        extension_(source["extensions"][kExtension]),
        pointer_(std::move(pointer)),
        findings_(findings) {}

  std::optional<DracoPrimitive> decode(const Limits& limits, DecodeBudget& budget) {
    const std::string at = pointer_ + "/extensions/" + kExtension;
    if (primitive_.mode != TINYGLTF_MODE_TRIANGLES) {
      findings_.unsupported(pointer_ + "/mode", "Draco data is only supported for triangle lists.");
      return std::nullopt;
    }
    const auto ids = idsOf(at + "/attributes");
    if (!ids) return std::nullopt;
    DracoClaims claims{accessorOf("POSITION").count, std::nullopt};
    if (const auto indices = source_.find("indices"); indices != source_.end()) {
      claims.triangles = document_.model.accessors[indices->get<std::size_t>()].count / 3;
    }
    const auto view = extension_["bufferView"].get<std::size_t>();
    std::set<std::uint32_t> wanted;
    for (const auto& [name, id] : *ids) wanted.insert(id);
    const auto mesh = decodeDraco(document_.bufferViews[view], claims, wanted, limits, budget, at, findings_);
    if (!mesh) return std::nullopt;
    return viewed(*mesh, *ids, at + "/attributes");
  }

 private:
  const tinygltf::Accessor& accessorOf(const std::string& name) const {
    return document_.model.accessors[static_cast<std::size_t>(primitive_.attributes.at(name))];
  }

  /// The ids of the attributes by name; the primitive has each of them, and POSITION is among them.
  std::optional<std::map<std::string, std::uint32_t>> idsOf(const std::string& pointer) const {
    std::map<std::string, std::uint32_t> ids;
    for (const auto& [name, id] : extension_["attributes"].items()) {
      if (!primitive_.attributes.contains(name)) {
        findings_.invalid(pointerTo(pointer, name), "The primitive has no such attribute.");
        return std::nullopt;
      }
      ids[name] = id.get<std::uint32_t>();
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
      const tinygltf::Accessor& accessor = accessorOf(name);
      const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
      const auto type = static_cast<ComponentType>(accessor.componentType);
      if (attribute.components != components || attribute.type != type) {
        findings_.invalid(pointerTo(pointer, name), "The Draco data is not of the type that the accessor states.",
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
  const tinygltf::Primitive& primitive_;
  const json& source_;
  const json& extension_;
  std::string pointer_;
  Findings& findings_;
};

} // namespace

DracoPrimitives decodeDracoPrimitives(const GltfDocument& document, const Limits& limits, Findings& findings) {
  DracoPrimitives decoded;
  DecodeBudget budget(limits.maxDecodedBytes, document.decodedBytes);
  for (std::size_t m = 0; m < document.model.meshes.size(); ++m) {
    const tinygltf::Mesh& mesh = document.model.meshes[m];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const json& source = document.json["meshes"][m]["primitives"][p];
      if (extensionOf(source, kExtension) == nullptr) continue;
      const std::string pointer = pointerTo(pointerTo("/meshes", m) + "/primitives", p);
      auto primitive =
          PrimitiveDecoding(document, mesh.primitives[p], source, pointer, findings).decode(limits, budget);
      if (!primitive) return {};
      decoded.emplace(std::pair(m, p), *std::move(primitive));
    }
  }
  return decoded;
}

} // namespace gnomon
