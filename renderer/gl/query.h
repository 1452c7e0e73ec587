#pragma once

#include <cstdint>
#include <string_view>

#include "renderer/gl/object.h"

namespace gnomon::gl {

/// Counts what happens between begin and end. One query of a target runs at a time.
class Query {
 public:
  Query() = default;
  /// `target`: GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED, GL_PRIMITIVES_GENERATED, GL_TIME_ELAPSED (nanoseconds).
  Query(GLenum target, std::string_view label);

  GLuint id() const { return object_.get(); }
  void begin();
  void end();
  /// Waits for the GPU. REQUIRES: ended.
  std::uint64_t result() const;

 private:
  struct Delete {
    void operator()(GLuint id) const { glDeleteQueries(1, &id); }
  };
  Object<Delete{}> object_;
  GLenum target_ = GL_SAMPLES_PASSED;
};

} // namespace gnomon::gl
