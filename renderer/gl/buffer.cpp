#include "renderer/gl/buffer.h"

#include <array>
#include <cassert>

#include "renderer/gl/draw.h"

namespace gnomon::gl {
namespace {

GLuint makeBuffer(std::string_view label) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  setLabel(GL_BUFFER, id, label);
  return id;
}

void allocate(GLuint id, std::span<const std::byte> contents, GLbitfield flags) {
  static constexpr std::array<std::byte, 16> kZeros{}; // OpenGL has no storage of size 0
  if (contents.empty()) contents = kZeros;
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(contents.size()), contents.data(), flags);
}

} // namespace

Buffer::Buffer(std::span<const std::byte> contents, std::string_view label)
    : object_(makeBuffer(label)), bytes_(contents.size()) {
  allocate(id(), contents, 0);
}

// Zeros come with the storage: NVIDIA's driver 580 lets a glClearNamedBufferData of fresh storage undo the update after
// it.
Buffer::Buffer(std::size_t bytes, std::string_view label) : object_(makeBuffer(label)), bytes_(bytes) {
  allocate(id(), std::vector<std::byte>(bytes), GL_DYNAMIC_STORAGE_BIT);
}

void Buffer::update(std::size_t offset, std::span<const std::byte> contents) {
  assert(offset <= bytes_ && contents.size() <= bytes_ - offset);
  if (contents.empty()) return;
  glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(contents.size()), contents.data());
}

void Buffer::read(std::size_t offset, std::span<std::byte> contents) const {
  assert(offset <= bytes_ && contents.size() <= bytes_ - offset);
  if (contents.empty()) return;
  waitUnlessStopped();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); // shaders may have written it
  glGetNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(contents.size()),
                          contents.data());
}

void Buffer::bindUniform(GLuint slot) const {
  glBindBufferBase(GL_UNIFORM_BUFFER, slot, id());
}

void Buffer::bindStorage(GLuint slot) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot, id());
}

} // namespace gnomon::gl
