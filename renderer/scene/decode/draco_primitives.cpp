#include "renderer/scene/decode/draco_primitives.h"

#include <algorithm>
#include <array>
#include <set>

#include "renderer/core/stop.h"

namespace gnomon {

namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

/// glTF's names.
constexpr std::array<std::pair<ComponentType, const char*>, 6> kTypeNames{{{ComponentType::int8, "BYTE"},
                                                                           {ComponentType::uint8, "UNSIGNED_BYTE"},
                                                                           {ComponentType::int16, "SHORT"},
                                                                           {ComponentType::uint16, "UNSIGNED_SHORT"},
                                                                           {ComponentType::uint32, "UNSIGNED_INT"},
                                                                           {ComponentType::float32, "FLOAT"}}};

std::string shapeText(ComponentType type, int components) {
  return std::to_string(components) + " x " +
         std::ranges::find(kTypeNames, type, &std::pair<ComponentType, const char*>::first)->second;
}

class PrimitiveDecoding {
 public:
  PrimitiveDecoding(const LoadContext& load, const gltf::Primitive& primitive, std::string pointer, Findings& findings)
      : load_(load), findings_(findings), primitive_(primitive), pointer_(std::move(pointer)) {}

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
      claims.triangles = load_.document.model.accessors[static_cast<std::size_t>(primitive_.indices)].count / 3;
    }
    std::set<std::uint32_t> wanted;
    for (const auto& [name, id] : *ids) wanted.insert(id);
    auto mesh = decodeDraco(load_.document.bufferViews[primitive_.draco->bufferView], claims, wanted, load_.limits,
                            budget, at, findings_);
    if (!mesh) return std::nullopt;
    return viewed(*std::move(mesh), *ids, at + "/attributes");
  }

 private:
  const gltf::Accessor& accessorOf(const std::string& name) const {
    return load_.document.model.accessors[static_cast<std::size_t>(primitive_.attributes.at(name))];
  }

  /// The ids of the attributes by name; the primitive has each of them, and POSITION is among them.
  std::optional<std::map<std::string, std::uint32_t>> idsOf(const std::string& pointer) const {
    std::map<std::string, std::uint32_t> ids = primitive_.draco->attributes;
    for (auto id = ids.begin(); id != ids.end();) {
      if (primitive_.attributes.contains(id->first)) {
        ++id;
        continue;
      }
      findings_.repair({"Draco data has an attribute that its primitive lacks", "it is not read"},
                       pointerTo(pointer, id->first));
      id = ids.erase(id);
    }
    if (!ids.contains("POSITION")) {
      findings_.invalid(pointer, "The Draco data has no positions.");
      return std::nullopt;
    }
    return ids;
  }

  DracoPrimitive viewed(DracoMesh decodedMesh, const std::map<std::string, std::uint32_t>& ids,
                        const std::string& pointer) {
    DracoPrimitive decoded;
    decoded.mesh = std::move(decodedMesh);
    const DracoMesh& mesh = decoded.mesh;
    for (const auto& [name, id] : ids) {
      const auto found = mesh.attributes.find(id);
      if (found == mesh.attributes.end()) {
        decoded.attributes[name] = kFaultyAccessor;
        continue;
      }
      const DracoAttribute& attribute = found->second;
      const gltf::Accessor& accessor = accessorOf(name);
      const int components = attribute.components;
      const ComponentType type = attribute.type;
      if (components != componentsOf(accessor.type) || type != accessor.componentType) {
        findings_.repair({"Draco data has another type than its accessor states", "its own holds"},
                         pointerTo(pointer, name), shapeText(accessor.componentType, componentsOf(accessor.type)),
                         shapeText(type, components));
      }
      if (accessor.count != accessorOf("POSITION").count) continue; // reported where the accessors are gathered
      AccessorView view;
      view.count = mesh.points;
      view.components = components;
      view.componentType = type;
      view.normalized = accessor.normalized && type != ComponentType::float32;
      view.stride = bytesOf(type) * static_cast<std::size_t>(components);
      view.data = attribute.bytes.data();
      decoded.attributes[name] = view;
    }
    decoded.indices.componentType = ComponentType::uint32;
    decoded.indices.count = mesh.corners.size();
    decoded.indices.stride = sizeof(std::uint32_t);
    decoded.indices.data = reinterpret_cast<const std::uint8_t*>(mesh.corners.data());
    return decoded;
  }

  const LoadContext& load_;
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
      stopIfAsked();
      const std::string pointer = pointerTo(pointerTo("/meshes", m) + "/primitives", p);
      Findings ofPrimitive;
      auto primitive = PrimitiveDecoding(load, mesh.primitives[p], pointer, ofPrimitive).decode(budget);
      load.findings.leaveOut(std::move(ofPrimitive), "the primitive is left out", true);
      if (load.findings.refused()) return {};
      if (primitive) decoded.emplace(std::pair(m, p), *std::move(primitive));
    }
  }
  return decoded;
}

} // namespace gnomon
