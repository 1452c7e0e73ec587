#include "renderer/gl/timer.h"

#include <algorithm>
#include <utility>

#include "renderer/gl/draw.h"

namespace gnomon::gl {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

/// The processor's time at which the device's clock stood at 0. REQUIRES: the driver has a timer.
Clock::time_point zeroOfDevice() {
  GLint64 device = 0;
  const auto before = Clock::now();
  glGetInteger64v(GL_TIMESTAMP, &device);
  const auto after = Clock::now();
  return before + (after - before) / 2 - std::chrono::nanoseconds(device);
}

} // namespace

Timestamp Timestamp::now() {
  GLint bits = 0;
  glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  if (bits == 0) return {};
  GLuint id = 0;
  glCreateQueries(GL_TIMESTAMP, 1, &id);
  glQueryCounter(id, GL_TIMESTAMP);
  Timestamp timestamp;
  timestamp.query_ = Object<DeleteQuery{}>(id);
  return timestamp;
}

std::optional<GLuint64> Timestamp::nanoseconds() const {
  if (query_.get() == 0) return std::nullopt;
  GLuint64 time = 0;
  glGetQueryObjectui64v(query_.get(), GL_QUERY_RESULT, &time);
  return time;
}

Timer Timer::start() {
  Timer timer;
  timer.gpuBegin_ = Timestamp::now();
  timer.cpuBegin_ = Clock::now();
  return timer;
}

void Timer::stop() {
  cpuEnd_ = Clock::now();
  gpuEnd_ = Timestamp::now();
  stopped_ = true;
}

double Timer::cpuMilliseconds() const {
  return milliseconds(cpuEnd_ - cpuBegin_);
}

std::optional<double> Timer::gpuMilliseconds() const {
  const auto begin = gpuBegin_.nanoseconds();
  const auto end = gpuEnd_.nanoseconds();
  if (!begin || !end) return std::nullopt;
  return *end > *begin ? static_cast<double>(*end - *begin) * 1e-6 : 0.0;
}

void StageClock::finish(std::string stage) {
  ends_.push_back({std::move(stage), Clock::now(), {}});
}

void StageClock::finishDrawing(std::string stage) {
  const auto cpu = Clock::now();
  ends_.push_back({std::move(stage), cpu, Timestamp::now()});
  submit(); // a driver that gathers work would pass the point only with the next stage's
}

std::vector<StageTime> StageClock::take() {
  waitUnlessStopped();
  std::vector<StageTime> stages;
  std::optional<Clock::time_point> zero;
  auto begin = begin_;
  for (const End& end : ends_) {
    auto last = std::max(begin, end.cpu);
    if (const auto device = end.gpu.nanoseconds()) {
      if (!zero) zero = zeroOfDevice();
      last = std::max(last, std::min(*zero + std::chrono::nanoseconds(*device), Clock::now()));
    }
    const double time = milliseconds(last - std::exchange(begin, last));
    const auto same = std::ranges::find(stages, end.stage, &StageTime::stage);
    if (same != stages.end()) {
      same->milliseconds += time;
    } else {
      stages.push_back({end.stage, time});
    }
  }
  ends_.clear();
  begin_ = Clock::now();
  return stages;
}

} // namespace gnomon::gl
