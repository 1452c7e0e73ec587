#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "renderer/scene/animation/motion.h"
#include "renderer/scene/document/read_model.h"
#include "tests/renderer/scene/geometry.h"

namespace gnomon {
namespace {

Sampler threeComponents(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
  return {interpolation, 3, false, std::move(times), std::move(values)};
}

glm::dvec3 at(const Sampler& sampler, double time) {
  double value[3] = {};
  sample(sampler, time, value);
  return {value[0], value[1], value[2]};
}

glm::dquat rotationAt(const Sampler& sampler, double time) {
  double value[4] = {};
  sample(sampler, time, value);
  return {value[3], value[0], value[1], value[2]};
}

/// x y z w of a turn around Z.
std::vector<float> turn(double degrees) {
  const double half = degrees * std::numbers::pi / 360;
  return {0, 0, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

Sampler turns(std::vector<std::vector<float>> keyframes) {
  Sampler sampler{Interpolation::linear, 4, true, {}, {}};
  for (const auto& keyframe : keyframes) {
    sampler.times.push_back(static_cast<float>(sampler.times.size()));
    sampler.values.insert(sampler.values.end(), keyframe.begin(), keyframe.end());
  }
  return sampler;
}

TEST(Sampling, LinearValuesGoStraight) {
  const Sampler sampler = threeComponents(Interpolation::linear, {1, 3, 4}, {0, 0, 0, 4, -2, 8, 0, 0, 1});
  expectNear(at(sampler, 1.5), {1, -0.5, 2});
  expectNear(at(sampler, 3), {4, -2, 8});
  expectNear(at(sampler, 3.25), {3, -1.5, 6.25});
}

TEST(Sampling, StepsHoldUntilTheNextKeyframe) {
  const Sampler sampler = threeComponents(Interpolation::step, {1, 3}, {1, 2, 3, 4, 5, 6});
  expectNear(at(sampler, 2.999), {1, 2, 3});
  expectNear(at(sampler, 3), {4, 5, 6});
}

TEST(Sampling, NothingMovesBeforeTheFirstAndAfterTheLastKeyframe) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::step}) {
    const Sampler sampler = threeComponents(interpolation, {1, 3}, {1, 2, 3, 4, 5, 6});
    for (const double time : {-1e9, 0.0, 0.999, 1.0}) expectNear(at(sampler, time), {1, 2, 3});
    for (const double time : {3.0, 3.001, 1e9}) expectNear(at(sampler, time), {4, 5, 6});
  }
  const Sampler spline =
      threeComponents(Interpolation::cubicSpline, {1, 3}, {9, 9, 9, 1, 2, 3, 9, 9, 9, 9, 9, 9, 4, 5, 6, 9, 9, 9});
  expectNear(at(spline, 0), {1, 2, 3});
  expectNear(at(spline, 5), {4, 5, 6});
}

TEST(Sampling, OneKeyframeIsAStill) {
  const Sampler sampler = threeComponents(Interpolation::linear, {2}, {1, 2, 3});
  for (const double time : {0.0, 2.0, 5.0}) expectNear(at(sampler, time), {1, 2, 3});
}

/// A cubic polynomial is its own spline, tangents being its derivative: x = s^3 - 2 s, y = s^2, z = 5.
TEST(Sampling, CubicSplinesFollowTheirTangents) {
  std::vector<float> values;
  const std::vector<float> times{0.5f, 1.5f, 4};
  for (const float s : times) {
    const std::vector<float> tangent{3 * s * s - 2, 2 * s, 0};
    values.insert(values.end(), tangent.begin(), tangent.end());
    values.insert(values.end(), {s * s * s - 2 * s, s * s, 5});
    values.insert(values.end(), tangent.begin(), tangent.end());
  }
  const Sampler sampler = threeComponents(Interpolation::cubicSpline, times, values);
  for (const double s : {0.5, 0.75, 1.25, 1.5, 2.0, 3.875}) {
    expectNear(at(sampler, s), {s * s * s - 2 * s, s * s, 5}, 1e-5);
  }
}

TEST(Sampling, RotationsTurnEvenlyTheShorterWay) {
  std::vector<float> other = turn(120);
  for (float& component : other) component = -component; // the same rotation
  const Sampler sampler = turns({turn(0), other});
  for (const double share : {0.1, 0.25, 0.5, 0.9}) {
    const glm::dvec3 x = rotationAt(sampler, share) * glm::dvec3(1, 0, 0);
    const double angle = 120 * share * std::numbers::pi / 180;
    expectNear(x, {std::cos(angle), std::sin(angle), 0}, 1e-6);
    EXPECT_NEAR(glm::length(rotationAt(sampler, share)), 1, 1e-6);
  }
}

TEST(Sampling, EqualAndOppositeRotationsGiveNumbers) {
  for (const auto& sampler : {turns({turn(30), turn(30)}), turns({turn(0), turn(360)}), turns({turn(0), turn(180)}),
                              turns({{1, 0, 0, 0}, {-1, 0, 0, 0}})}) {
    for (const double time : {0.0, 0.3, 0.5, 0.7, 1.0}) EXPECT_NEAR(glm::length(rotationAt(sampler, time)), 1, 1e-6);
  }
}

TEST(Sampling, ASplineOfRotationsStaysOne) {
  Sampler sampler = turns({{0, 0, 0, 0}, turn(0), {0, 0, 2, 0}, {0, 0, 0, 0}, turn(90), {0, 0, 0, 0}});
  sampler.interpolation = Interpolation::cubicSpline;
  sampler.times = {0, 1};
  const double t = 0.25;
  const double z = t * t * t - 2 * t * t + t;
  const std::vector<float> to = turn(90);
  const double share = 3 * t * t - 2 * t * t * t;
  const glm::dquat expected =
      glm::normalize(glm::dquat((1 - share) + share * double{to[3]}, 0, 0, 2 * z + share * double{to[2]}));
  const glm::dquat actual = rotationAt(sampler, t);
  EXPECT_NEAR(actual.z, expected.z, 1e-6);
  EXPECT_NEAR(actual.w, expected.w, 1e-6);
  // Through zero: the nearer keyframe stands in.
  Sampler crossing = turns({{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, -1}, {0, 0, 0, 0}});
  crossing.interpolation = Interpolation::cubicSpline;
  crossing.times = {0, 1};
  EXPECT_NEAR(glm::length(rotationAt(crossing, 0.5)), 1, 1e-12);
}

const gltf::Model kModel = readModel(nlohmann::json::parse(R"({
  "materials": [{}, {"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {}}}}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
  "nodes": [{}],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}}
})"));

TEST(PropertyTarget, NumbersOfMaterialsCamerasAndLights) {
  const std::pair<const char*, std::size_t> known[] = {
      {"/materials/1/emissiveFactor", 3},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", 4}, // the object has defaults
      {"/materials/0/alphaCutoff", 0},
      {"/materials/1/normalTexture/scale", 0},
      {"/materials/1/normalTexture/extensions/KHR_texture_transform/offset", 2},
      {"/materials/1/normalTexture/extensions/KHR_texture_transform/rotation", 0},
      {"/cameras/0/perspective/yfov", 0},
      {"/extensions/KHR_lights_punctual/lights/0/color", 3},
      {"/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", 0}};
  for (const auto& [pointer, length] : known) {
    const auto target = propertyAt(kModel, pointer);
    ASSERT_TRUE(target) << pointer;
    EXPECT_EQ(target->pointer, pointer);
    EXPECT_EQ(target->components, std::max<std::size_t>(length, 1)) << pointer;
  }
  EXPECT_EQ(propertyAt(kModel, "/materials/0/pbrMetallicRoughness/metallicFactor")->max, 1);
  EXPECT_TRUE(propertyAt(kModel, "/cameras/0/perspective/znear")->minExcluded);
}

TEST(PropertyTarget, NothingElse) {
  for (const char* pointer : {"",
                              "/",
                              "materials/0/alphaCutoff",
                              "/materials",
                              "/materials/",
                              "/materials/0",
                              "/materials/0/",
                              "/materials/2/alphaCutoff",
                              "/materials/00/alphaCutoff",
                              "/materials/-/alphaCutoff",
                              "/materials//alphaCutoff",
                              "/materials/0/alphaCutoff/",
                              "/materials/0/alphaCutoff/0",
                              "/materials/0/emissiveFactor/0",
                              "/materials/0/alphaMode",
                              "/materials/0/doubleSided",
                              "/materials/0/name",
                              "/materials/0/unknown",
                              "/materials/0/normalTexture/scale",
                              "/materials/0/extensions/KHR_materials_transmission/transmissionFactor",
                              "/materials/1/normalTexture/texCoord",
                              "/materials/1/normalTexture/index",
                              "/cameras/0/perspective/aspectRatio",
                              "/cameras/0/orthographic/ymag",
                              "/cameras/0/type",
                              "/nodes/0/translation",
                              "/meshes/0/weights",
                              "/extensions/KHR_lights_punctual/lights/0",
                              "/extensions/KHR_lights_punctual/lights/1/color",
                              "/extensions/KHR_materials_variants/variants/0/name",
                              "/materials~10/alphaCutoff"}) {
    EXPECT_FALSE(propertyAt(kModel, pointer)) << pointer;
  }
}

TEST(GltfJson, IndicesOfPointersAreWrittenInOneWay) {
  EXPECT_EQ(indexIn("0", 1), 0u);
  EXPECT_EQ(indexIn("12", 13), 12u);
  for (const char* token : {"", "-", "-1", "+1", "00", "01", "1x", " 1", "13", "99999999999999999999"}) {
    EXPECT_FALSE(indexIn(token, 13)) << token;
  }
}

TEST(GltfJson, ExtensionsAreFoundWhereThereAreAny) {
  const auto object = nlohmann::json::parse(R"({"name": "lamp", "extensions": {"KHR_lights_punctual": {"light": 0}}})");
  ASSERT_NE(extensionOf(object, "KHR_lights_punctual"), nullptr);
  EXPECT_EQ((*extensionOf(object, "KHR_lights_punctual"))["light"], 0);
  EXPECT_EQ(extensionOf(object, "KHR_draco_mesh_compression"), nullptr);
  EXPECT_EQ(extensionOf(nlohmann::json::object(), "KHR_lights_punctual"), nullptr);
  EXPECT_EQ(nameAt(object), "lamp");
  EXPECT_EQ(nameAt(nlohmann::json::object()), "");
}

} // namespace
} // namespace gnomon
