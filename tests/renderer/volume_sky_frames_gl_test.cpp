// Volumes under the sky, in whole frames: what they take of it from surfaces, and what of it arrives in them.
#include <cmath>
#include <functional>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_environment.h"
#include "tests/renderer/made_grids.h"
#include "tests/renderer/sky_share_frames.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::GlbBuilder;
using testing::meanOf;
using testing::renderJson;
using testing::whiteFloor;

/// 0..255: how much of a voxel of a grid of side `side` lies in the ball that fills the box.
int ballVoxel(int x, int y, int z, int side) {
  constexpr int kParts = 4;
  const glm::dvec3 corner(x, y, z);
  int inside = 0;
  for (int i = 0; i < kParts * kParts * kParts; ++i) {
    const glm::dvec3 part(i % kParts, i / kParts % kParts, i / kParts / kParts);
    inside += glm::length((corner + (part + 0.5) / double{kParts}) * (2.0 / side) - 1.0) < 1 ? 1 : 0;
  }
  return 255 * inside / (kParts * kParts * kParts);
}

ScenePtr underSky(const GlbBuilder& builder) {
  SceneBundle bundle = builder.bundle();
  bundle.files["white.hdr"] = testing::hdrFile(16, [](const glm::dvec3&) { return glm::dvec3(1); });
  bundle.files["half.hdr"] = testing::hdrFile(16, [](const glm::dvec3& d) { return glm::dvec3(d.y > 0 ? 1 : 0); });
  bundle.files["solid.npy"] = testing::byteGrid(3, 3, 3, [](int, int, int) { return 255; });
  bundle.files["ball.npy"] = testing::byteGrid(64, 64, 64, [](int x, int y, int z) { return ballVoxel(x, y, z, 64); });
  return testing::sceneOf(bundle);
}

Json volumeOf(const char* file, const glm::dvec3& low, const glm::dvec3& high, double sigma, double color = 0) {
  const Json rgb{color, color, color};
  return {
      {"file", file},
      {"box", {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}}},
      {"transferFunction",
       {{{"value", 0}, {"color", rgb}, {"extinction", 0}}, {{"value", 255}, {"color", rgb}, {"extinction", sigma}}}}};
}

Json specOf(double height, double degrees, const std::vector<Json>& volumes) {
  Json spec = testing::skyShareSpec(height, degrees);
  spec["volumes"] = volumes;
  return spec;
}

double meanShare(const ScenePtr& scene, const Json& spec) {
  return meanOf(floatsOf(renderJson(scene, spec.dump())));
}

/// The share of a uniform sky that a floor gets at the origin, weighted by the cosine, past what has this length along
/// each direction.
double shareUnder(double sigma, const std::function<double(const glm::dvec3&)>& length) {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double sine2 = (i + 0.5) / kSteps; // even steps of it weigh as the cosine does
    for (int k = 0; k < kSteps; ++k) {
      const double angle = 2 * glm::pi<double>() * (k + 0.5) / kSteps;
      const double sine = std::sqrt(sine2);
      sum += std::exp(-sigma * length({sine * std::cos(angle), std::sqrt(1 - sine2), sine * std::sin(angle)}));
    }
  }
  return sum / (kSteps * kSteps);
}

/// Of a ray from the origin through a ball that stands over it.
double ballChord(const glm::dvec3& direction, double height, double radius) {
  const double along = height * direction.y;
  const double root = along * along - height * height + radius * radius;
  return root > 0 ? 2 * std::sqrt(root) : 0.0;
}

/// Of a ray from the origin through a box that stands over it.
double boxChord(const glm::dvec3& direction, double half, double low, double high) {
  double from = low / direction.y, to = high / direction.y;
  for (const double along : {direction.x, direction.z}) {
    if (along != 0) to = std::min(to, half / std::abs(along));
  }
  return std::max(to - from, 0.0);
}

TEST(VolumeSkyFrames, ABallOfFogTakesWhatItsChordsSay) {
  const ScenePtr scene = underSky(whiteFloor(0.5f));
  for (const double sigma : {0.3, 1.0, 4.0}) {
    const double wanted = shareUnder(sigma, [](const glm::dvec3& d) { return ballChord(d, 2, 1); });
    const Json spec = specOf(0.9, 2, {volumeOf("ball.npy", {-1, 1, -1}, {1, 3, 1}, sigma)});
    // Cells of 1/16 of the radius blur the rim, the more the denser it is.
    EXPECT_NEAR(meanShare(scene, spec), wanted, sigma > 1 ? 0.008 : 0.004) << sigma;
  }
}

TEST(VolumeSkyFrames, ABoxOfFogTakesWhatItsChordsSay) {
  const ScenePtr scene = underSky(whiteFloor(0.5f));
  for (const double sigma : {0.2, 0.7, 3.0}) {
    const double wanted = shareUnder(sigma, [](const glm::dvec3& d) { return boxChord(d, 3, 1, 2); });
    Json spec = specOf(0.9, 2, {volumeOf("solid.npy", {-3, 1, -3}, {3, 2, 3}, sigma)});
    EXPECT_NEAR(meanShare(scene, spec), wanted, 0.003) << sigma;
    // The floor stands in the fog.
    const double within = shareUnder(sigma, [](const glm::dvec3& d) { return boxChord(d, 3, 0, 2); });
    spec["volumes"] = std::vector<Json>{volumeOf("solid.npy", {-3, -1, -3}, {3, 2, 3}, sigma)};
    EXPECT_NEAR(meanShare(scene, spec), within, 0.003) << sigma;
  }
}

TEST(VolumeSkyFrames, ReferenceAndColorSayTheSame) {
  const ScenePtr scene = underSky(whiteFloor(0.5f));
  const double wanted = shareUnder(1, [](const glm::dvec3& d) { return ballChord(d, 2, 1); });
  Json spec = specOf(0.9, 2, {volumeOf("ball.npy", {-1, 1, -1}, {1, 3, 1}, 1)});
  spec["width"] = spec["height"] = 16;
  spec["views"] = {"shadow", "reference", "error"};
  const Frame measured = renderJson(scene, spec.dump());
  EXPECT_NEAR(meanOf(floatsOf(measured, 1)), wanted, 0.002);
  EXPECT_LT(measured.report.error.value().rms, 0.01);
  spec.erase("debug");
  spec["views"] = {"color"};
  const double shaded = meanShare(scene, spec);
  spec["environment"]["shadows"] = "none";
  EXPECT_NEAR(shaded / meanShare(scene, spec), wanted, 0.01);
}

TEST(VolumeSkyFrames, SheetsAndVolumesMultiply) {
  GlbBuilder builder = whiteFloor(0.5f);
  builder.add("materials", {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.25}}}}});
  testing::addSquare(builder, 200, 2);
  builder.json["meshes"][1]["primitives"][0]["material"] = 1;
  const double fog = shareUnder(0.5, [](const glm::dvec3& d) { return boxChord(d, 3, 1, 1.5); });
  for (const double low : {1.0, 2.5}) { // between the floor and the sheet; and over both, as wide as seen from there
    const double half = 3 * low;
    const Json spec = specOf(0.9, 2, {volumeOf("solid.npy", {-half, low, -half}, {half, 1.5 * low, half}, 0.5 / low)});
    EXPECT_NEAR(meanShare(underSky(builder), spec), 0.75 * fog, 0.006) << low;
  }
}

TEST(VolumeSkyFrames, SwitchesOfTheVolumeHold) {
  const ScenePtr scene = underSky(whiteFloor(0.5f));
  Json volume = volumeOf("ball.npy", {-1, 1, -1}, {1, 3, 1}, 2);
  volume["castShadow"] = false;
  EXPECT_EQ(meanShare(scene, specOf(0.9, 2, {volume})), 1);
  EXPECT_EQ(meanShare(scene, specOf(0.9, 2, {})), 1);
}

/// The middle of the picture, of view color, of a volume before black that is seen from the side.
double middleOf(const ScenePtr& scene, const Json& volume, const Json& patch = Json::object()) {
  Json spec = specOf(0, 10, {volume});
  spec["camera"] = {{"eye", {0, 2, 12}}, {"target", {0, 2, 0}}, {"perspective", {{"fovYDegrees", 2}}}};
  spec["views"] = {"color"};
  spec["nodes"] = {{{"node", 0}, {"visible", false}}};
  spec["background"] = {{"color", {0, 0, 0}}, {"alpha", 0}};
  spec.erase("debug");
  spec.merge_patch(patch);
  const Frame frame = renderJson(scene, spec.dump());
  const Image& image = frame.images[0].image;
  return double{floatsOf(frame)[(24u * 48u + 24u) * image.channels.size()]};
}

const Json kNoShadows{{"environment", {{"shadows", "none"}}}};

TEST(VolumeSkyFrames, AThinVolumeInTheOpenGetsTheMeanOfTheSky) {
  const ScenePtr scene = underSky(whiteFloor(0.5f));
  const Json thin = volumeOf("solid.npy", {-1, 1, -1}, {1, 3, 1}, 2e-4, 0.8);
  for (const char* sky : {"white.hdr", "half.hdr"}) {
    const Json of{{"environment", {{"file", sky}}}};
    Json plain = kNoShadows;
    plain.merge_patch(of);
    const double before = middleOf(scene, thin, plain);
    EXPECT_GT(before, 1e-4);
    EXPECT_NEAR(middleOf(scene, thin, of) / before, 1, 1e-3) << sky;
  }
}

TEST(VolumeSkyFrames, AVolumeInAClosedBoxGetsNothing) {
  GlbBuilder builder = testing::cube();
  builder.json["materials"] = {{{"doubleSided", true}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  builder.json["nodes"][0]["scale"] = {4, 4, 4};
  builder.json["nodes"][0]["translation"] = {0, 2, 0};
  const ScenePtr scene = underSky(builder);
  const Json inside = volumeOf("solid.npy", {-1, 1, -1}, {1, 3, 1}, 1, 0.8);
  const Json box{{"nodes", {{{"node", 0}, {"visible", false}, {"castShadow", true}}}}};
  Json open = box;
  open.merge_patch(kNoShadows);
  EXPECT_GT(middleOf(scene, inside, open), 0.3);
  EXPECT_NEAR(middleOf(scene, inside, box), 0, 1e-6);
  Json unshaded = inside;
  unshaded["receiveShadow"] = false;
  EXPECT_NEAR(middleOf(scene, unshaded, box) / middleOf(scene, inside, open), 1, 1e-3);
}

/// What is seen of a homogeneous medium comes from its first free path; deep within it little of the sky is left.
TEST(VolumeSkyFrames, ADenseVolumeIsDarkerThanAThinOne) {
  const ScenePtr scene = underSky(whiteFloor(0.5f));
  double last = 1;
  for (const double sigma : {0.05, 0.5, 5.0}) {
    const Json volume = volumeOf("solid.npy", {-1, 1, -1}, {1, 3, 1}, sigma, 1);
    const double share = middleOf(scene, volume) / middleOf(scene, volume, kNoShadows);
    EXPECT_LT(share, last - 0.02) << sigma;
    last = share;
  }
  EXPECT_LT(last, 0.5) << "less than half of the sphere is open there";
  EXPECT_GT(last, 0.2);
}

bool isReused(const ScenePtr& scene, const Json& patch = Json::object()) {
  Json spec = specOf(0.9, 2, {volumeOf("ball.npy", {-1, 1, -1}, {1, 3, 1}, 2, 1)});
  spec.erase("debug");
  spec["views"] = {"color"};
  spec["environment"]["samples"] = 1;
  spec.merge_patch(patch);
  return renderJson(scene, spec.dump()).report.volumes.at(0).reused;
}

TEST(VolumeSkyFrames, ItsSkyIsFoundAgainOnlyWhereItChanges) {
  const ScenePtr scene = underSky(whiteFloor(0.5f));
  EXPECT_FALSE(isReused(scene));
  EXPECT_TRUE(isReused(scene));
  EXPECT_TRUE(isReused(scene, {{"width", 24}}));
  EXPECT_FALSE(isReused(scene, {{"environment", {{"file", "half.hdr"}}}}));
  EXPECT_FALSE(isReused(scene, {{"environment", {{"rotationDegrees", 10}}}}));
  EXPECT_FALSE(isReused(scene, {{"environment", {{"intensity", 2}}}}));
  EXPECT_FALSE(isReused(scene, {{"environment", {{"samples", 2}}}}));
  EXPECT_FALSE(isReused(scene, kNoShadows));
  EXPECT_TRUE(isReused(scene));
}

} // namespace
} // namespace gnomon
