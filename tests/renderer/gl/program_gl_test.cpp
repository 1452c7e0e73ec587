#include "gl_fixture.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/program.h"

namespace gnomon::gl {
namespace {

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
  EXPECT_THAT(detail, HasSubstr("0:2")) << "source 0, line 2";
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
  text.compute = R"(
layout(local_size_x = 1) in;
layout(location = 3) uniform float scale;
layout(location = 4) uniform mat3 matrix;
layout(std430, binding = 2) buffer Out { float values[]; };
void main() { values[gl_WorkGroupID.x] = scale * OFFSET + float(gl_WorkGroupID.x) + matrix[1][2]; })";
  text.defines = {"OFFSET 10.0"};
  const auto program = Program::create(text, "compute");
  ASSERT_TRUE(program) << detailsOf(program.problems());
  program->set(3, 2.0f);
  glm::mat3 matrix(0);
  matrix[1][2] = 100;
  program->set(4, matrix);
  const Buffer out(3 * sizeof(float), "out");
  out.bindStorage(2);
  dispatch(*program, 3);
  std::array<float, 3> values{};
  out.read(0, std::as_writable_bytes(std::span(values)));
  EXPECT_THAT(values, testing::ElementsAre(120, 121, 122));
}

} // namespace
} // namespace gnomon::gl
