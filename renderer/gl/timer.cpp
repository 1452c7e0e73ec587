#include "renderer/gl/timer.h"

namespace gnomon::gl {

/// A point of the device's time: when all work that was handed to it before is done.
Timer::Query Timer::mark() {
  GLint bits = 0;
  glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  if (bits == 0) return {};
  GLuint id = 0;
  glCreateQueries(GL_TIMESTAMP, 1, &id);
  glQueryCounter(id, GL_TIMESTAMP);
  return Query(id);
}

Timer Timer::start() {
  Timer timer;
  timer.gpuBegin_ = mark();
  timer.cpuBegin_ = Clock::now();
  return timer;
}

void Timer::stop() {
  cpuEnd_ = Clock::now();
  gpuEnd_ = mark();
  stopped_ = true;
}

double Timer::cpuMilliseconds() const {
  return std::chrono::duration<double, std::milli>(cpuEnd_ - cpuBegin_).count();
}

std::optional<double> Timer::gpuMilliseconds() const {
  if (gpuBegin_.get() == 0 || gpuEnd_.get() == 0) return std::nullopt;
  GLuint64 begin = 0;
  GLuint64 end = 0;
  glGetQueryObjectui64v(gpuBegin_.get(), GL_QUERY_RESULT, &begin);
  glGetQueryObjectui64v(gpuEnd_.get(), GL_QUERY_RESULT, &end);
  return end > begin ? static_cast<double>(end - begin) * 1e-6 : 0.0;
}

} // namespace gnomon::gl
