#include <chrono>
#include <thread>

#include "gl_fixture.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/program.h"
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

class StageClocks : public GlTest {};

TEST_F(StageClocks, bookEachStageOnceInOrder) {
  StageClock clock;
  clock.finish("shadow");
  clock.finish("shade");
  clock.finish("shadow");
  const std::vector<StageTime> stages = clock.take();
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_EQ(stages[0].stage, "shadow");
  EXPECT_EQ(stages[1].stage, "shade");
  EXPECT_GE(stages[0].milliseconds, 0);
  EXPECT_THAT(clock.take(), testing::IsEmpty());
}

double elapsed(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

TEST_F(StageClocks, addUpToTheTimeThatPassed) {
  const auto begin = std::chrono::steady_clock::now();
  StageClock clock;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  clock.finish("first");
  std::this_thread::sleep_for(std::chrono::milliseconds(15));
  clock.finish("second");
  const std::vector<StageTime> stages = clock.take();
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_GE(stages[0].milliseconds, 5);
  EXPECT_GE(stages[1].milliseconds, 15);
  EXPECT_LE(stages[0].milliseconds + stages[1].milliseconds, elapsed(begin));
}

/// `times` times some hundred milliseconds of work for a software driver, or one for a GPU.
void drawSlowly(const Framebuffer& target, const Program& slow, int times) {
  const PipelineState state{.framebuffer = target.id(), .viewport = {0, 0, 256, 256}};
  for (int i = 0; i < times; ++i) drawFullscreen(slow, state);
}

/// How often it must draw for the device to be busy for 50 ms.
int timesToBeBusy(const Framebuffer& target, const Program& slow) {
  for (int times = 1;; times *= 2) {
    Timer timer = Timer::start();
    drawSlowly(target, slow, times);
    timer.stop();
    if (timer.gpuMilliseconds().value_or(50) >= 50) return times;
  }
}

TEST_F(StageClocks, bookDeviceTimeForTheStageThatAskedForIt) {
  ProgramText text;
  text.vertex = "void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }";
  text.fragment = R"(
layout(location = 0) out vec4 color;
void main() {
  color = gl_FragCoord / 256.0;
  for (int i = 0; i < 500; ++i) color = sin(color.yzwx * 3.0);
})";
  const Program slow = *Program::create(text, "slow");
  const Texture texture({.width = 256, .height = 256}, "slow");
  const Framebuffer target = *Framebuffer::create({{{.texture = &texture}}, {}}, "slow");
  std::vector<std::byte> texels(256 * 256 * 4);
  // What the driver does once is no part of it.
  const int times = timesToBeBusy(target, slow);
  target.readColor(0, {0, 0, 256, 256}, {GL_RGBA, GL_UNSIGNED_BYTE}, texels);

  StageClock clock;
  const auto begin = std::chrono::steady_clock::now();
  drawSlowly(target, slow, times);
  clock.finishDrawing("draw");
  const double waited = elapsed(begin);
  target.readColor(0, {0, 0, 256, 256}, {GL_RGBA, GL_UNSIGNED_BYTE}, texels);
  clock.finish("read");
  const std::vector<StageTime> stages = clock.take();
  ASSERT_EQ(stages.size(), 2u);
  EXPECT_GT(stages[0].milliseconds, 2 * stages[1].milliseconds) << "the device draws while the processor reads";
  EXPECT_LT(waited, stages[0].milliseconds / 2) << "and nothing waits for it to end the stage";
}

} // namespace
} // namespace gnomon::gl
