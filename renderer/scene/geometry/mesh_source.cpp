#include "renderer/scene/geometry/mesh_source.h"

#include <algorithm>
#include <optional>

#include "renderer/scene/materials/materials.h"

namespace gnomon {

namespace {

/// The numbers of components of an attribute that can be read, and that glTF allows.
struct AttributeShape {
  int fewest = 3;
  int mostAllowed = 3;
  bool wideIntegers = false; ///< 32 bits of an integer have a meaning
};

const Repair kNoBounds{"The positions of a primitive have no min and max", "they are found from its vertices"};
const Repair kAttributeUnread{"A vertex attribute has an accessor that can't be read", "it is left out"};
const Repair kWrongType{"A vertex attribute has a type that it can't have", "it is left out"};
const Repair kTooWide{"A vertex attribute has more components than glTF allows", "those beyond are not used"};
const Repair kTooFew{"A vertex attribute has fewer elements than POSITION", "it is left out"};
const Repair kTooMany{"A vertex attribute has more elements than POSITION", "those beyond are not used"};
const Repair kUnscaled{"A vertex attribute of integers is not normalized", "it is read as if it were"};
const Repair kOddJoints{"Joints are not unsigned bytes or shorts", "they are read as the numbers that they are"};
const Repair kUnpaired{"JOINTS_n or WEIGHTS_n is there without the other", "it is left out"};
const Repair kNoPositions{"The positions of a primitive can't be read", "the primitive is left out", true};
const Repair kNoIndices{"The indices of a primitive can't be read", "the primitive is left out", true};
const Repair kStridedIndices{"The buffer view of indices has a byteStride", "it is followed"};
const Repair kNormalizedIndices{"The accessor of indices is normalized", "they are read as whole numbers"};
const Repair kIncomplete{"The last triangle of a primitive is incomplete", "it is left out"};

class PrimitiveGathering {
 public:
  PrimitiveGathering(const LoadContext& load, const gltf::Primitive& primitive, const DracoPrimitive* draco,
                     std::string pointer)
      : primitive_(primitive), load_(load), draco_(draco), findings_(load.findings) {
    source_.pointer = std::move(pointer);
  }

  /// Nothing, and a repair, where its positions or indices can't be read.
  std::optional<PrimitiveSource> gather(std::vector<int> variantMaterials, const std::vector<UvSets>& uvSets) {
    source_.material = primitive_.material;
    source_.variantMaterials = std::move(variantMaterials);
    source_.mode = primitive_.mode;
    source_.positions = attribute("POSITION", {3, 3});
    checkBounds(primitive_.attributes, source_.pointer + "/attributes");
    checkOwnAttributes();
    if (!source_.positions) {
      findings_.repair(kNoPositions, source_.pointer + "/attributes/POSITION");
      return std::nullopt;
    }
    if (!gatherIndices()) {
      findings_.repair(kNoIndices, source_.pointer + "/indices");
      return std::nullopt;
    }
    source_.normals = attribute("NORMAL", {3, 3});
    source_.tangents = attribute("TANGENT", {4, 4});
    const UvSets sets = uvSetsOf(source_.material, source_.variantMaterials, uvSets);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      source_.texCoords[i] = attribute("TEXCOORD_" + std::to_string(sets[i]), {2, 2});
    }
    source_.colors = attribute("COLOR_0", {3, 4});
    if (source_.colors) source_.colorMost = mostOf(*source_.colors, "COLOR_0");
    gatherJoints();
    for (std::size_t i = 0; i < primitive_.targets.size(); ++i) gatherTarget(i);
    return std::move(source_);
  }

 private:
  void checkBounds(const gltf::Attributes& attributes, const std::string& pointer) {
    const auto found = attributes.find("POSITION");
    if (found == attributes.end()) return;
    const gltf::Accessor& accessor = load_.document.model.accessors[static_cast<std::size_t>(found->second)];
    if (!accessor.faulty && (accessor.min.empty() || accessor.max.empty())) {
      findings_.repair(kNoBounds, pointer + "/POSITION");
    }
  }

  /// Those of the application are not read.
  void checkOwnAttributes() {
    for (const auto& [name, accessor] : primitive_.attributes) {
      const gltf::Accessor& own = load_.document.model.accessors[static_cast<std::size_t>(accessor)];
      if (!name.starts_with('_') || own.faulty || own.componentType != ComponentType::uint32) continue;
      findings_.repair({"A vertex attribute of the application's own has 32-bit integers", "it is not used"},
                       pointerOf(name));
    }
  }

  std::string pointerOf(const std::string& name) const { return source_.pointer + "/attributes/" + name; }

  const AccessorView* attribute(const std::string& name, AttributeShape shape) {
    const auto found = primitive_.attributes.find(name);
    if (found == primitive_.attributes.end()) return nullptr;
    return checked(viewOf(name, found->second), pointerOf(name), shape);
  }

  /// Nothing, and a repair, where it does not hold what it should.
  const AccessorView* checked(const AccessorView& view, const std::string& pointer, AttributeShape shape) {
    const bool tooWide = view.componentType == ComponentType::uint32 && !shape.wideIntegers;
    if (view.faulty || view.components < shape.fewest || tooWide) {
      findings_.repair(view.faulty ? kAttributeUnread : kWrongType, pointer);
      return nullptr;
    }
    const std::size_t vertices = source_.positions ? source_.positions->count : view.count;
    if (view.count < vertices) {
      findings_.repair(kTooFew, pointer, std::to_string(vertices), std::to_string(view.count));
      return nullptr;
    }
    if (view.count > vertices) {
      findings_.repair(kTooMany, pointer, std::to_string(vertices), std::to_string(view.count));
    }
    if (view.components > shape.mostAllowed) findings_.repair(kTooWide, pointer);
    return &view;
  }

  const AccessorView& viewOf(const std::string& name, int accessor) const {
    if (draco_) {
      const auto decoded = draco_->attributes.find(name);
      if (decoded != draco_->attributes.end()) return decoded->second;
    }
    return load_.accessors[static_cast<std::size_t>(accessor)];
  }

  /// What is read where 1 is meant: the greatest value of integers that should be normalized and are not.
  double mostOf(const AccessorView& view, const std::string& name) {
    if (view.normalized || view.componentType == ComponentType::float32) return 1;
    findings_.repair(kUnscaled, pointerOf(name));
    const bool isByte = view.componentType == ComponentType::int8 || view.componentType == ComponentType::uint8;
    return isByte ? 255 : 65535;
  }

  void gatherJoints() {
    for (std::size_t set = 0; set < source_.joints.size(); ++set) {
      const std::string number = std::to_string(set);
      const AccessorView* joints = attribute("JOINTS_" + number, {4, 4, true});
      const AccessorView* weights = attribute("WEIGHTS_" + number, {4, 4});
      if (!joints && !weights) return;
      if (!joints || !weights)
        return findings_.repair(kUnpaired, pointerOf((joints ? "JOINTS_" : "WEIGHTS_") + number));
      const ComponentType type = joints->componentType;
      if ((type != ComponentType::uint8 && type != ComponentType::uint16) || joints->normalized) {
        findings_.repair(kOddJoints, pointerOf("JOINTS_" + number));
      }
      mostOf(*weights, "WEIGHTS_" + number); // they are scaled to a sum of 1 in any case
      source_.joints[set] = joints;
      source_.weights[set] = weights;
    }
    if (primitive_.attributes.contains("JOINTS_2")) {
      findings_.warn("The primitive " + source_.pointer + " has more than eight joints a vertex; eight are used.");
    }
  }

  void gatherTarget(std::size_t index) {
    const std::string pointer = pointerTo(source_.pointer + "/targets", index);
    checkBounds(primitive_.targets[index], pointer);
    MorphSource target;
    for (const auto& [name, accessor] : primitive_.targets[index]) {
      const AccessorView** member = name == "POSITION"  ? &target.positions
                                    : name == "NORMAL"  ? &target.normals
                                    : name == "TANGENT" ? &target.tangents
                                                        : nullptr;
      if (member)
        *member = checked(load_.accessors[static_cast<std::size_t>(accessor)], pointerTo(pointer, name), {3, 3});
    }
    source_.targets.push_back(target);
  }

  /// False where the primitive has indices that can't be read.
  bool gatherIndices() {
    if (draco_) {
      source_.indices = &draco_->indices;
      return true;
    }
    if (primitive_.indices < 0) return true;
    const auto accessor = static_cast<std::size_t>(primitive_.indices);
    const AccessorView& view = load_.accessors[accessor];
    const ComponentType type = view.componentType;
    const bool isUnsigned =
        type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
    if (view.faulty || view.components != 1 || !isUnsigned) return false;
    if (view.normalized) findings_.repair(kNormalizedIndices, source_.pointer + "/indices");
    if (view.data && view.stride != bytesOf(type)) findings_.repair(kStridedIndices, source_.pointer + "/indices");
    source_.indices = &view;
    return true;
  }

  const gltf::Primitive& primitive_;
  const LoadContext& load_;
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

std::size_t mostTargets(const gltf::Mesh& mesh) {
  std::size_t most = 0;
  for (const gltf::Primitive& primitive : mesh.primitives) most = std::max(most, primitive.targets.size());
  return most;
}

/// Gives all primitives of a mesh as many targets (glTF 2.0, 3.7.2.2): added ones move nothing.
void evenTargets(const gltf::Mesh& mesh, PrimitiveSource& source, Findings& findings) {
  const std::size_t most = mostTargets(mesh);
  if (source.targets.size() == most) return;
  findings.repair({"A primitive has fewer morph targets than another of its mesh", "what it lacks moves nothing"},
                  source.pointer + "/targets", std::to_string(most), std::to_string(source.targets.size()));
  source.targets.resize(most);
}

void checkWeights(const gltf::Mesh& mesh, const std::string& pointer, Findings& findings) {
  if (!mesh.weights) return;
  const std::size_t targets = mostTargets(mesh);
  if (mesh.weights->size() == targets) return;
  findings.repair(kOtherWeights, pointer + "/weights", std::to_string(targets), std::to_string(mesh.weights->size()));
}

/// `morphed` counts the vertices of all.
bool morphFits(const PrimitiveSource& source, const Limits& limits, std::size_t& morphed, Findings& findings) {
  const std::string pointer = source.pointer + "/targets";
  const std::size_t targets = source.targets.size();
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
    checkWeights(mesh, pointerTo("/meshes", m), findings);
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const gltf::Primitive& primitive = mesh.primitives[p];
      const std::string pointer = pointerTo(pointerTo("/meshes", m) + "/primitives", p);
      if (!drawsTriangles(primitive.mode)) {
        findings.warn("Mesh " + std::to_string(m) + " has points or lines, which are not drawn.");
        continue;
      }
      if (!primitive.attributes.contains("POSITION")) {
        findings.warn("Mesh " + std::to_string(m) + " has a primitive without positions, which is not drawn.");
        continue;
      }
      const auto compressed = draco.find({m, p});
      if (primitive.draco && compressed == draco.end()) continue; // reported where it is decoded
      auto gathered =
          PrimitiveGathering(load, primitive, compressed == draco.end() ? nullptr : &compressed->second, pointer)
              .gather(variantMaterials(model, primitive), uvSets);
      if (!gathered) continue;
      PrimitiveSource& source = *gathered;
      if (source.mode == PrimitiveMode::triangles && source.corners() % 3 != 0) findings.repair(kIncomplete, pointer);
      evenTargets(mesh, source, findings);
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
      if (!morphFits(source, limits, morphed, findings)) return {};
      meshes[m].push_back(std::move(source));
    }
  }
  return meshes;
}

} // namespace gnomon
