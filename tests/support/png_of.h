#pragma once

#include "renderer/image/picture_encode.h"
#include "renderer/render.h"

namespace gnomon::testing {

/// A view of a frame, whatever format its spec asks for.
inline Bytes pngOf(const Frame& frame, std::size_t index = 0) {
  return *encodePng(frame.images[index].image, frame.report.spec.output.pngCompression);
}

} // namespace gnomon::testing
