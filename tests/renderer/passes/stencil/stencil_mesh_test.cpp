#include "renderer/passes/stencil/stencil_mesh.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <rapidcheck.h>

#include "renderer/passes/stencil/stencil_outlines.h"

namespace gnomon {
namespace {

/// One instance of one primitive, its vertices all at different places.
struct Model {
  Scene scene;
  SceneView view;
  std::vector<EdgeMesh> edges;
};

Model modelOf(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices, bool solid,
              const glm::dmat4& matrix = glm::dmat4(1.0)) {
  Model model;
  model.scene.positions = positions;
  model.scene.indices = indices;
  model.scene.welded = indices;
  Primitive primitive;
  primitive.vertexCount = static_cast<std::uint32_t>(positions.size());
  primitive.indexCount = static_cast<std::uint32_t>(indices.size());
  primitive.clusterCount = 1;
  primitive.solid = solid;
  for (const glm::vec3& position : positions) primitive.bounds.add(glm::dvec3(position));
  model.scene.primitives.push_back(primitive);
  model.scene.clusters.push_back({primitive.bounds});
  model.scene.nodes.resize(1);
  Instance instance;
  instance.worldFromLocal = matrix;
  instance.bounds = transformed(matrix, primitive.bounds);
  model.view.instances.push_back(instance);
  model.view.bounds = instance.bounds;
  model.edges = edgeMeshes(model.scene);
  return model;
}

const std::vector<glm::vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
const std::vector<std::uint32_t> kTetrahedron = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

CameraView cameraAt(const glm::dvec3& eye, bool perspective = true) {
  CameraView camera;
  camera.eye = eye;
  camera.perspective = perspective;
  if (!perspective) camera.far = 100;
  return camera;
}

StencilMesh meshOf(const Model& model, const CameraView& camera, const glm::dvec4& light, StencilCaps caps) {
  const StencilCaster caster{0, {caps}};
  return stencilMesh(model.scene, model.view, camera, light, {&caster, 1}, model.edges);
}

using Place = std::array<float, 4>;

Place placeOf(const glm::vec4& place) {
  return {place.x, place.y, place.z, place.w};
}

/// How much more often each pair of places is walked one way than the other, by all triangles of a mesh.
std::map<std::pair<Place, Place>, int> balance(const Model& model, const StencilMesh& mesh) {
  std::map<std::pair<Place, Place>, int> sums;
  const auto addTriangle = [&](const Place& a, const Place& b, const Place& c) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      if (from < to) ++sums[{from, to}];
      if (to < from) --sums[{to, from}];
    }
  };
  const auto& walls = mesh.walls.indices;
  for (std::size_t i = 0; i < walls.size(); i += 3) {
    addTriangle(placeOf(mesh.places[walls[i]]), placeOf(mesh.places[walls[i + 1]]), placeOf(mesh.places[walls[i + 2]]));
  }
  const auto corner = [&](std::uint32_t vertex) { return placeOf(glm::vec4(model.scene.positions[vertex], -1.0f)); };
  for (const StencilEnds* ends : {&mesh.caps, &mesh.awayCaps}) {
    for (const int side : {0, 1}) {
      const auto& caps = ends->sides[side].indices;
      for (std::size_t i = 0; i < caps.size(); i += 3) {
        const std::size_t second = side == 0 ? 1 : 2; // those turned the other way bound the volume from behind
        addTriangle(corner(caps[i]), corner(caps[i + second]), corner(caps[i + 3 - second]));
      }
    }
  }
  return sums;
}

glm::dvec4 anyLight() {
  const auto place = [] { return 0.1 * *rc::gen::inRange(-40, 41); };
  const glm::dvec4 light(place(), place(), place(), *rc::gen::element(0.0, 1.0));
  RC_PRE(light.w > 0 || glm::length(glm::dvec3(light)) > 0);
  return light.w > 0 ? light : glm::dvec4(glm::normalize(glm::dvec3(light)), 0.0);
}

TEST(StencilMesh, N3_VolumesOfAnythingAreClosed) {
  EXPECT_TRUE(rc::check([] {
    auto indices = *rc::gen::container<std::vector<std::uint32_t>>(
        static_cast<std::size_t>(3 * *rc::gen::inRange(1, 12)), rc::gen::inRange<std::uint32_t>(0, 5));
    const Model model = modelOf(kCorners, indices, false);
    const StencilMesh mesh =
        meshOf(model, cameraAt({1, 2, 3}, *rc::gen::arbitrary<bool>()), anyLight(), StencilCaps::all);
    for (const auto& [edge, sum] : balance(model, mesh)) RC_ASSERT(sum == 0);
  }));
}

TEST(StencilMesh, N3_PiecesOfASolidAreClosedEachByItsOwnRule) {
  EXPECT_TRUE(rc::check([] {
    std::vector<glm::vec3> positions(kCorners);
    std::vector<std::uint32_t> indices(kTetrahedron);
    for (const glm::vec3& corner : kCorners) positions.push_back(corner + glm::vec3(1.5f, 0.25f, 0));
    for (const std::uint32_t index : kTetrahedron) indices.push_back(index + 5);
    glm::dmat4 matrix(1.0);
    matrix[0][0] = *rc::gen::element(1.0, -1.0);
    const Model model = modelOf(positions, indices, true, matrix);
    const auto caps = [] {
      return *rc::gen::element(StencilCaps::turnedTo, StencilCaps::turnedAway, StencilCaps::all);
    };
    const StencilCaster caster{0, {caps(), caps()}};
    const CameraView camera = cameraAt({1, 2, 3}, *rc::gen::arbitrary<bool>());
    const StencilMesh mesh = stencilMesh(model.scene, model.view, camera, anyLight(), {&caster, 1}, model.edges);
    for (const auto& [edge, sum] : balance(model, mesh)) RC_ASSERT(sum == 0);
  }));
}

TEST(StencilMesh, OnlyTheTrianglesThatThrowItBoundAVolume) {
  const glm::dvec4 light(-1, -1, -1, 1); // sees the three faces at the origin, not the slanted one
  const Model model = modelOf(kCorners, kTetrahedron, true);
  const StencilMesh to = meshOf(model, cameraAt({9, 9, 9}), light, StencilCaps::turnedTo);
  EXPECT_EQ(to.caps.sides[0].indices, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 2, 0, 3}));
  EXPECT_TRUE(to.caps.sides[1].indices.empty());
  const StencilMesh away = meshOf(model, cameraAt({9, 9, 9}), light, StencilCaps::turnedAway);
  EXPECT_TRUE(away.caps.sides[1].indices.empty());
  EXPECT_TRUE(away.awayCaps.sides[0].indices.empty());
  EXPECT_EQ(away.awayCaps.sides[1].indices, (std::vector<std::uint32_t>{1, 2, 3}));
  EXPECT_EQ(away.walls.indices.size(), 3u * (3 * 2 + 1)) << "three walls, and the far end";
  glm::dmat4 mirror(1.0);
  mirror[0][0] = -1;
  const Model mirrored = modelOf(kCorners, kTetrahedron, true, mirror);
  EXPECT_EQ(meshOf(mirrored, cameraAt({9, 9, 9}), {1, -1, -1, 1}, StencilCaps::turnedAway).awayCaps.sides[0].indices,
            (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST(StencilMesh, TheSunsVolumesMeetAtInfinity) {
  const Model model = modelOf(kCorners, kTetrahedron, true);
  const glm::dvec4 sun(0, 1, 0, 0);
  const StencilMesh mesh = meshOf(model, cameraAt({9, 9, 9}), sun, StencilCaps::turnedAway);
  EXPECT_EQ(mesh.walls.indices.size(), 3u * 3);
  for (const glm::vec4& place : mesh.places) {
    EXPECT_TRUE(place.w < 0 || place == glm::vec4(0, -1, 0, 0));
  }
  const StencilMesh parallel = meshOf(model, cameraAt({9, 9, 9}, false), sun, StencilCaps::turnedAway);
  EXPECT_EQ(parallel.walls.indices.size(), 3u * (3 * 2 + 1)) << "under parallel rays, they never do";
}

TEST(StencilMesh, ALightOnAVertexGivesNumbers) {
  const Model model = modelOf(kCorners, kTetrahedron, true);
  for (const bool perspective : {true, false}) {
    const StencilMesh mesh = meshOf(model, cameraAt({9, 9, 9}, perspective), {0, 0, 0, 1}, StencilCaps::turnedAway);
    for (const glm::vec4& place : mesh.places) {
      for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(place[i]));
      EXPECT_GT(glm::length(place), 0.0f);
    }
  }
}

TEST(StencilMesh, WhatReachesBehindTheFarPlaneIsThereTwice) {
  const Model model = modelOf(kCorners, kTetrahedron, false);
  CameraView camera = cameraAt({0.2, 0.2, 5});
  const auto beyond = [&](double far) {
    camera.far = far;
    const StencilMesh mesh = meshOf(model, camera, {0.3, 0.2, 5, 1}, StencilCaps::all);
    return mesh.caps.beyond[0].indices.size() + mesh.caps.beyond[1].indices.size();
  };
  EXPECT_EQ(beyond(std::numeric_limits<double>::infinity()), 0u);
  EXPECT_EQ(beyond(6), 0u);
  EXPECT_EQ(beyond(4.5), 3u * 4);
}

std::vector<StencilCaster> castersOf(const Model& model, const CameraView& camera, const Light& light,
                                     const NodeSwitches& node = {}) {
  const FrameGeometry geometry = frameGeometry(model.scene, model.view, camera.eye);
  return stencilCasters(model.scene, model.view, geometry, camera, light, model.edges, {&node, 1});
}

Light pointAt(const Vec3& position) {
  Light light;
  light.type = LightType::point;
  light.position = position;
  return light;
}

TEST(VolumeCasters, TheInsideOfASolidCountsWhereItMayBeSeen) {
  const Model solid = modelOf(kCorners, kTetrahedron, true);
  const CameraView outside = cameraAt({0, 0, 9});
  const auto capsOf = [](const std::vector<StencilCaster>& casters) { return casters.at(0).caps.at(0); };
  EXPECT_EQ(capsOf(castersOf(solid, outside, pointAt({3, 3, 3}))), StencilCaps::turnedAway);
  NodeSwitches hidden;
  hidden.visible = false;
  EXPECT_EQ(capsOf(castersOf(solid, outside, pointAt({3, 3, 3}), hidden)), StencilCaps::turnedTo);
  EXPECT_EQ(capsOf(castersOf(solid, cameraAt({0.2, 0.2, 0.2}), pointAt({3, 3, 3}))), StencilCaps::turnedTo);
  const Model open = modelOf(kCorners, kTetrahedron, false);
  EXPECT_EQ(capsOf(castersOf(open, outside, pointAt({3, 3, 3}))), StencilCaps::all);
  glm::dmat4 flat(1.0);
  flat[1][1] = 0;
  EXPECT_EQ(capsOf(castersOf(modelOf(kCorners, kTetrahedron, true, flat), outside, pointAt({3, 3, 3}))),
            StencilCaps::all);
}

TEST(VolumeCasters, EachPieceOfASolidIsOneForItself) {
  std::vector<glm::vec3> positions(kCorners);
  std::vector<std::uint32_t> indices(kTetrahedron);
  for (const glm::vec3& corner : kCorners) positions.push_back(corner + glm::vec3(10, 0, 0));
  for (const std::uint32_t index : kTetrahedron) indices.push_back(index + 5);
  const Model two = modelOf(positions, indices, true);
  using Caps = std::vector<StencilCaps>;
  const auto capsOf = [&](const glm::dvec3& eye, const Vec3& lamp, const NodeSwitches& node = {}) {
    return castersOf(two, cameraAt(eye), pointAt(lamp), node).at(0).caps;
  };
  const Vec3 inFirst{0.2, 0.2, 0.2};
  const Vec3 between{5, 0.5, 0.5};
  EXPECT_EQ(capsOf({5, 0.5, 0.5}, inFirst), (Caps{StencilCaps::turnedAway, StencilCaps::turnedAway}));
  EXPECT_EQ(capsOf({0.3, 0.2, 0.2}, inFirst), (Caps{StencilCaps::all, StencilCaps::turnedAway}));
  EXPECT_EQ(capsOf({0.3, 0.2, 0.2}, between), (Caps{StencilCaps::turnedTo, StencilCaps::turnedAway}));
  EXPECT_EQ(capsOf({10.3, 0.2, 0.2}, inFirst), (Caps{StencilCaps::turnedAway, StencilCaps::turnedTo}));
  NodeSwitches hidden;
  hidden.visible = false;
  EXPECT_EQ(capsOf({5, 0.5, 0.5}, inFirst, hidden), (Caps{StencilCaps::all, StencilCaps::turnedTo}));
}

TEST(VolumeCasters, WhatCannotMatterIsLeftOut) {
  const Model model = modelOf(kCorners, kTetrahedron, true);
  const CameraView camera = cameraAt({0, 0, 9});
  NodeSwitches idle;
  idle.castShadow = false;
  EXPECT_TRUE(castersOf(model, camera, pointAt({3, 3, 3}), idle).empty());
  NodeSwitches other;
  other.layers = 2;
  Light light = pointAt({3, 3, 3});
  light.cullingMask = 1;
  EXPECT_TRUE(castersOf(model, camera, light, other).empty());
  light.range = 2;
  EXPECT_TRUE(castersOf(model, camera, light).empty()) << "out of its range";
  light.range = 4;
  EXPECT_EQ(castersOf(model, camera, light).size(), 1u);

  const CameraView turned = cameraAt({0, 0, -9}); // looks away from the caster
  EXPECT_TRUE(castersOf(model, turned, pointAt({0, 0, -20})).empty()) << "its shadow falls behind the camera";
  EXPECT_EQ(castersOf(model, turned, pointAt({0, 0, 20})).size(), 1u) << "its shadow falls before the camera";
  Light sun;
  sun.direction = Vec3{0, 0, 1};
  EXPECT_TRUE(castersOf(model, turned, sun).empty());
  sun.direction = Vec3{0, -0.01, -1};
  EXPECT_EQ(castersOf(model, turned, sun).size(), 1u);
}

} // namespace
} // namespace gnomon
