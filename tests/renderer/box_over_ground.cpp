#include "tests/renderer/box_over_ground.h"

#include <cmath>
#include <limits>

namespace gnomon::testing {
namespace {

Json triple(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

/// Metres along the ray to where it enters the box; infinite where it misses.
double entersBox(const glm::dvec3& start, const glm::dvec3& way, const BoxOverGround& scene) {
  const glm::dvec3 a = (scene.low - start) / way;
  const glm::dvec3 b = (scene.high - start) / way;
  const glm::dvec3 first = glm::min(a, b);
  const glm::dvec3 last = glm::max(a, b);
  const double enter = std::max({first.x, first.y, first.z});
  const double leave = std::min({last.x, last.y, last.z});
  return enter <= leave && leave > 0 ? enter : std::numeric_limits<double>::infinity();
}

} // namespace

GlbBuilder BoxOverGround::builder() const {
  GlbBuilder builder = plane();
  builder.json["nodes"][0].update({{"name", "ground"}, {"scale", {ground, 1, ground}}});
  const auto x0 = static_cast<float>(low.x), y0 = static_cast<float>(low.y), z0 = static_cast<float>(low.z);
  const auto x1 = static_cast<float>(high.x), y1 = static_cast<float>(high.y), z1 = static_cast<float>(high.z);
  const int position = builder.addPoints(
      {{x0, y0, z0}, {x1, y0, z0}, {x0, y1, z0}, {x1, y1, z0}, {x0, y0, z1}, {x1, y0, z1}, {x0, y1, z1}, {x1, y1, z1}});
  const int indices = builder.addShortIndices(
      {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 4, 6, 2, 1, 3, 5, 5, 3, 7, 2, 6, 3, 3, 6, 7, 0, 1, 4, 1, 5, 4});
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}}));
  return builder;
}

Json Sight::camera() const {
  Json camera = {{"eye", triple(eye)}, {"target", triple(target)}};
  if (fovYDegrees > 0) {
    camera["perspective"] = {{"fovYDegrees", fovYDegrees}};
  } else {
    camera["orthographic"] = {{"height", height}, {"near", 0}, {"far", far}};
  }
  return camera;
}

std::vector<Shown> shownOf(const BoxOverGround& scene, const Sight& sight, const Source& source) {
  const glm::dvec3 forward = glm::normalize(sight.target - sight.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  const bool perspective = sight.fovYDegrees > 0;
  const double half = perspective ? std::tan(glm::radians(sight.fovYDegrees) / 2) : sight.height / 2;
  std::vector<Shown> shown;
  for (int row = 0; row < sight.rows; ++row) {
    for (int column = 0; column < sight.width; ++column) {
      const double x = (2 * column + 1.0 - sight.width) / sight.rows * half;
      const double y = (sight.rows - 2 * row - 1.0) / sight.rows * half;
      const glm::dvec3 across = right * x + up * y;
      const glm::dvec3 start = perspective ? sight.eye : sight.eye + across;
      const glm::dvec3 way = perspective ? forward + across : forward;
      const double toGround = -start.y / way.y;
      const glm::dvec3 point = start + way * toGround;
      const bool onGround = toGround > 0 && std::abs(point.x) <= scene.ground && std::abs(point.z) <= scene.ground;
      if (!onGround || entersBox(start, way, scene) < toGround) {
        shown.push_back(Shown::other);
        continue;
      }
      const glm::dvec3 toLight = source.lamp ? source.at - point : source.at;
      const double enters = entersBox(point, toLight, scene);
      shown.push_back(enters < (source.lamp ? 1.0 : HUGE_VAL) ? Shown::shadowed : Shown::lit);
    }
  }
  return shown;
}

std::vector<Shown> shownOf(const Frame& frame) {
  const std::vector<float>& shadow = floatsOf(frame, 0);
  const std::vector<float>& ids = floatsOf(frame, 1);
  std::vector<Shown> shown;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    shown.push_back(ids[i] != 0 ? Shown::other : shadow[i] < 0.5f ? Shown::shadowed : Shown::lit);
  }
  return shown;
}

GroundCounts countsOf(const std::vector<Shown>& shown) {
  GroundCounts counts;
  for (const Shown each : shown) {
    counts.ground += each != Shown::other ? 1 : 0;
    counts.shadowed += each == Shown::shadowed ? 1 : 0;
  }
  return counts;
}

int differing(const std::vector<Shown>& a, const std::vector<Shown>& b) {
  EXPECT_EQ(a.size(), b.size());
  int count = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) count += a[i] != b[i] ? 1 : 0;
  return count;
}

Frame shadowFrame(const ScenePtr& scene, const Sight& sight, Json spec) {
  spec["width"] = sight.width;
  spec["height"] = sight.rows;
  spec["camera"] = sight.camera();
  spec["antialiasing"] = "none";
  spec["views"] = {"shadow", "ids"};
  spec["output"] = {{"format", "exr"}, {"exrPixelType", "float"}};
  return renderJson(scene, spec.dump());
}

} // namespace gnomon::testing
