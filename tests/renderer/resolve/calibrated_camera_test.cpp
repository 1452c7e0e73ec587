// Cameras by a pose and by intrinsics.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/resolve/resolve_camera.h"
#include "tests/renderer/core/random_view.h"

namespace gnomon {
namespace {

constexpr glm::ivec2 kSize{640, 480};

SceneView unitScene() {
  SceneView scene;
  scene.bounds = {glm::dvec3(-1), glm::dvec3(1)};
  return scene;
}

ResolvedCamera resolved(const Camera& camera, const glm::ivec2& size = kSize) {
  const auto found = resolveCamera(camera, unitScene(), size);
  EXPECT_TRUE(found);
  return found ? *found : ResolvedCamera{};
}

Camera posed(const Rows4& worldFromCamera, CameraAxes axes) {
  Camera camera;
  camera.pose = CameraPose{worldFromCamera, axes};
  return camera;
}

/// The matrix of a view: its columns are the camera's axes as the convention has them, and the eye.
Rows4 matrixOf(const CameraView& view, CameraAxes axes) {
  const double sign = axes == CameraAxes::opencv ? -1 : 1;
  Rows4 rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    rows[i] = {view.right[axis], sign * view.up[axis], -sign * view.forward[axis], view.eye[axis]};
  }
  rows[3] = {0, 0, 0, 1};
  return rows;
}

void expectSameView(const CameraView& a, const CameraView& b) {
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.right, b.right);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.forward, b.forward);
  EXPECT_EQ(a.halfSize, b.halfSize);
  EXPECT_EQ(a.center, b.center);
  EXPECT_EQ(a.near, b.near);
  EXPECT_EQ(a.far, b.far);
}

TEST(CameraPose, EitherConventionIsTheLookAtOfTheSameAxes) {
  EXPECT_TRUE(rc::check([](const RandomView& random) {
    const CameraView& view = random.view;
    const auto triple = [](const glm::dvec3& v) { return Vec3{v.x, v.y, v.z}; };
    Camera lookAt;
    lookAt.lookAt = EyeTarget{triple(view.eye), triple(view.eye + view.forward), triple(view.up)};
    const CameraView looking = resolved(lookAt).view;
    for (const CameraAxes axes : {CameraAxes::opengl, CameraAxes::opencv}) {
      const CameraView posing = resolved(posed(matrixOf(view, axes), axes)).view;
      RC_ASSERT(posing.eye == view.eye);
      RC_ASSERT(glm::length(posing.forward - view.forward) < 1e-15);
      RC_ASSERT(glm::length(posing.right - view.right) < 1e-15);
      RC_ASSERT(glm::length(posing.up - view.up) < 1e-15);
      // The target takes digits from the direction: the eye is 1e4 m off.
      RC_ASSERT(glm::length(posing.forward - looking.forward) < 1e-11);
      RC_ASSERT(glm::length(posing.right - looking.right) < 1e-11);
    }
  }));
}

TEST(CameraPose, RoundedAxesAreMadeOrthonormalAroundTheViewAxis) {
  EXPECT_TRUE(rc::check([](const RandomView& random) {
    Rows4 rounded = matrixOf(random.view, CameraAxes::opencv);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) rounded[i][j] = std::round(rounded[i][j] * 1e3) / 1e3;
    }
    const CameraView view = resolved(posed(rounded, CameraAxes::opencv)).view;
    const glm::dmat3 axes(view.right, view.up, -view.forward);
    const glm::dmat3 unit = glm::transpose(axes) * axes;
    for (int i = 0; i < 3; ++i) RC_ASSERT(glm::length(unit[i] - glm::dmat3(1.0)[i]) < 1e-14);
    RC_ASSERT(glm::determinant(axes) > 0);
    const glm::dvec3 along(rounded[0][2], rounded[1][2], rounded[2][2]);
    RC_ASSERT(glm::length(view.forward - glm::normalize(along)) < 1e-15);
  }));
}

TEST(CameraPose, StaysAPoseThatGivesTheSameViewBitForBit) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& shift) {
    Camera camera = posed(matrixOf(random.view, CameraAxes::opencv), CameraAxes::opencv);
    camera.intrinsics = Intrinsics{500.1, 499.7, {}, {}, {}, {}};
    if (shift.value > 0.5) camera.intrinsics->cx = 1e4 * (shift.value - 0.7);
    const ResolvedCamera once = resolved(camera);
    const ResolvedCamera twice = resolved(once.camera);
    RC_ASSERT(once.camera.pose == camera.pose);
    RC_ASSERT(!once.camera.lookAt);
    RC_ASSERT(once.camera == twice.camera);
    expectSameView(once.view, twice.view);
  }));
}

TEST(Intrinsics, AbsentPrincipalPointIsTheMiddleAndIsTold) {
  Camera camera;
  camera.intrinsics = Intrinsics{400, 300, {}, {}, {}, {}};
  const ResolvedCamera found = resolved(camera);
  EXPECT_EQ(found.camera.intrinsics->cx, 319.5);
  EXPECT_EQ(found.camera.intrinsics->cy, 239.5);
  EXPECT_TRUE(found.camera.intrinsics->near);
  EXPECT_FALSE(found.camera.perspective);
  EXPECT_EQ(found.view.center, glm::dvec2(0));
  EXPECT_EQ(found.view.halfSize, glm::dvec2(0.8, 0.8));
}

TEST(Intrinsics, ProjectAsOpenCvDoes) {
  EXPECT_TRUE(rc::check([](const RandomView& random, const RandomUnit& x, const RandomUnit& y, const RandomUnit& d) {
    const auto log10Between = [](double low, double high, double at) { return std::pow(10, low + (high - low) * at); };
    Camera camera = posed(matrixOf(random.view, CameraAxes::opencv), CameraAxes::opencv);
    const double fx = log10Between(1, 5, x.value), fy = log10Between(1, 5, d.value);
    const double cx = 2e4 * (y.value - 0.5), cy = 2e4 * (x.value - 0.5);
    camera.intrinsics = Intrinsics{fx, fy, cx, cy, {}, {}};
    const CameraView view = resolved(camera).view;
    // A point that shows at the pixel whose centre is u, v.
    const double u = x.value * kSize.x - 0.5, v = y.value * kSize.y - 0.5, depth = 0.1 + 50 * d.value;
    const double right = (u - cx) / fx * depth, down = (v - cy) / fy * depth;
    const glm::dvec2 ndc = ndcOf(view, view.right * right - view.up * down + view.forward * depth);
    RC_ASSERT(std::abs((ndc.x + 1) * kSize.x / 2 - 0.5 - u) < 1e-6);
    RC_ASSERT(std::abs((1 - ndc.y) * kSize.y / 2 - 0.5 - v) < 1e-6);
  }));
}

TEST(Intrinsics, AnOrbitFramesTheWholeSceneOffCentreToo) {
  EXPECT_TRUE(rc::check([](const RandomUnit& x, const RandomUnit& y, const RandomUnit& turn) {
    Camera camera;
    camera.orbit = Orbit{{}, 360 * turn.value, 60 * turn.value - 20, {}};
    camera.intrinsics = Intrinsics{500, 700, 20 + 600 * x.value, 20 + 440 * y.value, {}, {}};
    const SceneView scene = unitScene();
    const CameraView view = resolved(camera).view;
    double reach = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
      RC_ASSERT(glm::dot(p - view.eye, view.forward) > 0);
      const glm::dvec2 ndc = glm::abs(ndcOf(view, p - view.eye));
      reach = std::max({reach, ndc.x, ndc.y});
    }
    RC_ASSERT(reach <= 1.0);
    RC_ASSERT(reach > 0.85); // and no farther away than that takes
  }));
}

TEST(Intrinsics, NoDistanceShowsTheWholeSceneWhereTheAxisLiesBesideThePicture) {
  for (const auto& [cx, cy] : {std::pair{-5000.0, 240.0}, {-0.51, 240.0}, {320.0, 479.6}, {320.0, 1e7}}) {
    Camera camera;
    camera.intrinsics = Intrinsics{500, 500, cx, cy, {}, {}};
    const auto refused = resolveCamera(camera, unitScene(), kSize);
    ASSERT_FALSE(refused) << cx << ' ' << cy;
    EXPECT_EQ(refused.problems()[0].pointer, "/camera/orbit/distance");
    camera.orbit = Orbit{{}, 210, 20, 5.0};
    EXPECT_TRUE(resolveCamera(camera, unitScene(), kSize)) << "with a distance it is up to the caller";
  }
}

TEST(Intrinsics, TheWidestAndTheNarrowestLensGiveFiniteViews) {
  for (const double focal : {1e-3, 1e9}) {
    for (const double principal : {-1e7, 0.0, 1e7}) {
      Camera camera;
      camera.orbit = Orbit{{}, 210, 20, 5.0};
      camera.intrinsics = Intrinsics{focal, focal, principal, -principal, {}, {}};
      const CameraView view = resolved(camera, {16384, 1}).view;
      for (const glm::dvec4& plane : frustumOf(view).planes) EXPECT_TRUE(finite(plane));
      EXPECT_TRUE(finite(clipFromView(view)));
      EXPECT_TRUE(finite(ndcOf(view, pointAt(view, {0.5, -0.25}, 3))));
    }
  }
}

} // namespace
} // namespace gnomon
