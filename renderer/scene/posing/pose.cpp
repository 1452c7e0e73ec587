#include "renderer/scene/posing/pose.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "renderer/core/aabb.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/core/stop.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/geometry/mesh_build.h"
#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/geometry/welding.h"
#include "renderer/scene/reach.h"

namespace gnomon {

namespace {

/// A vertex on its way, in double precision: sums of many small moves keep their digits.
struct Moving {
  glm::dvec3 position{0};
  glm::dvec3 normal{0};
  glm::dvec3 tangent{0};
  double side = 1; ///< of the bitangent
};

std::vector<Moving> atRest(const TriangleMesh& mesh) {
  std::vector<Moving> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const VertexAttributes& attributes = mesh.attributes[i];
    vertices[i] = {glm::dvec3(mesh.positions[i]), glm::dvec3(attributes.normal), glm::dvec3(attributes.tangent),
                   static_cast<double>(attributes.tangent.w)};
  }
  return vertices;
}

void addTarget(const MorphTarget& target, double weight, std::vector<Moving>& vertices) {
  if (weight == 0) return;
  for (const MorphDelta& delta : target) {
    Moving& vertex = vertices[delta.vertex];
    vertex.position += weight * glm::dvec3(delta.position);
    vertex.normal += weight * glm::dvec3(delta.normal);
    vertex.tangent += weight * glm::dvec3(delta.tangent);
  }
}

/// Joints that the skin does not have count for nothing; a vertex that has only such follows the first of the skin.
void follow(const Influences& influences, std::span<const glm::dmat4> localFromMesh, Moving& vertex) {
  glm::dmat4 matrix(0);
  double used = 0;
  bool someMissing = false;
  for (std::size_t i = 0; i < influences.joints.size(); ++i) {
    const double weight = influences.weights[i];
    if (weight == 0) continue;
    if (influences.joints[i] < localFromMesh.size()) {
      matrix += weight * localFromMesh[influences.joints[i]];
      used += weight;
    } else {
      someMissing = true;
    }
  }
  if (someMissing) matrix = used > 0 ? matrix / used : localFromMesh.front();
  const glm::dmat3 linear(matrix);
  const double side = glm::determinant(linear) < 0 ? -1 : 1;
  vertex.position = glm::dvec3(matrix * glm::dvec4(vertex.position, 1));
  vertex.normal = normalMatrix(linear) * vertex.normal;
  vertex.tangent = linear * vertex.tangent;
  vertex.side *= side;
}

/// Each triangle has its own vertices here.
void setFlatNormals(const TriangleMesh& mesh, PosedShape& shape) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t* corners = &mesh.indices[i];
    const glm::dvec3 a(shape.positions[corners[0]]);
    const glm::dvec3 area =
        glm::cross(glm::dvec3(shape.positions[corners[1]]) - a, glm::dvec3(shape.positions[corners[2]]) - a);
    const glm::vec3 normal(unitOr(area, {0, 0, 1}));
    for (int corner = 0; corner < 3; ++corner) shape.normals[corners[corner]] = normal;
  }
}

class Posing {
 public:
  Posing(const LoadContext& load, const NodeTree& tree, const std::vector<BuiltMesh>& meshes, Deformation& deformation,
         Scene& scene)
      : model_(load.document.model),
        load_(load),
        tree_(tree),
        meshes_(meshes),
        deformation_(deformation),
        scene_(scene),
        moving_(nodesWithMovingWeights(model_)) {}

  PosedMesh poseNode(std::size_t node) {
    const gltf::Node& source = model_.nodes[node];
    if (source.mesh < 0) return {};
    const BuiltMesh& mesh = meshes_[static_cast<std::size_t>(source.mesh)];
    if (mesh.deformables.empty()) return {};
    const std::vector<double> weights = weightsOf(node, static_cast<std::size_t>(source.mesh), mesh);
    const int skin = skinOf(node, mesh);
    const int own = moving_.contains(node) ? static_cast<int>(node) : -1;
    const auto [place, isNew] = posed_.try_emplace({source.mesh, skin, own, weights});
    if (isNew) place->second = makePrimitives(node, mesh, skin, weights);
    return place->second;
  }

 private:
  /// The node's weights, else the mesh's, else zeros; one a target, whatever the file has.
  std::vector<double> weightsOf(std::size_t node, std::size_t mesh, const BuiltMesh& built) {
    const std::size_t targets = deformable(built.deformables.front()).targets.size();
    const bool own = model_.nodes[node].weights.has_value();
    std::vector<double> weights =
        (own ? model_.nodes[node].weights : model_.meshes[mesh].weights).value_or(std::vector<double>(targets, 0.0));
    if (own && weights.size() != targets) { // those of meshes are checked where they are read
      load_.findings.repair(kOtherWeights, pointerTo("/nodes", node) + "/weights", std::to_string(targets),
                            std::to_string(weights.size()));
    }
    weights.resize(targets, 0.0);
    return weights;
  }

  /// What deforms the mesh at a node; -1 = no skin.
  int skinOf(std::size_t node, const BuiltMesh& mesh) {
    const int skin = model_.nodes[node].skin;
    if (skin < 0) return -1;
    const std::size_t joints = deformation_.skins[static_cast<std::size_t>(skin)].joints.size();
    if (joints == 0) return -1;
    for (const int index : mesh.deformables) {
      const int greatest = deformable(index).greatestJoint;
      if (greatest < static_cast<int>(joints)) continue;
      load_.findings.repair(
          {"A mesh uses joints that its skin does not have", "its vertices follow their other joints"},
          pointerTo("/nodes", node) + "/skin", "below " + std::to_string(joints), std::to_string(greatest));
    }
    return skin;
  }

  PosedMesh makePrimitives(std::size_t node, const BuiltMesh& mesh, int skin, const std::vector<double>& weights) {
    PosedMesh made;
    if (skin >= 0) made.worldFromSkin = jointsOf(skin).worldFromLocal;
    for (const int index : mesh.deformables) {
      stopIfAsked();
      const Deformable& source = deformable(index);
      const bool skinned = skin >= 0 && !source.influences.empty();
      if (!withinLimits(node, source)) return {};
      const PosedShape shape =
          pose(source, weights, skinned ? jointsOf(skin).localFromMesh : std::span<const glm::dmat4>());
      if (!finite(shape.bounds)) {
        load_.findings.invalid(pointerTo("/nodes", node), "The posed mesh has positions that are not finite.", {},
                               nodeTitle(node, model_.nodes[node].name));
        return {};
      }
      const int primitive = appendPrimitive(source.mesh, source.material, scene_);
      scene_.primitives.back().variantMaterials = source.variantMaterials;
      applyPose(shape, primitive, scene_);
      (skinned ? made.followingSkin : made.followingNode).push_back(primitive);
      deformation_.posed.push_back({primitive, index, static_cast<int>(node), skinned ? skin : -1, weights});
    }
    return made;
  }

  const SkinPose& jointsOf(int skin) {
    const auto [place, isNew] = joints_.try_emplace(skin);
    if (isNew) place->second = poseSkin(deformation_.skins[static_cast<std::size_t>(skin)], tree_.worldFromNode);
    return place->second;
  }

  /// Each node may have a copy of its own, so that what the meshes come to is counted here once more.
  bool withinLimits(std::size_t node, const Deformable& source) {
    for (const MorphTarget& target : source.targets) morphed_ += target.size();
    const auto within = [&](const char* what, std::size_t limit, std::size_t actual) {
      if (actual <= limit) return true;
      load_.findings.tooLarge(pointerTo("/nodes", node) + "/mesh",
                              std::string("The posed meshes have too many ") + what + ".", std::to_string(limit),
                              std::to_string(actual));
      return false;
    };
    return within("vertices", load_.limits.maxVertices, scene_.positions.size() + source.mesh.positions.size()) &&
           within("triangles", load_.limits.maxTriangles, (scene_.indices.size() + source.mesh.indices.size()) / 3) &&
           within("morphed vertices", load_.limits.maxMorphedVertices, morphed_);
  }

  const Deformable& deformable(int index) const { return deformation_.deformables[static_cast<std::size_t>(index)]; }

  const gltf::Model& model_;
  const LoadContext& load_;
  const NodeTree& tree_;
  const std::vector<BuiltMesh>& meshes_;
  Deformation& deformation_;
  Scene& scene_;
  std::set<std::size_t> moving_;
  std::map<int, SkinPose> joints_; ///< by skin
  std::size_t morphed_ = 0;
  /// By mesh, skin, the node if its weights are animated, and weights.
  std::map<std::tuple<int, int, int, std::vector<double>>, PosedMesh> posed_;
};

} // namespace

SkinPose poseSkin(const Skin& skin, std::span<const glm::dmat4> worldFromNode) {
  const auto worldFromMesh = [&](std::size_t joint) {
    return worldFromNode[static_cast<std::size_t>(skin.joints[joint])] * skin.jointFromMesh[joint];
  };
  if (skin.joints.empty()) return {};
  const glm::dvec3 origin(worldFromNode[static_cast<std::size_t>(skin.joints.front())][3]);
  const double mirrored = glm::determinant(glm::dmat3(worldFromMesh(0))) < 0 ? -1 : 1;
  SkinPose posed;
  posed.worldFromLocal[0][0] = mirrored;
  posed.worldFromLocal[3] = glm::dvec4(origin, 1);
  posed.localFromMesh.reserve(skin.joints.size());
  for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
    glm::dmat4 matrix = worldFromMesh(joint);
    matrix[3] -= glm::dvec4(origin, 0);
    for (int column = 0; column < 4; ++column) matrix[column].x *= mirrored;
    posed.localFromMesh.push_back(matrix);
  }
  return posed;
}

PosedShape pose(const Deformable& deformable, std::span<const double> weights,
                std::span<const glm::dmat4> localFromMesh) {
  const TriangleMesh& mesh = deformable.mesh;
  std::vector<Moving> vertices = atRest(mesh);
  for (std::size_t i = 0; i < deformable.targets.size() && i < weights.size(); ++i) {
    stopIfAsked();
    addTarget(deformable.targets[i], weights[i], vertices);
  }
  PosedShape shape;
  shape.positions.reserve(vertices.size());
  shape.normals.reserve(vertices.size());
  if (mesh.hasTangents) shape.tangents.reserve(vertices.size());
  constexpr std::size_t kVerticesAtOnce = 1 << 12;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i % kVerticesAtOnce == 0) stopIfAsked();
    Moving& vertex = vertices[i];
    if (!localFromMesh.empty() && !deformable.influences.empty()) {
      follow(deformable.influences[i], localFromMesh, vertex);
    }
    shape.positions.emplace_back(vertex.position);
    shape.bounds.add(glm::dvec3(shape.positions.back()));
    shape.normals.emplace_back(unitOr(vertex.normal, glm::dvec3(mesh.attributes[i].normal)));
    if (mesh.hasTangents) {
      shape.tangents.emplace_back(unitOr(vertex.tangent, glm::dvec3(mesh.attributes[i].tangent)),
                                  static_cast<float>(vertex.side));
    }
  }
  if (mesh.flat) setFlatNormals(mesh, shape);
  return shape;
}

void applyPose(const PosedShape& shape, int index, Scene& scene) {
  Primitive& primitive = scene.primitives[static_cast<std::size_t>(index)];
  std::copy(shape.positions.begin(), shape.positions.end(), scene.positions.edit().begin() + primitive.baseVertex);
  const auto attributes = std::span(scene.attributes.edit()).subspan(primitive.baseVertex, shape.positions.size());
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    attributes[i].normal = shape.normals[i];
    if (!shape.tangents.empty()) attributes[i].tangent = shape.tangents[i];
  }
  const auto indices = std::span(scene.indices).subspan(primitive.firstIndex, primitive.indexCount);
  const std::vector<Cluster> clusters = clustersOf(indices, shape.positions);
  std::copy(clusters.begin(), clusters.end(), scene.clusters.begin() + primitive.firstCluster);
  primitive.bounds = {};
  for (const Cluster& cluster : clusters) primitive.bounds.add(cluster.bounds);
  stopIfAsked();
  const std::vector<std::uint32_t> welded = weldedIndices(indices, shape.positions);
  std::copy(welded.begin(), welded.end(), scene.welded.edit().begin() + primitive.firstIndex);
  primitive.solid = boundsSolids(welded, shape.positions);
}

std::vector<PosedMesh> poseNodes(const LoadContext& load, const NodeTree& tree, const std::vector<BuiltMesh>& meshes,
                                 Deformation& deformation, Scene& scene) {
  Posing posing(load, tree, meshes, deformation, scene);
  std::vector<PosedMesh> posed(load.document.model.nodes.size());
  for (std::size_t node = 0; node < posed.size() && !load.findings.refused(); ++node) {
    posed[node] = posing.poseNode(node);
  }
  return posed;
}

} // namespace gnomon
