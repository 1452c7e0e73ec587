#include <algorithm>
#include <random>
#include <rapidcheck.h>

#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::perspectiveView;
using testing::Point;
using testing::sunAlong;
using testing::Traced;

constexpr int kTriangles = 60;

/// Triangles anywhere in a cube of `size` to either side, seen from both sides; masked ones have an alpha of 0 or 1 at
/// each corner, and holes where it is below 0.5 in between.
GlbBuilder soup(std::mt19937& random, double size, bool masked) {
  std::uniform_real_distribution<double> place(-size, size);
  std::vector<Point> points;
  for (int i = 0; i < 3 * kTriangles; ++i) {
    points.push_back({float(place(random)), float(place(random)), float(place(random))});
  }
  GlbBuilder builder;
  const int positions = builder.addPoints(points);
  builder.add("materials", {{"doubleSided", true}});
  nlohmann::json attributes = {{"POSITION", positions}};
  if (masked) {
    builder.json["materials"][0]["alphaMode"] = "MASK";
    std::vector<std::array<float, 4>> colors;
    for (std::size_t i = 0; i < points.size(); ++i) colors.push_back({1, 1, 1, float(random() % 2)});
    attributes["COLOR_0"] = builder.addAccessor(colors, "VEC4", 5126, colors.size());
  }
  builder.addMeshNode(builder.addMesh({{"attributes", attributes}, {"material", 0}}));
  return builder;
}

/// A triangle as it lies in the scene, relative to its anchor, and the alpha of its corners.
struct Corners {
  glm::dvec3 a, b, c, alpha;
};

std::vector<Corners> trianglesOf(const Traced& traced) {
  const Scene& scene = traced.scene.scene();
  std::vector<Corners> triangles;
  for (const Instance& instance : traced.scene.view().instances) {
    const Primitive& primitive = scene.primitives[std::size_t(instance.primitive)];
    const auto corner = [&](std::size_t k) {
      const glm::dvec3 local(scene.positions[primitive.baseVertex + scene.indices[primitive.firstIndex + k]]);
      return glm::dvec3(instance.worldFromLocal * glm::dvec4(local, 1)) - traced.anchor();
    };
    const auto alpha = [&](std::size_t k) {
      return scene.attributes[primitive.baseVertex + scene.indices[primitive.firstIndex + k]].color.a / 65535.0;
    };
    for (std::size_t k = 0; k < primitive.indexCount; k += 3) {
      triangles.push_back({corner(k), corner(k + 1), corner(k + 2), {alpha(k), alpha(k + 1), alpha(k + 2)}});
    }
  }
  return triangles;
}

/// How surely a line meets a triangle, in doubles: the least of its three barycentric weights, and of what its alpha
/// has over 0.5; negative outside and in a hole.
struct Meeting {
  double along = 0; // in lengths of `direction`
  double inside = -1;
};

Meeting meeting(const Corners& triangle, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 ab = triangle.b - triangle.a;
  const glm::dvec3 ac = triangle.c - triangle.a;
  const glm::dvec3 p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0) return {};
  const glm::dvec3 from = origin - triangle.a;
  const glm::dvec3 q = glm::cross(from, ab);
  const double u = glm::dot(from, p) / determinant;
  const double v = glm::dot(direction, q) / determinant;
  const double alpha = glm::dot(triangle.alpha, glm::dvec3(1 - u - v, u, v));
  return {glm::dot(ac, q) / determinant, std::min({u, v, 1 - u - v, alpha - 0.5})};
}

constexpr double kBand = 1e-4; ///< of weights and lengths: far more than floats lose here

enum class Answer { no, yes, tooClose };

/// Whether something lies on the way from `origin` (in triangle `own`) as far as `reach`, if that is beyond rounding.
Answer blocked(const std::vector<Corners>& triangles, std::size_t own, const glm::dvec3& origin,
               const glm::dvec3& direction, double reach, double size) {
  Answer answer = Answer::no;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (i == own) continue;
    const Meeting met = meeting(triangles[i], origin, direction);
    if (met.inside < -kBand || met.along < -kBand * size || met.along > reach + kBand * size) continue;
    if (met.inside > kBand && met.along > kBand * size && met.along < reach - kBand * size) return Answer::yes;
    answer = Answer::tooClose;
  }
  return answer;
}

TEST(Soup, IsSeenAndLitAsABruteForceTracerInDoublesSays) {
  EXPECT_TRUE(rc::check([] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const double size = *rc::gen::element(1e-6, 1.0, 1e9);
    GlbBuilder builder = soup(random, size, *rc::gen::arbitrary<bool>());
    const double far = *rc::gen::element(0.0, 1e6, 1e7);
    if (size == 1.0) builder.json["nodes"][0]["translation"] = {far, -far, 0.5 * far};
    Traced traced(builder);
    const std::vector<Corners> triangles = trianglesOf(traced);
    traced.width = traced.height = 24;
    traced.camera = perspectiveView(traced.anchor() + glm::dvec3(1, 1.5, 4) * size, traced.anchor(), 50);
    std::uniform_real_distribution<double> place(-1, 1);
    const glm::dvec3 sun(place(random), place(random), place(random));
    const glm::dvec3 lamp = glm::dvec3(place(random), place(random), place(random)) * size;
    traced.lights = {sunAlong(sun), testing::pointAt(lamp + traced.anchor())};

    const std::vector<SurfacePoint> points = traced.surface();
    const glm::dvec3 eye = traced.camera.eye - traced.anchor();
    const std::size_t none = triangles.size();
    int compared = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const SurfacePoint& point = points[i];
      if (point.instance == kNoSurface) {
        const glm::dvec2 ndc((2.0 * double(i % 24) + 1) / 24 - 1, 1 - (2.0 * double(i / 24) + 1) / 24);
        const glm::dvec3 direction = gnomon::pointAt(traced.camera, ndc, 1);
        RC_ASSERT(blocked(triangles, none, eye, direction, 1e6 * size, size) != Answer::yes);
        continue;
      }
      const glm::dvec3 away = point.position - eye;
      const double depth = glm::length(away);
      RC_ASSERT(meeting(triangles[point.triangle], eye, away).inside > -kBand);
      RC_ASSERT(blocked(triangles, point.triangle, eye, away / depth, depth, size) != Answer::yes);
      for (int light = 0; light < 2; ++light) {
        if (facesLight(traced.input(), light, std::span(&point, 1))[0] == 0) continue;
        const glm::dvec3 way = light == 0 ? -glm::normalize(sun) : lamp - point.position;
        const double length = glm::length(way);
        const Answer answer =
            blocked(triangles, point.triangle, point.position, way / length, light == 0 ? 1e6 * size : length, size);
        if (answer == Answer::tooClose) continue;
        ++compared;
        RC_ASSERT(lightVisibility(traced.input(), light, std::span(&point, 1), 1)[0] ==
                  (answer == Answer::yes ? 0.0f : 1.0f));
      }
    }
    RC_ASSERT(compared > 0);
  }));
}

} // namespace
} // namespace gnomon
