#include "renderer/bake/surface_charts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/scene/geometry/welding.h"

namespace gnomon {
namespace {

constexpr double kLeastCosine = 0.70710678118654752; ///< of the normals of a chart's triangles and its first one's
constexpr std::uint32_t kNone = 0xffffffffu;

using Corners = std::array<glm::dvec3, 3>;

struct PlacedMesh {
  std::vector<Corners> corners;
  std::vector<glm::dvec3> areas;                        ///< twice the area, along the normal
  std::vector<std::array<std::uint32_t, 3>> neighbours; ///< kNone where fewer
};

void addNeighbour(std::array<std::uint32_t, 3>& neighbours, std::uint32_t triangle) {
  const auto free = std::find(neighbours.begin(), neighbours.end(), kNone);
  if (free != neighbours.end()) *free = triangle;
}

PlacedMesh placedMesh(const Scene& scene, const Primitive& primitive, const glm::dmat4& worldFromLocal) {
  PlacedMesh mesh;
  const std::size_t count = primitive.indexCount / 3;
  const std::uint32_t* index = scene.indices.data() + primitive.firstIndex;
  const glm::vec3* local = scene.positions.data() + primitive.baseVertex;
  const glm::dmat3 turn(worldFromLocal); // where a chart lies in the world does not matter
  for (std::size_t i = 0; i < count; ++i) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = turn * glm::dvec3(local[index[3 * i + k]]);
    mesh.areas.push_back(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    mesh.corners.push_back(corners);
  }
  mesh.neighbours.resize(count, {kNone, kNone, kNone});
  for (const MeshEdge& edge : meshEdges(scene, primitive)) {
    if (edge.left == kNoTriangle || edge.right == kNoTriangle) continue;
    addNeighbour(mesh.neighbours[edge.left], edge.right);
    addNeighbour(mesh.neighbours[edge.right], edge.left);
  }
  return mesh;
}

/// A base of the plane across `normal` (unit length).
std::array<glm::dvec3, 2> axesAcross(const glm::dvec3& normal) {
  const glm::dvec3 least = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(least, normal));
  return {u, glm::cross(normal, u)};
}

/// Turns a chart so that its box is low: the box of least area has a side along one of the chart's own sides, and the
/// direction of its longest triangle's side is near enough.
void turnLow(std::vector<FlatTriangle>& flat) {
  glm::dvec2 longest(0);
  for (const FlatTriangle& t : flat) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 side = t[(k + 1) % 3] - t[k];
      if (glm::dot(side, side) > glm::dot(longest, longest)) longest = side;
    }
  }
  const double length = glm::length(longest);
  if (!(length > 0)) return;
  const glm::dvec2 along = longest / length;
  for (FlatTriangle& t : flat) {
    for (glm::dvec2& p : t) p = {glm::dot(along, p), along.x * p.y - along.y * p.x};
  }
}

void moveToOrigin(SurfaceChart& chart) {
  glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
  for (const FlatTriangle& t : chart.flat) {
    for (const glm::dvec2& p : t) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  for (FlatTriangle& t : chart.flat) {
    for (glm::dvec2& p : t) p -= low;
  }
  chart.size = high - low;
}

SurfaceChart laidFlat(const PlacedMesh& mesh, std::vector<std::uint32_t> triangles) {
  SurfaceChart chart;
  glm::dvec3 sum(0);
  for (const std::uint32_t i : triangles) sum += mesh.areas[i];
  const auto axes = axesAcross(glm::normalize(sum));
  for (const std::uint32_t i : triangles) {
    FlatTriangle flat;
    for (std::size_t k = 0; k < 3; ++k) {
      flat[k] = {glm::dot(axes[0], mesh.corners[i][k]), glm::dot(axes[1], mesh.corners[i][k])};
    }
    chart.flat.push_back(flat);
  }
  chart.triangles = std::move(triangles);
  turnLow(chart.flat);
  moveToOrigin(chart);
  return chart;
}

/// A piece may wind over itself, as a spiral stair does; then it is halved until none does.
void addWithoutFolds(const PlacedMesh& mesh, std::vector<std::uint32_t> triangles, std::vector<SurfaceChart>& charts) {
  SurfaceChart chart = laidFlat(mesh, triangles);
  const double slack = 1e-9 * std::max(chart.size.x, chart.size.y);
  if (triangles.size() == 1 || !anyOverlap(chart.flat, slack)) {
    charts.push_back(std::move(chart));
    return;
  }
  const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
  addWithoutFolds(mesh, {triangles.begin(), middle}, charts);
  addWithoutFolds(mesh, {middle, triangles.end()}, charts);
}

/// The triangles that are reached from `first` over neighbours that `joins(from, to)` lets in, in that order.
template <class Joins>
std::vector<std::uint32_t> grown(const PlacedMesh& mesh, std::uint32_t first, std::vector<std::uint8_t>& taken,
                                 Joins joins) {
  std::vector<std::uint32_t> piece{first};
  taken[first] = 1;
  for (std::size_t next = 0; next < piece.size(); ++next) {
    const std::uint32_t from = piece[next];
    for (const std::uint32_t to : mesh.neighbours[from]) {
      if (to == kNone || taken[to] != 0 || !joins(from, to)) continue;
      taken[to] = 1;
      piece.push_back(to);
    }
  }
  return piece;
}

/// Of slivers rounding decides which way they are turned, and no pixel shows them.
bool hasArea(const PlacedMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.corners[triangle];
  const double longest = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
  const double area = glm::length(mesh.areas[triangle]);
  return area > 1e-10 * longest * longest && std::isfinite(area);
}

/// The triangles' corners in TEXCOORD_1.
std::vector<FlatTriangle> authoredTriangles(const Scene& scene, const Primitive& primitive) {
  std::vector<FlatTriangle> flat(primitive.indexCount / 3);
  const std::uint32_t* index = scene.indices.data() + primitive.firstIndex;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      flat[i][k] = glm::dvec2(scene.attributes[primitive.baseVertex + index[3 * i + k]].uv1);
    }
  }
  return flat;
}

/// Whether two of them have two corners in common.
bool shareSide(const FlatTriangle& a, const FlatTriangle& b) {
  return std::count_if(a.begin(), a.end(),
                       [&](const glm::dvec2& corner) { return std::find(b.begin(), b.end(), corner) != b.end(); }) >= 2;
}

} // namespace

std::optional<std::vector<SurfaceChart>> authoredChartsOf(const Scene& scene, const Primitive& primitive,
                                                          const glm::dmat4& worldFromLocal) {
  constexpr double kSlack = 1e-6; // of the whole square
  const std::vector<FlatTriangle> authored = authoredTriangles(scene, primitive);
  const PlacedMesh mesh = placedMesh(scene, primitive, worldFromLocal);
  std::vector<std::uint8_t> taken(authored.size());
  double inWorld = 0, inSquare = 0;
  for (std::uint32_t i = 0; i < authored.size(); ++i) {
    for (const glm::dvec2& p : authored[i]) {
      if (!(p.x >= -kSlack && p.x <= 1 + kSlack && p.y >= -kSlack && p.y <= 1 + kSlack)) return std::nullopt;
    }
    if (!hasArea(mesh, i)) {
      taken[i] = 1;
      continue;
    }
    if (signedArea(authored[i]) == 0) return std::nullopt;
    inWorld += glm::length(mesh.areas[i]);
    inSquare += std::abs(signedArea(authored[i]));
  }
  if (anyOverlap(authored, kSlack)) return std::nullopt;
  const double scale = inSquare > 0 ? std::sqrt(inWorld / inSquare) : 1;
  std::vector<SurfaceChart> charts;
  for (std::uint32_t first = 0; first < authored.size(); ++first) {
    if (taken[first] != 0) continue;
    SurfaceChart chart;
    chart.triangles = grown(mesh, first, taken, [&](std::uint32_t from, std::uint32_t to) {
      return shareSide(authored[from], authored[to]);
    });
    for (const std::uint32_t i : chart.triangles) {
      chart.flat.push_back({authored[i][0] * scale, authored[i][1] * scale, authored[i][2] * scale});
    }
    moveToOrigin(chart);
    charts.push_back(std::move(chart));
  }
  return charts;
}

std::vector<SurfaceChart> chartsOf(const Scene& scene, const Primitive& primitive, const glm::dmat4& worldFromLocal) {
  const PlacedMesh mesh = placedMesh(scene, primitive, worldFromLocal);
  std::vector<std::uint8_t> taken(mesh.corners.size());
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < mesh.corners.size(); ++i) {
    if (hasArea(mesh, i)) {
      order.push_back(i);
    } else {
      taken[i] = 1;
    }
  }
  // The largest first: they say best which way a surface is turned.
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return glm::dot(mesh.areas[a], mesh.areas[a]) > glm::dot(mesh.areas[b], mesh.areas[b]);
  });
  std::vector<SurfaceChart> charts;
  for (const std::uint32_t first : order) {
    if (taken[first] != 0) continue;
    const glm::dvec3 normal = glm::normalize(mesh.areas[first]);
    const auto isTurnedLikeFirst = [&](std::uint32_t, std::uint32_t to) {
      return glm::dot(normal, mesh.areas[to]) >= kLeastCosine * glm::length(mesh.areas[to]);
    };
    addWithoutFolds(mesh, grown(mesh, first, taken, isTurnedLikeFirst), charts);
  }
  return charts;
}

} // namespace gnomon
