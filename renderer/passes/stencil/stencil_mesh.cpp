#include "renderer/passes/stencil/stencil_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon {
namespace {

constexpr float kOwnSpace = -1.0f;

/// Ends what a volume mesh's list holds of one instance.
void endDraw(IndexedDraws& draws, std::size_t firstIndex, std::int32_t baseVertex, std::uint32_t instance) {
  const std::size_t count = draws.indices.size() - firstIndex;
  if (count == 0) return;
  draws.ranges.push_back(
      {static_cast<std::uint32_t>(count), 1, static_cast<std::uint32_t>(firstIndex), baseVertex, instance});
}

/// Which triangles cast, of the piece that triangle `t` is part of.
StencilCaps capsAt(const StencilCaster& caster, const EdgeMesh& mesh, std::size_t t) {
  return caster.caps.size() == 1 ? caster.caps.front() : caster.caps[mesh.pieceOf[t]];
}

/// The triangles of a caster that cast its shadow: how each is turned to the light, 0 = it does not.
std::vector<std::int8_t> throwers(const Scene& scene, const Instance& instance, const glm::dvec4& light,
                                  const StencilCaster& caster, const EdgeMesh& mesh) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  std::vector<std::int8_t> turns = facings(scene, primitive, instance.worldFromLocal, light);
  const bool mirrored = glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    const StencilCaps caps = capsAt(caster, mesh, t);
    const std::int8_t wanted = (caps == StencilCaps::turnedTo) != mirrored ? 1 : -1;
    if (caps != StencilCaps::all && turns[t] != wanted) turns[t] = 0;
  }
  return turns;
}

/// Where one caster's volume ends: infinitely far from the light. Under an orthographic camera it ends behind all that
/// there is to be seen instead, since rays that run along the light would meet it at infinity only.
class FarEnds {
 public:
  /// `distance`: metres from the light, from the caster for a directional one; absent = infinite.
  FarEnds(const glm::dvec3& eye, const glm::dvec4& light, std::optional<double> distance)
      : eye_(eye), light_(light), distance_(distance) {}

  /// Every point's is the same one, so that nothing need be closed there.
  bool meet() const { return light_.w == 0 && !distance_; }

  /// Homogeneous, relative to the eye.
  glm::vec4 of(const glm::dvec3& world) const {
    const glm::dvec3 away = awayFrom(light_, world);
    if (away == glm::dvec3(0.0)) return glm::vec4(world - eye_, 1.0); // the light is on it: its shadow goes nowhere
    if (!distance_) return glm::vec4(away, 0.0);
    const glm::dvec3 from = light_.w == 0 ? world : glm::dvec3(light_);
    return glm::vec4(from + away * *distance_ - eye_, 1.0);
  }

  /// The direction, unit length, that light takes at a point; 0 where the light is.
  static glm::dvec3 awayFrom(const glm::dvec4& light, const glm::dvec3& world) {
    const glm::dvec3 away = light.w * world - glm::dvec3(light);
    const double length = glm::length(away);
    return length > 0 ? away / length : glm::dvec3(0.0);
  }

 private:
  glm::dvec3 eye_;
  glm::dvec4 light_;
  std::optional<double> distance_;
};

/// How near to its light a far end of three corners comes, as a share of their distance: the far end is flat.
double sag(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const auto least = [&](const glm::dvec3& axis) {
    const double length = glm::length(axis);
    return length > 0 ? std::min({glm::dot(axis, a), glm::dot(axis, b), glm::dot(axis, c)}) / length : 0.0;
  };
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  return std::max({least(normal), least(-normal), least(a + b + c)});
}

/// How far a caster's volume must reach so that its end lies behind the whole scene.
double farEnough(const Scene& scene, const SceneView& view, const Instance& instance, const glm::dvec4& light,
                 std::span<const std::int8_t> turns) {
  Aabb bounds = view.bounds;
  if (scene.ground) bounds.add(view.instances.back().bounds);
  const double radius = glm::length(bounds.halfExtent());
  if (light.w == 0) return 4 * radius;
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  double least = 1;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    if (turns[t] == 0) continue;
    const auto away = [&](std::size_t corner) {
      const std::uint32_t vertex = primitive.baseVertex + scene.welded[primitive.firstIndex + 3 * t + corner];
      return FarEnds::awayFrom(light, glm::dvec3(instance.worldFromLocal * glm::dvec4(scene.positions[vertex], 1.0)));
    };
    least = std::min(least, sag(away(0), away(1), away(2)));
  }
  constexpr double kLeast = 1e-6; // nothing that casts a shadow is seen more edge-on (facings)
  return 2 * (radius + glm::length(glm::dvec3(light) - bounds.center())) / std::max(least, kLeast);
}

/// The places of one caster's walls: two for each vertex that they touch, the near end and the far one.
class Places {
 public:
  Places(std::vector<glm::vec4>& places, const Scene& scene, const Primitive& primitive, const Instance& instance,
         const FarEnds& farEnds)
      : places_(places),
        positions_(std::span(scene.positions).subspan(primitive.baseVertex, primitive.vertexCount)),
        world_(instance.worldFromLocal),
        farEnds_(farEnds),
        first_(places.size()),
        found_(primitive.vertexCount, kNone) {}

  std::int32_t base() const { return static_cast<std::int32_t>(first_); }

  /// The near end of a vertex (welded), relative to base(); the far one follows it.
  std::uint32_t of(std::uint32_t vertex) {
    if (found_[vertex] == kNone) {
      const glm::vec3& position = positions_[vertex];
      found_[vertex] = static_cast<std::uint32_t>(places_.size() - first_);
      places_.push_back(glm::vec4(position, kOwnSpace));
      places_.push_back(farEnds_.of(glm::dvec3(world_ * glm::dvec4(position, 1.0))));
    }
    return found_[vertex];
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  std::vector<glm::vec4>& places_;
  std::span<const glm::vec3> positions_;
  const glm::dmat4& world_;
  const FarEnds& farEnds_;
  std::size_t first_;
  std::vector<std::uint32_t> found_;
};

/// Which of a primitive's vertices lie behind the camera's far plane; none where it has none.
std::vector<std::uint8_t> beyondFar(const Scene& scene, const Primitive& primitive, const Instance& instance,
                                    const CameraView& camera) {
  const auto depth = [&](const glm::dvec3& world) { return glm::dot(camera.forward, world - camera.eye); };
  const double deepest =
      depth(instance.bounds.center()) + glm::dot(glm::abs(camera.forward), instance.bounds.halfExtent());
  // A little before the plane is also well: floats may see it there.
  const double plane = drawnFar(camera) - 1e-5 * std::abs(drawnFar(camera) - drawnNear(camera));
  if (std::isinf(camera.far) || deepest < plane - 1e-5 * std::abs(deepest)) return {};
  std::vector<std::uint8_t> beyond(primitive.vertexCount);
  for (std::uint32_t i = 0; i < primitive.vertexCount; ++i) {
    const glm::dvec4 local(scene.positions[primitive.baseVertex + i], 1.0);
    beyond[i] = depth(glm::dvec3(instance.worldFromLocal * local)) >= plane ? 1 : 0;
  }
  return beyond;
}

void addCaps(const Scene& scene, const StencilCaster& caster, const Instance& instance, const CameraView& camera,
             std::span<const std::int8_t> turns, const EdgeMesh& edges, StencilMesh& mesh) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  const std::vector<std::uint8_t> beyond = beyondFar(scene, primitive, instance, camera);
  const auto baseVertex = static_cast<std::int32_t>(primitive.baseVertex);
  for (const bool away : {false, true}) {
    StencilEnds& ends = away ? mesh.awayCaps : mesh.caps;
    for (const int side : {0, 1}) {
      IndexedDraws& caps = ends.sides[side];
      IndexedDraws& capsBeyond = ends.beyond[side];
      const std::size_t first = caps.indices.size();
      const std::size_t firstBeyond = capsBeyond.indices.size();
      for (std::size_t t = 0; t < turns.size(); ++t) {
        if (turns[t] != (side == 0 ? 1 : -1) || (capsAt(caster, edges, t) == StencilCaps::turnedAway) != away) continue;
        const auto corners = std::span(scene.welded).subspan(primitive.firstIndex + 3 * t, 3);
        caps.indices.insert(caps.indices.end(), corners.begin(), corners.end());
        if (std::any_of(corners.begin(), corners.end(),
                        [&](std::uint32_t corner) { return !beyond.empty() && beyond[corner] != 0; })) {
          capsBeyond.indices.insert(capsBeyond.indices.end(), corners.begin(), corners.end());
        }
      }
      endDraw(caps, first, baseVertex, caster.instance);
      endDraw(capsBeyond, firstBeyond, baseVertex, caster.instance);
    }
  }
}

void addWalls(const Scene& scene, const StencilCaster& caster, const Instance& instance,
              std::span<const std::int8_t> turns, const FarEnds& farEnds, std::span<const MeshEdge> edges,
              StencilMesh& mesh) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  Places places(mesh.places, scene, primitive, instance, farEnds);
  std::vector<std::uint32_t>& indices = mesh.walls.indices;
  const std::size_t first = indices.size();
  for (const SilhouetteEdge& edge : silhouette(edges, turns)) {
    const std::uint32_t from = places.of(edge.from);
    const std::uint32_t to = places.of(edge.to);
    indices.insert(indices.end(), {to, from, from + 1});
    if (!farEnds.meet()) indices.insert(indices.end(), {to, from + 1, to + 1});
  }
  for (std::size_t t = 0; t < turns.size() && !farEnds.meet(); ++t) {
    if (turns[t] == 0) continue;
    const std::uint32_t* corners = &scene.welded[primitive.firstIndex + 3 * t];
    const std::uint32_t a = places.of(corners[0]) + 1;
    const std::uint32_t b = places.of(corners[1]) + 1;
    const std::uint32_t c = places.of(corners[2]) + 1;
    if (turns[t] > 0) {
      indices.insert(indices.end(), {a, c, b});
    } else {
      indices.insert(indices.end(), {a, b, c});
    }
  }
  endDraw(mesh.walls, first, places.base(), caster.instance);
}

} // namespace

StencilMesh stencilMesh(const Scene& scene, const SceneView& view, const CameraView& camera, const glm::dvec4& light,
                        std::span<const StencilCaster> casters, std::span<const EdgeMesh> edges) {
  StencilMesh mesh;
  for (const StencilCaster& caster : casters) {
    const Instance& instance = view.instances[caster.instance];
    const EdgeMesh& edgeMesh = edges[static_cast<std::size_t>(instance.primitive)];
    const std::vector<std::int8_t> turns = throwers(scene, instance, light, caster, edgeMesh);
    const FarEnds farEnds(
        camera.eye, light,
        camera.perspective ? std::optional<double>{} : farEnough(scene, view, instance, light, turns));
    addCaps(scene, caster, instance, camera, turns, edgeMesh, mesh);
    addWalls(scene, caster, instance, turns, farEnds, edgeMesh.edges, mesh);
  }
  return mesh;
}

} // namespace gnomon
