#include "renderer/gl/debug_log.h"

#include <exception>

#include "renderer/gl/object.h"

namespace gnomon::gl {
namespace {

constexpr std::size_t kMostMessages = 64;
/// A lost context may report its error for ever.
constexpr int kMostErrorCodes = 16;

struct Log {
  std::vector<std::string> messages;
  std::size_t dropped = 0;
};
thread_local Log threadLog;

std::string errorName(GLenum code) {
  switch (code) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_STACK_UNDERFLOW:
      return "GL_STACK_UNDERFLOW";
    case GL_STACK_OVERFLOW:
      return "GL_STACK_OVERFLOW";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST";
    default:
      return "error " + std::to_string(code);
  }
}

// Debug output is synchronous, so this is the thread whose call is complained of.
void GLAPIENTRY record(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* message,
                       const void*) {
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
  const bool wrong = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
  if (!wrong && severity != GL_DEBUG_SEVERITY_HIGH) return;
  if (threadLog.messages.size() == kMostMessages) {
    ++threadLog.dropped;
    return;
  }
  try { // no exception may cross the driver
    threadLog.messages.emplace_back(message, length < 0 ? std::char_traits<char>::length(message) : length);
  } catch (const std::exception&) {
    ++threadLog.dropped;
  }
}

} // namespace

Problem backendProblem(std::string detail) {
  Problem problem;
  problem.code = ProblemCode::backend;
  problem.detail = std::move(detail);
  return problem;
}

void recordDebugMessages() {
  threadLog = {};
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(record, nullptr);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
}

std::vector<std::string> takeDebugErrors() {
  std::vector<std::string> codes;
  for (int i = 0; i < kMostErrorCodes && glGetError != nullptr; ++i) {
    const GLenum code = glGetError();
    if (code == GL_NO_ERROR) break;
    codes.push_back(errorName(code));
  }
  Log log = std::exchange(threadLog, {});
  if (log.messages.empty()) log.messages = std::move(codes); // else the messages say the same better
  if (log.dropped > 0) log.messages.push_back("and " + std::to_string(log.dropped) + " more");
  return std::move(log.messages);
}

Status checkErrors(std::string_view doing) {
  const std::vector<std::string> errors = takeDebugErrors();
  if (errors.empty()) return Done{};
  std::string detail = "OpenGL complained while " + std::string(doing) + ": ";
  for (std::size_t i = 0; i < errors.size(); ++i) detail += (i > 0 ? "; " : "") + errors[i];
  return backendProblem(detail);
}

} // namespace gnomon::gl
