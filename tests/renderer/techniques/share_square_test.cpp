#include "renderer/techniques/share_square.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace gnomon {
namespace {

constexpr int kSide = ShareSquare::kSide;

/// A square of one surface that is flat, whose shares are these of their columns and rows.
ShareSquare flat(const std::function<float(int, int)>& share, int rays) {
  ShareSquare square;
  for (int i = 0; i < int(ShareSquare::kCount); ++i) {
    const int x = i % ShareSquare::kWidth - ShareSquare::kReach;
    const int y = i / ShareSquare::kWidth - ShareSquare::kReach;
    square.share[i] = share(x, y);
    square.noise[i] = noiseOf(rays);
    square.shows[i] = -1;
    const float point[] = {0.01f * float(x), 0, 0.01f * float(y)};
    const float normal[] = {0, 1, 0};
    for (int axis = 0; axis < 3; ++axis) {
      square.point[axis][i] = point[axis];
      square.normal[axis][i] = normal[axis];
    }
  }
  return square;
}

/// The root of the mean square of what the square differs by from `truth`.
double off(const float* shares, int width, const std::function<float(int, int)>& truth) {
  double sum = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) sum += std::pow(double{shares[y * width + x]} - double{truth(x, y)}, 2);
  }
  return std::sqrt(sum / (kSide * kSide));
}

/// Shares with the noise that these rays leave in them.
std::function<float(int, int)> noisy(const std::function<float(int, int)>& truth, int rays) {
  return [truth, rays, random = std::mt19937(7)](int x, int y) mutable {
    std::normal_distribution<float> noise(0, std::sqrt(noiseOf(rays)));
    return truth(x, y) + noise(random);
  };
}

TEST(ShareSquare, TakesNoiseFromAWidePenumbra) {
  const auto truth = [](int x, int y) { return 0.4f + 0.01f * float(x) - 0.005f * float(y); };
  const ShareSquare square = flat(noisy(truth, 16), 16);
  const double before = off(square.share + ShareSquare::kReach * (ShareSquare::kWidth + 1), ShareSquare::kWidth, truth);
  EXPECT_NEAR(before, std::sqrt(noiseOf(16)), 0.02);
  EXPECT_LT(off(evenOut(square).share, kSide, truth), 0.4 * before);
}

TEST(ShareSquare, TakesNoiseFromASteepPenumbraUpToTheRimOfItsSurface) {
  const auto truth = [](int x, int y) { return 0.1f + 0.05f * float(x) + 0.01f * float(y); };
  ShareSquare square = flat(noisy(truth, 16), 16);
  for (int i = 0; i < int(ShareSquare::kCount); ++i) {
    const int y = i / ShareSquare::kWidth - ShareSquare::kReach;
    if (y < 0 || y >= kSide) square.shows[i] = 0;
  }
  const double before = off(square.share + ShareSquare::kReach * (ShareSquare::kWidth + 1), ShareSquare::kWidth, truth);
  EXPECT_LT(off(evenOut(square).share, kSide, truth), 0.48 * before);
}

TEST(ShareSquare, LeavesSlopesAndEdgesWithoutNoiseAsTheyAre) {
  const std::function<float(int, int)> truths[] = {[](int x, int y) { return 0.3f + 0.01f * float(x + y); },
                                                   [](int x, int /*y*/) { return x < 7 ? 0.0f : 1.0f; },
                                                   [](int x, int y) { return x == 5 || y == 9 ? 0.2f : 0.9f; }};
  for (const auto& truth : truths) EXPECT_LT(off(evenOut(flat(truth, 16)).share, kSide, truth), 1e-6);
  ShareSquare strip = flat(truths[0], 16); // one column wide
  for (int i = 0; i < int(ShareSquare::kCount); ++i) {
    if (i % ShareSquare::kWidth % 2 == 1) strip.shows[i] = 0;
  }
  const EvenSquare even = evenOut(strip);
  for (int y = 0; y < kSide; ++y) EXPECT_NEAR(even.share[y * kSide], truths[0](0, y), 1e-6);
}

TEST(ShareSquare, KeepsTheEdgesOfNarrowPenumbras) {
  const auto truth = [](int x, int y) { return std::clamp(0.5f + 0.3f * float(x) - 0.2f * float(y), 0.0f, 1.0f); };
  const ShareSquare square = flat(noisy(truth, 16), 16);
  const double before = off(square.share + ShareSquare::kReach * (ShareSquare::kWidth + 1), ShareSquare::kWidth, truth);
  EXPECT_LT(off(evenOut(square).share, kSide, truth), 1.1 * before);
}

TEST(ShareSquare, MixesNoSurfaces) {
  const auto share = [](int x, int /*y*/) { return x < 8 ? 0.45f : 0.55f; };
  const auto columns = [](ShareSquare square, const std::function<void(ShareSquare&, int)>& change) {
    for (int i = 0; i < int(ShareSquare::kCount); ++i) {
      if (i % ShareSquare::kWidth - ShareSquare::kReach >= 8) change(square, i);
    }
    return evenOut(square);
  };
  const ShareSquare square = flat(share, 4);
  EXPECT_GT(off(evenOut(square).share, kSide, share), 0.003) << "one surface";
  const auto isKept = [&](const std::function<void(ShareSquare&, int)>& change) {
    return off(columns(square, change).share, kSide, share) < 1e-6;
  };
  EXPECT_TRUE(isKept([](ShareSquare& of, int i) { of.point[1][i] -= 0.2f; })) << "a step";
  EXPECT_TRUE(isKept([](ShareSquare& of, int i) { of.normal[0][i] = 0.8f, of.normal[1][i] = 0.6f; })) << "a crease";
  EXPECT_TRUE(isKept([](ShareSquare& of, int i) { of.point[1][i] = std::nanf(""); })) << "no number";
  const EvenSquare even = columns(square, [](ShareSquare& of, int i) { of.shows[i] = 0; });
  for (int x = 0; x < 8; ++x) EXPECT_NEAR(even.share[5 * kSide + x], 0.45f, 1e-6f) << "nothing beside";
}

} // namespace
} // namespace gnomon
