#include "renderer/reference/error_measures.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/renderer/reference/made_reference.h"

namespace gnomon {
namespace {

using testing::litLeftOf;
using testing::pictureOf;
using testing::planeReference;

constexpr int kWidth = 40;
constexpr int kHeight = 24;
constexpr double kAll = kWidth * kHeight;

Reference halfLit() {
  return planeReference(kWidth, kHeight, litLeftOf(kWidth, kHeight, 20));
}

ErrorMetrics measured(const Reference& truth, const std::vector<float>& shown) {
  return measureErrors(truth, std::span(&shown, 1));
}

std::size_t place(int x, int y) {
  return static_cast<std::size_t>(y * kWidth + x);
}

TEST(ErrorMeasures, H1_AShadowInTheRightPlaceHasNoError) {
  const ErrorMetrics errors = measured(halfLit(), litLeftOf(kWidth, kHeight, 20));
  EXPECT_EQ(errors.receivers, kWidth * kHeight);
  EXPECT_EQ(errors.misclassified, 0.0);
  EXPECT_EQ(errors.rms, 0.0);
  ASSERT_TRUE(errors.edgeDisplacement);
  EXPECT_EQ(errors.edgeDisplacement->mean, 0.0);
  EXPECT_EQ(errors.edgeDisplacement->max, 0.0);
  EXPECT_FALSE(errors.shimmer);
  EXPECT_FALSE(errors.predicted);
}

TEST(ErrorMeasures, H1_AnEdgeThatHasMovedIsOffByAsMuch) {
  for (const int moved : {-3, -2, -1, 1, 2, 3}) {
    const ErrorMetrics errors = measured(halfLit(), litLeftOf(kWidth, kHeight, 20 + moved));
    const double share = std::abs(moved) * kHeight / kAll;
    EXPECT_DOUBLE_EQ(errors.misclassified, share);
    EXPECT_DOUBLE_EQ(errors.falseLit, moved > 0 ? share : 0.0);
    EXPECT_DOUBLE_EQ(errors.falseShadow, moved < 0 ? share : 0.0);
    EXPECT_DOUBLE_EQ(errors.edge, share);
    EXPECT_EQ(errors.interior, 0.0);
    EXPECT_EQ(errors.acne + errors.leak, 0.0);
    EXPECT_DOUBLE_EQ(errors.meanAbsolute, share);
    EXPECT_DOUBLE_EQ(errors.rms, std::sqrt(share));
    ASSERT_TRUE(errors.edgeDisplacement);
    EXPECT_DOUBLE_EQ(errors.edgeDisplacement->mean, std::abs(moved));
    EXPECT_EQ(errors.edgeDisplacement->median, std::abs(moved));
    EXPECT_EQ(errors.edgeDisplacement->p95, std::abs(moved));
    EXPECT_EQ(errors.edgeDisplacement->max, std::abs(moved));
  }
}

TEST(ErrorMeasures, H1_WithoutReceiversThereAreNoErrors) {
  Reference truth = halfLit();
  truth.lights[0].receiver.assign(truth.surface.size(), 0);
  const ErrorMetrics errors = measured(truth, litLeftOf(kWidth, kHeight, 3));
  EXPECT_EQ(errors.receivers, 0u);
  for (const double value : {errors.misclassified, errors.falseShadow, errors.falseLit, errors.acne, errors.leak,
                             errors.edge, errors.interior, errors.meanAbsolute, errors.rms}) {
    EXPECT_EQ(value, 0.0);
  }
  EXPECT_FALSE(errors.edgeDisplacement);
  EXPECT_EQ(measureErrors(Reference{}, {}).receivers, 0u);
}

TEST(ErrorMeasures, H1_WithoutAnEdgeNothingIsDisplaced) {
  const std::vector<float> lit(kWidth * kHeight, 1.0f);
  const Reference allLit = planeReference(kWidth, kHeight, lit);
  const ErrorMetrics shadowWhereNoneIs = measured(allLit, litLeftOf(kWidth, kHeight, 20));
  EXPECT_FALSE(shadowWhereNoneIs.edgeDisplacement) << "V has no edge";
  EXPECT_DOUBLE_EQ(shadowWhereNoneIs.acne, 0.5) << "and so all of the false shadow is far from any";
  EXPECT_FALSE(measured(halfLit(), lit).edgeDisplacement) << "S has no edge";
  EXPECT_TRUE(std::isinf(edgeDistances(allLit, 0, litLeftOf(kWidth, kHeight, 20))[place(20, 5)]));
}

TEST(ErrorMeasures, H1_SilhouettesAreNoEdges) {
  // Right of the true edge lies another level, 3 m lower: a silhouette and no shadow's edge.
  Reference truth = halfLit();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 20; x < kWidth; ++x) truth.surface[place(x, y)].position.y = -3;
  }
  EXPECT_FALSE(measured(truth, litLeftOf(kWidth, kHeight, 20)).edgeDisplacement);
  // The same instance or not is not asked: a shadow runs on over the joint of two tiles.
  Reference tiled = halfLit();
  for (int y = 0; y < kHeight; ++y) tiled.surface[place(20, y)].instance = 7;
  EXPECT_EQ(measured(tiled, litLeftOf(kWidth, kHeight, 21)).edgeDisplacement->median, 1.0);
}

TEST(ErrorMeasures, H1_ASlantedPlaneIsContinuousHoweverFarApartItsPointsAre) {
  // Seen at a grazing angle: 30 m between neighbours whose pixels are 1 m wide, all on one slope.
  Reference truth = halfLit();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      truth.surface[place(x, y)].position = glm::dvec3(30.0 * x, 40.0 * x, y);
      truth.surface[place(x, y)].normal = glm::vec3(-0.8f, 0.6f, 0);
    }
  }
  EXPECT_EQ(measured(truth, litLeftOf(kWidth, kHeight, 22)).edgeDisplacement->median, 2.0);
}

TEST(ErrorMeasures, H1_ABallIsContinuousAndItsSilhouetteIsNot) {
  // A ball of 10 m over a ground 30 m below its middle, from straight above.
  constexpr double kRadius = 10;
  const auto truthOf = [&](int edge) {
    Reference truth = planeReference(kWidth, kHeight, litLeftOf(kWidth, kHeight, edge));
    for (SurfacePoint& point : truth.surface) {
      const glm::dvec2 way(point.position.x - 19.5, point.position.z - 11.5);
      const double squared = kRadius * kRadius - glm::dot(way, way);
      if (squared <= 0) {
        point.position.y = -30;
        continue;
      }
      point.position.y = std::sqrt(squared);
      point.normal = glm::vec3(glm::dvec3(way.x, point.position.y, way.y) / kRadius);
    }
    return truth;
  };
  const Reference across = truthOf(20);
  const auto distances = edgeDistances(across, 0, litLeftOf(kWidth, kHeight, 20));
  EXPECT_EQ(distances[place(20, 11)], 0.0f) << "the shadow's edge over the ball's top";
  EXPECT_EQ(distances[place(20, 3)], 0.0f) << "and down its side";
  const auto ballAlone =
      pictureOf(kWidth, kHeight, [&](int x, int y) { return std::hypot(x - 19.5, y - 11.5) < kRadius ? 1.0f : 0.0f; });
  for (const float distance : edgeDistances(across, 0, ballAlone)) EXPECT_EQ(distance, -1.0f) << "all silhouette";
}

TEST(ErrorMeasures, H1_SeveralLightsArePooled) {
  Reference truth = halfLit();
  truth.lights.push_back(truth.lights[0]);
  truth.lights[1].receiver.assign(truth.surface.size(), 0);
  for (int y = 0; y < kHeight / 2; ++y) {
    for (int x = 0; x < kWidth; ++x) truth.lights[1].receiver[place(x, y)] = 1;
  }
  const ErrorMetrics errors =
      measureErrors(truth, std::vector{litLeftOf(kWidth, kHeight, 20), litLeftOf(kWidth, kHeight, 22)});
  EXPECT_EQ(errors.receivers, kWidth * kHeight * 3 / 2);
  EXPECT_DOUBLE_EQ(errors.misclassified, kHeight / (1.5 * kAll));
  EXPECT_DOUBLE_EQ(errors.edgeDisplacement->mean, kHeight / (1.5 * kHeight));
  EXPECT_EQ(errors.edgeDisplacement->median, 0.0);
  EXPECT_EQ(errors.edgeDisplacement->p95, 2.0);
}

} // namespace
} // namespace gnomon
