#include "gl_fixture.h"
#include "renderer/gl/debug_log.h"
#include "renderer/gl/object.h"

namespace gnomon::gl {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class DebugLog : public GlTest {};

TEST_F(DebugLog, holdsWhatTheDriverComplainsOf) {
  EXPECT_THAT(takeDebugErrors(), IsEmpty());
  glBindTextureUnit(0, 12345);
  const std::vector<std::string> errors = takeDebugErrors();
  ASSERT_THAT(errors, SizeIs(1));
  EXPECT_THAT(errors[0], testing::HasSubstr("GL_INVALID_OPERATION"));
  EXPECT_THAT(takeDebugErrors(), IsEmpty()) << "taken is taken";
}

TEST_F(DebugLog, knowsErrorsWithoutAMessage) {
  glDisable(GL_DEBUG_OUTPUT);
  glEnable(0xffff);
  EXPECT_THAT(takeDebugErrors(), testing::ElementsAre("GL_INVALID_ENUM"));
}

TEST_F(DebugLog, isBounded) {
  for (int i = 0; i < 100; ++i) glEnable(0xffff);
  const std::vector<std::string> errors = takeDebugErrors();
  ASSERT_THAT(errors, SizeIs(65));
  EXPECT_EQ(errors.back(), "and 36 more");
}

TEST_F(DebugLog, makesAProblemThatSaysWhere) {
  EXPECT_TRUE(checkErrors("doing nothing"));
  glEnable(0xffff);
  const Status status = checkErrors("drawing the sky");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.problems().front().code, ProblemCode::backend);
  EXPECT_THAT(status.problems().front().detail, testing::HasSubstr("while drawing the sky"));
}

TEST_F(DebugLog, startsEmptyWithEachContext) {
  glEnable(0xffff);
  context_.reset();
  SetUp();
  EXPECT_THAT(takeDebugErrors(), IsEmpty());
}

} // namespace
} // namespace gnomon::gl
