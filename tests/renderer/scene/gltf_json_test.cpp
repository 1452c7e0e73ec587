#include "renderer/scene/gltf_json.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(GltfJson, ExtensionsAreFoundWhereThereAreAny) {
  const auto object = nlohmann::json::parse(R"({"name": "lamp", "extensions": {"KHR_lights_punctual": {"light": 0}}})");
  ASSERT_NE(extensionOf(object, "KHR_lights_punctual"), nullptr);
  EXPECT_EQ((*extensionOf(object, "KHR_lights_punctual"))["light"], 0);
  EXPECT_EQ(extensionOf(object, "KHR_draco_mesh_compression"), nullptr);
  EXPECT_EQ(extensionOf(nlohmann::json::object(), "KHR_lights_punctual"), nullptr);
  EXPECT_EQ(nameOf(object), "lamp");
  EXPECT_EQ(nameOf(nlohmann::json::object()), "");
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
