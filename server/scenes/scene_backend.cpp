#include "server/scenes/scene_backend.h"

#include "protocol/base/text.h"

namespace gnomon {

Problem unknownScene(std::string_view id) {
  return {ProblemCode::notFound, "id", "No scene with this id is stored.", "", asciiExcerpt(id)};
}

} // namespace gnomon
