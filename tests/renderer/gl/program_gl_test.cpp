#include "gl_fixture.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace gnomon::gl {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class Programs : public GlTest {
 protected:
  static std::string problemOf(const ProgramText& text) {
    const auto program = Program::create(text, "tried");
    if (program) return "no problem";
    EXPECT_EQ(program.problems().front().code, ProblemCode::backend);
    return program.problems().front().detail;
  }
};

TEST_F(Programs, tellTheCompilersLogWithFileAndLine) {
  ProgramText text;
  text.vertex = "// source 0: broken.vert\n#line 1 0\nvoid main() {\n  gl_Position = undeclared;\n}";
  const std::string detail = problemOf(text);
  EXPECT_THAT(detail, HasSubstr("\"tried\" does not compile"));
  EXPECT_THAT(detail, HasSubstr("undeclared"));
  EXPECT_THAT(detail, ContainsRegex("0[:(]2")) << "source 0, line 2";
  EXPECT_THAT(detail, HasSubstr("0 = broken.vert"));
}

TEST_F(Programs, tellTheLinkersLog) {
  ProgramText text;
  text.vertex = "void main() { gl_Position = vec4(0); }";
  text.fragment = "vec4 elsewhere();\nlayout(location = 0) out vec4 c;\nvoid main() { c = elsewhere(); }";
  EXPECT_THAT(problemOf(text), HasSubstr("\"tried\" does not link"));
}

TEST_F(Programs, nameAShaderThatIsNotThere) {
  ProgramSource source;
  source.vertex = "no_such.vert";
  const auto program = Program::create(source, "tried");
  ASSERT_FALSE(program);
  EXPECT_THAT(program.problems().front().detail, HasSubstr("no_such.vert"));
}

TEST_F(Programs, needAShader) {
  EXPECT_THAT(problemOf({}), HasSubstr("has no shader"));
}

TEST_F(Programs, runWithDefinesUniformsAndStorage) {
  ProgramText text;
  text.vertex = "void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }";
  text.fragment = R"(
layout(location = 3) uniform int scale;
layout(location = 4) uniform mat4 matrix;
layout(std430, binding = 2) readonly buffer In { float values[]; };
layout(location = 0) out float result;
void main() { result = float(scale) * OFFSET + values[int(gl_FragCoord.x)] + matrix[1][2]; })";
  text.defines = {"OFFSET 10.0"};
  const auto program = Program::create(text, "sum");
  ASSERT_TRUE(program) << detailsOf(program.problems());
  program->set(3, 2);
  glm::mat4 matrix(0);
  matrix[1][2] = 100;
  program->set(4, matrix);
  const Buffer in(bytesOf(std::vector<float>{0, 1, 2}), "in");
  in.bindStorage(2);

  const Rect all{0, 0, 3, 1};
  const Texture sums({.format = GL_R32F, .width = all.width, .height = all.height}, "sums");
  const Framebuffer target = *Framebuffer::create({{{.texture = &sums}}, {}}, "sums");
  drawFullscreen(*program, {.framebuffer = target.id(), .viewport = all});
  std::array<float, 3> values{};
  sums.read(0, all, {GL_RED, GL_FLOAT}, std::as_writable_bytes(std::span(values)));
  EXPECT_THAT(values, testing::ElementsAre(120, 121, 122));
}

} // namespace
} // namespace gnomon::gl
