#include "gl_fixture.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"

namespace gnomon::gl {
namespace {

class Timers : public GlTest {};

TEST_F(Timers, MeasureTheTimeBetweenStartAndStop) {
  Timer timer = Timer::start();
  Texture texture({GL_RGBA8, 512, 512}, "timed");
  const std::vector<std::byte> texels(512 * 512 * 4);
  texture.write(0, {GL_RGBA, GL_UNSIGNED_BYTE}, texels);
  EXPECT_FALSE(timer.stopped());
  timer.stop();
  EXPECT_TRUE(timer.stopped());
  EXPECT_GT(timer.cpuMilliseconds(), 0.0);
  const auto gpu = timer.gpuMilliseconds();
  ASSERT_TRUE(gpu);
  EXPECT_GE(*gpu, 0.0);
  EXPECT_LT(*gpu, 60'000.0);
}

TEST_F(Timers, MoveAndMeasureNothingByDefault) {
  static_assert(!std::is_copy_constructible_v<Timer> && std::is_nothrow_move_constructible_v<Timer>);
  Timer nothing;
  EXPECT_FALSE(nothing.stopped());
  EXPECT_EQ(nothing.cpuMilliseconds(), 0.0);
  EXPECT_FALSE(nothing.gpuMilliseconds());
  Timer timer = Timer::start();
  timer.stop();
  const double before = *timer.gpuMilliseconds();
  nothing = std::move(timer);
  EXPECT_TRUE(nothing.stopped());
  EXPECT_EQ(*nothing.gpuMilliseconds(), before);
}

} // namespace
} // namespace gnomon::gl
