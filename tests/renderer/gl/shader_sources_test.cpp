#include "renderer/shaders/shader_sources.h"

#include <gmock/gmock.h>
#include <string>

namespace gnomon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ShaderSources, areFoundByName) {
  ASSERT_FALSE(shaderSources().empty());
  for (const ShaderSource& source : shaderSources()) {
    EXPECT_EQ(shaderSource(source.name), source.text);
    EXPECT_THAT(std::string(source.text), HasSubstr("void main()")) << source.name;
  }
  EXPECT_TRUE(shaderSource("no_such.frag").empty());
}

TEST(ShaderSources, haveTheirIncludesExpandedAndNoVersion) {
  for (const ShaderSource& source : shaderSources()) {
    EXPECT_TRUE(source.text.starts_with("// source 0: " + std::string(source.name) + "\n#line 1 0\n"));
    EXPECT_THAT(std::string(source.text), Not(HasSubstr("#include"))) << source.name;
    EXPECT_THAT(std::string(source.text), Not(HasSubstr("#version"))) << source.name;
  }
}

} // namespace
} // namespace gnomon
