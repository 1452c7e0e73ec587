// Why point lights have six faces and not two paraboloids (row X33): a paraboloid is projected at the vertices, and
// between them a straight edge is drawn straight where its true picture is bent.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/shadow/light_draft.h"

namespace gnomon {
namespace {

/// x, y in -1..1 of a direction in front (z > 0), on the paraboloid (Brabec, Annen and Seidel, "Shadow Mapping for
/// Hemispherical and Omnidirectional Light Sources", 2002).
glm::dvec2 onParaboloid(const glm::dvec3& point) {
  const glm::dvec3 d = glm::normalize(point);
  return glm::dvec2(d) / (1.0 + d.z);
}

glm::dvec2 onFace(const LightFace& face, const glm::dvec3& point) {
  const glm::dvec3 ls = face.basis.lightFromWorld() * point;
  return glm::dvec2(ls) / (ls.z * face.tanHalf);
}

/// Texels of a tile between where an edge from `a` to `b` is drawn and where its points belong, at most.
template <class Project>
double bend(const glm::dvec3& a, const glm::dvec3& b, double tileSize, Project project) {
  const glm::dvec2 first = project(a);
  const glm::dvec2 along = glm::normalize(project(b) - first);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const glm::dvec2 off = project(glm::mix(a, b, i / 1000.0)) - first;
    worst = std::max(worst, std::abs(off.x * along.y - off.y * along.x));
  }
  return worst * tileSize / 2;
}

TEST(DualParaboloid, X33_ItsStraightEdgesMissTheirPlaceByManyTexelsWhereThoseOfAFaceDoNot) {
  ShadowCaster light;
  light.type = LightType::point;
  const LightFace front = facesOf(light).front();
  // An upright edge of a wall, 2 m before the light and 1 m to its side.
  const auto paraboloid = [](double half) { return bend({1, -half, 2}, {1, half, 2}, 512, onParaboloid); };
  EXPECT_GT(paraboloid(4.0), 20) << "8 m high";
  EXPECT_GT(paraboloid(1.0), 2.5) << "2 m high";
  EXPECT_LT(paraboloid(0.5), 1) << "1 m high: only of such triangles would it be right to a texel";

  const glm::dmat3 worldFromLight(front.basis.right, front.basis.up, front.basis.direction);
  EXPECT_LT(bend(worldFromLight * glm::dvec3(1, -4, 2), worldFromLight * glm::dvec3(1, 4, 2), 512,
                 [&](const glm::dvec3& p) { return onFace(front, p); }),
            1e-9);
}

} // namespace
} // namespace gnomon
