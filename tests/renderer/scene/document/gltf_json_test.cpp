#include "renderer/scene/document/gltf_json.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

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
