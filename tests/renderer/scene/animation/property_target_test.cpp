#include "renderer/scene/animation/property_target.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/scene/document/read_model.h"

namespace gnomon {
namespace {

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

} // namespace
} // namespace gnomon
