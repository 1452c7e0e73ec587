#pragma once

#include <string>
#include <vector>

#include "protocol/base/bytes.h"

namespace gnomon::cli {

/// An encoded picture.
struct Picture {
  std::string view; ///< its name; of an EXR, which holds every view, the first one's
  Bytes file;       ///< PNG or EXR
};

/// What a frame gives, wherever it was rendered: the same spec gives the same pictures here and there.
struct Rendered {
  std::vector<Picture> pictures; ///< one per view as PNG, one for all as EXR
  std::string reportJson;
};

} // namespace gnomon::cli
