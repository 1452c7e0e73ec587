#include "renderer/gl/query.h"

namespace gnomon::gl {
namespace {

GLuint makeQuery(GLenum target, std::string_view label) {
  GLuint id = 0;
  glCreateQueries(target, 1, &id);
  setLabel(GL_QUERY, id, label);
  return id;
}

} // namespace

Query::Query(GLenum target, std::string_view label) : object_(makeQuery(target, label)), target_(target) {}

void Query::begin() {
  glBeginQuery(target_, id());
}

void Query::end() {
  glEndQuery(target_);
}

std::uint64_t Query::result() const {
  GLuint64 value = 0;
  glGetQueryObjectui64v(id(), GL_QUERY_RESULT, &value);
  return value;
}

} // namespace gnomon::gl
