#include "renderer/scene/geometry/mesh_source.h"

#include <algorithm>
#include <initializer_list>

#include "renderer/scene/materials/materials.h"

namespace gnomon {

namespace {

class PrimitiveGathering {
 public:
  PrimitiveGathering(const LoadContext& load, const gltf::Primitive& primitive, const DracoPrimitive* draco,
                     std::string pointer)
      : primitive_(primitive),
        views_(load.accessors),
        document_(load.document),
        draco_(draco),
        findings_(load.findings) {
    source_.pointer = std::move(pointer);
  }

  PrimitiveSource gather(std::vector<int> variantMaterials, const std::vector<UvSets>& uvSets) {
    source_.material = primitive_.material;
    source_.variantMaterials = std::move(variantMaterials);
    source_.mode = primitive_.mode;
    source_.positions = attribute("POSITION", {3});
    source_.normals = attribute("NORMAL", {3});
    source_.tangents = attribute("TANGENT", {4});
    const UvSets sets = uvSetsOf(source_.material, source_.variantMaterials, uvSets);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      source_.texCoords[i] = attribute("TEXCOORD_" + std::to_string(sets[i]), {2});
    }
    source_.colors = attribute("COLOR_0", {3, 4});
    gatherJoints();
    for (std::size_t i = 0; i < primitive_.targets.size(); ++i) gatherTarget(i);
    if (draco_) {
      source_.indices = &draco_->indices;
    } else if (primitive_.indices >= 0) {
      gatherIndices();
    }
    return std::move(source_);
  }

 private:
  const AccessorView* attribute(const std::string& name, std::initializer_list<int> components) {
    const auto found = primitive_.attributes.find(name);
    if (found == primitive_.attributes.end()) return nullptr;
    return checked(viewOf(name, found->second), name, source_.pointer + "/attributes/" + name, components);
  }

  const AccessorView* checked(const AccessorView& view, const std::string& name, const std::string& pointer,
                              std::initializer_list<int> components) {
    if (std::find(components.begin(), components.end(), view.components) == components.end()) {
      findings_.invalid(pointer, "The accessor's type is not valid for " + name + ".");
      return nullptr;
    }
    if (source_.positions && view.count != source_.positions->count) {
      findings_.invalid(pointer, "The accessor's count differs from that of POSITION.",
                        std::to_string(source_.positions->count), std::to_string(view.count));
      return nullptr;
    }
    return &view;
  }

  const AccessorView& viewOf(const std::string& name, int accessor) const {
    if (draco_) {
      const auto decoded = draco_->attributes.find(name);
      if (decoded != draco_->attributes.end()) return decoded->second;
    }
    return views_[static_cast<std::size_t>(accessor)];
  }

  void gatherJoints() {
    for (std::size_t set = 0; set < source_.joints.size(); ++set) {
      const std::string number = std::to_string(set);
      const AccessorView* joints = attribute("JOINTS_" + number, {4});
      const AccessorView* weights = attribute("WEIGHTS_" + number, {4});
      if (!joints && !weights) return;
      const std::string pointer = source_.pointer + "/attributes/";
      if (!joints || !weights) {
        return findings_.invalid(pointer + (joints ? "JOINTS_" : "WEIGHTS_") + number,
                                 "JOINTS_n and WEIGHTS_n must appear together.");
      }
      const ComponentType type = joints->componentType;
      if ((type != ComponentType::uint8 && type != ComponentType::uint16) || joints->normalized) {
        return findings_.invalid(pointer + "JOINTS_" + number, "The joints are not unsigned bytes or shorts.");
      }
      if (weights->componentType != ComponentType::float32 && !weights->normalized) {
        return findings_.invalid(pointer + "WEIGHTS_" + number, "The weights are not floats or normalized integers.");
      }
      source_.joints[set] = joints;
      source_.weights[set] = weights;
    }
    if (primitive_.attributes.contains("JOINTS_2")) {
      findings_.warn("The primitive " + source_.pointer + " has more than eight joints a vertex; eight are used.");
    }
  }

  void gatherTarget(std::size_t index) {
    const std::string pointer = pointerTo(source_.pointer + "/targets", index);
    MorphSource target;
    for (const auto& [name, accessor] : primitive_.targets[index]) {
      const AccessorView** member = name == "POSITION"  ? &target.positions
                                    : name == "NORMAL"  ? &target.normals
                                    : name == "TANGENT" ? &target.tangents
                                                        : nullptr;
      if (member) *member = checked(views_[static_cast<std::size_t>(accessor)], name, pointerTo(pointer, name), {3});
    }
    source_.targets.push_back(target);
  }

  void gatherIndices() {
    const auto accessor = static_cast<std::size_t>(primitive_.indices);
    const AccessorView& view = views_[accessor];
    const ComponentType type = view.componentType;
    const bool isUnsigned =
        type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
    if (view.components != 1 || !isUnsigned || document_.model.accessors[accessor].normalized) {
      findings_.invalid(source_.pointer + "/indices",
                        "The accessor of the indices is not a SCALAR of unsigned integers.");
      return;
    }
    if (view.data && view.stride != bytesOf(type)) {
      findings_.invalid(source_.pointer + "/indices", "The buffer view of the indices has a byteStride.");
      return;
    }
    source_.indices = &view;
  }

  const gltf::Primitive& primitive_;
  const std::vector<AccessorView>& views_;
  const GltfDocument& document_;
  const DracoPrimitive* draco_; ///< nullptr = not compressed
  Findings& findings_;
  PrimitiveSource source_;
};

bool drawsTriangles(PrimitiveMode mode) {
  return mode == PrimitiveMode::triangles || mode == PrimitiveMode::triangleStrip || mode == PrimitiveMode::triangleFan;
}

/// The most vertices that a primitive can come to: flat normals give every triangle its own three.
std::size_t mostVertices(const PrimitiveSource& source) {
  const std::size_t separate = 3 * source.triangles();
  return source.normals ? std::min(source.positions->count, separate) : separate;
}

/// Every primitive of a mesh has the same number of targets (glTF 2.0, 3.7.2.2); `morphed` counts the vertices of all.
bool morphFits(const PrimitiveSource& source, const std::vector<PrimitiveSource>& before, const Limits& limits,
               std::size_t& morphed, Findings& findings) {
  const std::string pointer = source.pointer + "/targets";
  const std::size_t targets = source.targets.size();
  if (!before.empty() && targets != before.front().targets.size()) {
    findings.invalid(pointer, "The primitives of a mesh differ in their number of morph targets.",
                     std::to_string(before.front().targets.size()), std::to_string(targets));
    return false;
  }
  if (targets > limits.maxMorphTargets) {
    findings.tooLarge(pointer, "The mesh has too many morph targets.", std::to_string(limits.maxMorphTargets),
                      std::to_string(targets));
    return false;
  }
  morphed += targets * mostVertices(source);
  if (morphed > limits.maxMorphedVertices) {
    findings.tooLarge(pointer, "The morph targets have too many vertices.", std::to_string(limits.maxMorphedVertices),
                      std::to_string(morphed));
    return false;
  }
  return true;
}

} // namespace

std::size_t PrimitiveSource::triangles() const {
  const std::size_t count = corners();
  if (mode == PrimitiveMode::triangles) return count / 3;
  return count < 3 ? 0 : count - 2;
}

std::vector<std::vector<PrimitiveSource>> gatherMeshes(const LoadContext& load, const DracoPrimitives& draco,
                                                       const std::vector<UvSets>& uvSets) {
  const gltf::Model& model = load.document.model;
  const Limits& limits = load.limits;
  Findings& findings = load.findings;
  std::vector<std::vector<PrimitiveSource>> meshes(model.meshes.size());
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t morphed = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const gltf::Mesh& mesh = model.meshes[m];
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const gltf::Primitive& primitive = mesh.primitives[p];
      const std::string pointer = pointerTo(pointerTo("/meshes", m) + "/primitives", p);
      if (!drawsTriangles(primitive.mode)) {
        findings.warn("Mesh " + std::to_string(m) + " has points or lines, which are not drawn.");
        continue;
      }
      const auto compressed = draco.find({m, p});
      PrimitiveSource source =
          PrimitiveGathering(load, primitive, compressed == draco.end() ? nullptr : &compressed->second, pointer)
              .gather(variantMaterials(model, primitive), uvSets);
      if (!source.positions) {
        findings.warn("Mesh " + std::to_string(m) + " has a primitive without positions, which is not drawn.");
        continue;
      }
      if (source.mode == PrimitiveMode::triangles && source.corners() % 3 != 0) {
        findings.warn("Mesh " + std::to_string(m) +
                      " has a primitive whose last triangle is incomplete and not drawn.");
      }
      triangles += source.triangles();
      vertices += mostVertices(source);
      if (triangles > limits.maxTriangles || vertices > limits.maxVertices) {
        const bool ofTriangles = triangles > limits.maxTriangles;
        findings.tooLarge(pointer,
                          ofTriangles ? "The meshes have too many triangles." : "The meshes have too many vertices.",
                          std::to_string(ofTriangles ? limits.maxTriangles : limits.maxVertices),
                          std::to_string(ofTriangles ? triangles : vertices));
        return {};
      }
      if (!morphFits(source, meshes[m], limits, morphed, findings)) return {};
      meshes[m].push_back(std::move(source));
    }
  }
  return meshes;
}

} // namespace gnomon
