#include "renderer/gl/program.h"

#include <array>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/gl/debug_log.h"
#include "renderer/shaders/shader_sources.h"

namespace gnomon::gl {
namespace {

struct DeleteShader {
  void operator()(GLuint id) const { glDeleteShader(id); }
};
using Shader = Object<DeleteShader{}>;

/// "; 0 = view.frag, 1 = common_surface.glsl": the files behind the numbers in a log.
std::string legend(std::string_view text) {
  constexpr std::string_view kMark = "// source ";
  std::string legend;
  for (std::size_t at = text.find(kMark); at != std::string_view::npos; at = text.find(kMark, at + 1)) {
    const std::string_view line = text.substr(at + kMark.size(), text.find('\n', at) - at - kMark.size());
    const std::size_t colon = line.find(": ");
    if (colon == std::string_view::npos) continue;
    const std::string entry = std::string(line.substr(0, colon)) + " = " + std::string(line.substr(colon + 2));
    if (legend.find(entry) == std::string::npos) legend += (legend.empty() ? "; " : ", ") + entry;
  }
  return legend;
}

template <class Get, class GetLog>
std::string logOf(GLuint id, Get get, GetLog getLog) {
  GLint length = 0;
  get(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  GLsizei written = 0;
  getLog(id, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

std::string prologue(const std::vector<std::string>& defines) {
  std::string text = "#version 450 core\n";
  for (const std::string& define : defines) text += "#define " + define + "\n";
  return text;
}

Result<Shader> compile(GLenum stage, const std::string& prologue, std::string_view text, std::string_view label) {
  Shader shader(glCreateShader(stage));
  const std::string head = prologue + "#line 1 0\n";
  const std::array<const GLchar*, 2> parts{head.data(), text.data()};
  const std::array<GLint, 2> lengths{static_cast<GLint>(head.size()), static_cast<GLint>(text.size())};
  glShaderSource(shader.get(), 2, parts.data(), lengths.data());
  glCompileShader(shader.get());
  GLint done = GL_FALSE;
  glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &done);
  if (!done) {
    return backendProblem("a shader of \"" + std::string(label) + "\" does not compile: " +
                          logOf(shader.get(), glGetShaderiv, glGetShaderInfoLog) + legend(text));
  }
  return shader;
}

} // namespace

Result<Program> Program::create(const ProgramSource& source, std::string_view label) {
  ProgramText text{.vertex = {}, .fragment = {}, .defines = source.defines};
  Problems missing;
  const auto find = [&](const std::string& name) {
    const std::string_view found = shaderSource(name);
    if (found.empty() && !name.empty()) missing.push_back(backendProblem("there is no shader " + name));
    return std::string(found);
  };
  text.vertex = find(source.vertex);
  text.fragment = find(source.fragment);
  if (!missing.empty()) return missing;
  return create(text, label);
}

Result<Program> Program::create(const ProgramText& text, std::string_view label) {
  const std::string head = prologue(text.defines);
  Program program;
  program.object_ = Object<Delete{}>(glCreateProgram());
  setLabel(GL_PROGRAM, program.id(), label);
  std::vector<Shader> shaders;
  for (const auto& [stage, stageText] : {std::pair<GLenum, const std::string&>(GL_VERTEX_SHADER, text.vertex),
                                         std::pair<GLenum, const std::string&>(GL_FRAGMENT_SHADER, text.fragment)}) {
    if (stageText.empty()) continue;
    Result<Shader> shader = compile(stage, head, stageText, label);
    if (!shader) return std::move(shader).problems();
    glAttachShader(program.id(), shader->get());
    shaders.push_back(*std::move(shader));
  }
  if (shaders.empty()) return backendProblem("the program \"" + std::string(label) + "\" has no shader");
  glLinkProgram(program.id());
  for (const Shader& shader : shaders) glDetachShader(program.id(), shader.get());
  GLint done = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &done);
  if (!done) {
    return backendProblem("the program \"" + std::string(label) +
                          "\" does not link: " + logOf(program.id(), glGetProgramiv, glGetProgramInfoLog));
  }
  return program;
}

void Program::use() const {
  glUseProgram(id());
}

void Program::set(GLint location, int value) const {
  glProgramUniform1i(id(), location, value);
}
void Program::set(GLint location, const glm::ivec2& value) const {
  glProgramUniform2iv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::ivec4& value) const {
  glProgramUniform4iv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::vec2& value) const {
  glProgramUniform2fv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::vec4& value) const {
  glProgramUniform4fv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(id(), location, 1, GL_FALSE, glm::value_ptr(value));
}

} // namespace gnomon::gl
