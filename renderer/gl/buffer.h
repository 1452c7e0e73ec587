#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "renderer/gl/object.h"

namespace gnomon::gl {

/// The bytes of plain values, as they lie in memory.
template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(std::span(values));
}
template <class T>
std::span<const std::byte> bytesOfValue(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(std::span(&value, 1));
}

/// A buffer of fixed size. A size of 0 is allowed and may be bound: the storage then has 16 bytes of zeros.
class Buffer {
 public:
  Buffer() = default;
  /// Never changed again.
  Buffer(std::span<const std::byte> contents, std::string_view label);
  /// Changed by `update`; zeros at first.
  Buffer(std::size_t bytes, std::string_view label);

  GLuint id() const { return object_.get(); }
  std::size_t bytes() const { return bytes_; }

  /// REQUIRES: made with a size, and offset + contents within it.
  void update(std::size_t offset, std::span<const std::byte> contents);
  /// The bytes from `offset` on. Waits for the GPU. REQUIRES: offset + contents within it.
  void read(std::size_t offset, std::span<std::byte> contents) const;

  void bindUniform(GLuint slot) const;
  void bindStorage(GLuint slot) const;

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteBuffers(1, &id); }
  };
  Object<Delete{}> object_;
  std::size_t bytes_ = 0;
};

} // namespace gnomon::gl
