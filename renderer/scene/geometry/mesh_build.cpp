#include "renderer/scene/geometry/mesh_build.h"

#include <algorithm>
#include <bit>
#include <meshoptimizer.h>
#include <span>

#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"
#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/geometry/welding.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/shared_content.h"

namespace gnomon {

namespace {

void giveVertexColors(const PrimitiveSource& source, int material, std::vector<Material>& materials) {
  materials[static_cast<std::size_t>(material)].hasVertexColors = true;
  for (const int other : source.variantMaterials) {
    if (other >= 0) materials[static_cast<std::size_t>(other)].hasVertexColors = true;
  }
}

/// What is computed of a primitive's triangles alone.
struct Outline {
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> welded;
  bool solid = false;
};

Outline outlineOf(const TriangleMesh& mesh) {
  Outline outline;
  outline.clusters = clustersOf(mesh.indices, mesh.positions);
  outline.welded = weldedIndices(mesh.indices, mesh.positions);
  outline.solid = boundsSolids(outline.welded, mesh.positions);
  return outline;
}

template <class T>
void add(const std::vector<T>& more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

int append(const TriangleMesh& mesh, const Outline& outline, int material, Scene& scene) {
  Primitive primitive;
  primitive.material = material;
  primitive.baseVertex = static_cast<std::uint32_t>(scene.positions.size());
  primitive.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  primitive.firstIndex = static_cast<std::uint32_t>(scene.indices.size());
  primitive.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
  primitive.firstCluster = static_cast<std::uint32_t>(scene.clusters.size());
  primitive.clusterCount = static_cast<std::uint32_t>(outline.clusters.size());
  primitive.hasTangents = mesh.hasTangents;
  primitive.solid = outline.solid;
  for (const Cluster& cluster : outline.clusters) primitive.bounds.add(cluster.bounds);

  add(mesh.positions, scene.positions.edit());
  add(mesh.attributes, scene.attributes.edit());
  add(mesh.indices, scene.indices.edit());
  add(outline.welded, scene.welded.edit());
  add(outline.clusters, scene.clusters);
  scene.primitives.push_back(primitive);
  return static_cast<int>(scene.primitives.size()) - 1;
}

/// Appends a primitive of another scene; returns its index.
int appendKnown(const KnownContent::Mesh& known, int material, Scene& scene) {
  const Scene& from = *known.scene;
  const auto append = [](auto& to, const auto& all, std::size_t first, std::size_t count) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  Primitive primitive = from.primitives[static_cast<std::size_t>(known.primitive)];
  const Primitive source = primitive;
  primitive.material = material;
  primitive.variantMaterials.clear();
  primitive.baseVertex = static_cast<std::uint32_t>(scene.positions.size());
  primitive.firstIndex = static_cast<std::uint32_t>(scene.indices.size());
  primitive.firstCluster = static_cast<std::uint32_t>(scene.clusters.size());
  append(scene.positions.edit(), *from.positions, source.baseVertex, source.vertexCount);
  append(scene.attributes.edit(), *from.attributes, source.baseVertex, source.vertexCount);
  append(scene.indices.edit(), *from.indices, source.firstIndex, source.indexCount);
  append(scene.welded.edit(), *from.welded, source.firstIndex, source.indexCount);
  append(scene.clusters, from.clusters, source.firstCluster, source.clusterCount);
  scene.primitives.push_back(std::move(primitive));
  return static_cast<int>(scene.primitives.size()) - 1;
}

/// A primitive on its way from the file into the scene.
struct ReadPrimitive {
  const PrimitiveSource& source;
  BuiltMesh& of;
  std::string content{};                     ///< empty = it may not be kept for other files
  std::optional<KnownContent::Mesh> known{}; ///< instead of `mesh`
  TriangleMesh mesh{};
  Outline outline{};
  Findings findings{};
};

void readVertices(ReadPrimitive& of) {
  of.mesh = buildVertices(of.source, of.findings);
  if (of.mesh.indices.empty()) return;
  of.mesh = ordered(std::move(of.mesh));
  if (!of.source.deforms()) of.outline = outlineOf(of.mesh);
}

/// Reads primitives in parallel, kMostCorners at a time, and appends them in order.
class MeshBuilder {
 public:
  MeshBuilder(int defaultMaterial, Scene& scene, std::vector<Deformable>& deformables, Findings& findings,
              KnownContent* known)
      : defaultMaterial_(defaultMaterial),
        scene_(scene),
        deformables_(deformables),
        findings_(findings),
        known_(known) {}

  void read(const PrimitiveSource& source, BuiltMesh& of) {
    stopIfAsked();
    std::string content = known_ != nullptr ? contents_.of(source) : std::string();
    auto known = content.empty() ? std::nullopt : known_->mesh(content);
    if (!known) corners_ += source.corners();
    read_.push_back({source, of, std::move(content), std::move(known)});
    if (corners_ >= kMostCorners) build();
  }

  void build() {
    forEach(read_.size(), [&](std::size_t i) {
      if (!read_[i].known) readVertices(read_[i]);
    });
    for (ReadPrimitive& each : read_) {
      stopIfAsked();
      if (each.findings.count() > 0) each.content.clear(); // what it says must be said for each file
      findings_.take(std::move(each.findings));
      if (each.known || !each.mesh.indices.empty()) add(each);
    }
    read_.clear();
    corners_ = 0;
  }

 private:
  static constexpr std::size_t kMostCorners = 1 << 20;

  void add(ReadPrimitive& read) {
    const PrimitiveSource& source = read.source;
    const int material = source.material >= 0 ? source.material : defaultMaterial_;
    if (source.colors) giveVertexColors(source, material, scene_.materials);
    if (source.deforms()) {
      read.of.deformables.push_back(static_cast<int>(deformables_.size()));
      deformables_.push_back(buildDeformable(source, std::move(read.mesh), findings_));
      deformables_.back().material = material;
      deformables_.back().variantMaterials = source.variantMaterials;
    } else {
      read.of.primitives.push_back(read.known ? appendKnown(*read.known, material, scene_)
                                              : append(read.mesh, read.outline, material, scene_));
      scene_.primitives.back().content = std::move(read.content);
      scene_.primitives.back().variantMaterials = source.variantMaterials;
    }
  }

  const int defaultMaterial_;
  Scene& scene_;
  std::vector<Deformable>& deformables_;
  Findings& findings_;
  KnownContent* const known_;
  MeshContents contents_;
  std::vector<ReadPrimitive> read_;
  std::size_t corners_ = 0; ///< of all that are read
};

/// The vertices of a cluster, ascending; `indices` become places among them.
std::vector<std::uint32_t> numberAnew(std::span<std::uint32_t> indices) {
  const auto [least, most] = std::minmax_element(indices.begin(), indices.end());
  const std::uint32_t first = *least;
  constexpr std::uint32_t kBits = 64;
  std::vector<std::uint64_t> used((*most - first) / kBits + 1);
  for (const std::uint32_t vertex : indices)
    used[(vertex - first) / kBits] |= std::uint64_t{1} << (vertex - first) % kBits;
  std::vector<std::uint32_t> before(used.size()); // how many lie in the words before each
  std::vector<std::uint32_t> vertices;
  for (std::size_t word = 0; word < used.size(); ++word) {
    before[word] = static_cast<std::uint32_t>(vertices.size());
    for (std::uint64_t bits = used[word]; bits != 0; bits &= bits - 1) {
      vertices.push_back(first + static_cast<std::uint32_t>(word) * kBits +
                         static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
  }
  for (std::uint32_t& vertex : indices) {
    const std::size_t word = (vertex - first) / kBits;
    const std::uint64_t lower = (std::uint64_t{1} << (vertex - first) % kBits) - 1;
    vertex = before[word] + static_cast<std::uint32_t>(std::popcount(used[word] & lower));
  }
  return vertices;
}

/// Reorders the triangles of one cluster, over vertices numbered from 0 so that the library's tables stay small.
void orderCluster(std::span<std::uint32_t> indices) {
  const std::vector<std::uint32_t> vertices = numberAnew(indices);
  std::vector<std::uint32_t> sorted(indices.size());
  meshopt_optimizeVertexCache(sorted.data(), indices.data(), indices.size(), vertices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = vertices[sorted[i]];
}

template <class T>
std::vector<T> moved(const std::vector<T>& values, const std::vector<std::uint32_t>& newIndex) {
  std::vector<T> result(values.size());
  meshopt_remapVertexBuffer(result.data(), values.data(), values.size(), sizeof(T), newIndex.data());
  return result;
}

} // namespace

int appendPrimitive(const TriangleMesh& mesh, int material, Scene& scene) {
  return append(mesh, outlineOf(mesh), material, scene);
}

std::vector<BuiltMesh> buildMeshes(const std::vector<std::vector<PrimitiveSource>>& meshes, int defaultMaterial,
                                   Scene& scene, std::vector<Deformable>& deformables, Findings& findings,
                                   KnownContent* known) {
  std::vector<BuiltMesh> built(meshes.size());
  MeshBuilder builder(defaultMaterial, scene, deformables, findings, known);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const PrimitiveSource& source : meshes[m]) builder.read(source, built[m]);
  }
  builder.build();
  return built;
}

std::vector<std::uint32_t> spatiallySorted(std::vector<std::uint32_t> indices, std::span<const glm::vec3> positions) {
  if (indices.size() <= std::size_t{3} * kClusterTriangles) return indices;
  std::vector<std::uint32_t> sorted(indices.size());
  meshopt_spatialSortTriangles(sorted.data(), indices.data(), indices.size(), &positions.front().x, positions.size(),
                               sizeof(glm::vec3));
  return sorted;
}

std::vector<Cluster> clustersOf(std::span<const std::uint32_t> indices, std::span<const glm::vec3> positions) {
  constexpr std::size_t kCorners = std::size_t{3} * kClusterTriangles;
  std::vector<Cluster> clusters;
  for (std::size_t first = 0; first < indices.size(); first += kCorners) {
    Cluster cluster;
    for (const std::uint32_t vertex : indices.subspan(first, std::min(kCorners, indices.size() - first))) {
      cluster.bounds.add(glm::dvec3(positions[vertex]));
    }
    clusters.push_back(cluster);
  }
  return clusters;
}

TriangleMesh ordered(TriangleMesh mesh) {
  if (mesh.indices.empty()) return mesh;
  mesh.indices = spatiallySorted(std::move(mesh.indices), mesh.positions);
  constexpr std::size_t kCorners = std::size_t{3} * kClusterTriangles;
  forEachPiece(mesh.indices.size(), kCorners, [&mesh](std::size_t first, std::size_t last) {
    orderCluster(std::span(mesh.indices).subspan(first, last - first));
  });
  // Every vertex is used by a triangle, so that none is lost.
  std::vector<std::uint32_t> newIndex(mesh.positions.size());
  meshopt_optimizeVertexFetchRemap(newIndex.data(), mesh.indices.data(), mesh.indices.size(), mesh.positions.size());
  meshopt_remapIndexBuffer(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(), newIndex.data());
  mesh.positions = moved(mesh.positions, newIndex);
  mesh.attributes = moved(mesh.attributes, newIndex);
  mesh.sources = moved(mesh.sources, newIndex);
  return mesh;
}

} // namespace gnomon
