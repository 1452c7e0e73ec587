#include "tests/bench/bodies_scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "tests/support/glb_builder.h"

namespace gnomon::bench {
namespace {

constexpr double kFloor = 60; // metres along a side
constexpr int kRings = 26;
constexpr int kSegments = 50;

/// A lying torus of 1 m about the origin, so that it throws a shadow with a hole.
int addBody(testing::GlbBuilder& builder) {
  std::vector<testing::Point> positions, normals;
  std::vector<std::uint32_t> indices;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int segment = 0; segment < kSegments; ++segment) {
      const double tube = glm::two_pi<double>() * ring / kRings;
      const double around = glm::two_pi<double>() * segment / kSegments;
      const auto at = [&](double out, double up) {
        return testing::Point{static_cast<float>(out * std::cos(around)), static_cast<float>(up),
                              static_cast<float>(-out * std::sin(around))};
      };
      positions.push_back(at(0.34 + 0.16 * std::cos(tube), 0.16 * std::sin(tube)));
      normals.push_back(at(std::cos(tube), std::sin(tube)));
      const auto index = [](int r, int s) {
        return static_cast<std::uint32_t>(r % kRings * kSegments + s % kSegments);
      };
      for (const auto& [r, s] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}}) {
        indices.push_back(index(ring + r, segment + s));
      }
    }
  }
  const int position = builder.addPoints(positions);
  const int normal = builder.addPoints(normals);
  return builder.addMesh(
      {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", builder.addIndices(indices)}});
}

testing::GlbBuilder bodies(int side) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {0.5 * kFloor, 1, 0.5 * kFloor};
  const int body = addBody(builder);
  const double cell = kFloor / side;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = (column + 0.5) * cell - 0.5 * kFloor;
      const double z = (row + 0.5) * cell - 0.5 * kFloor;
      const double tilt = 0.35 * std::sin(12.9898 * column + 78.233 * row);
      builder.addRoot({{"mesh", body},
                       {"translation", {x, 0.4 * cell, z}},
                       {"rotation", {std::sin(tilt), 0, 0, std::cos(tilt)}},
                       {"scale", {cell, cell, cell}}});
    }
  }
  const int lens = builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
  const double down = 0.5 * std::asin(0.5);
  builder.addRoot({{"name", "camera"},
                   {"camera", lens},
                   {"translation", {0, 24, 42}},
                   {"rotation", {-std::sin(down), 0, 0, std::cos(down)}}});
  return builder;
}

} // namespace

Bytes bodiesGlb(int side) {
  return bodies(side).glb();
}

ScenePtr bodiesScene(int side) {
  auto scene = loadScene(bodies(side).bundle());
  if (!scene) throw std::runtime_error(scene.problems().front().detail);
  return *scene;
}

} // namespace gnomon::bench
