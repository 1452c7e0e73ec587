#pragma once

#include <map>
#include <string>

#include "protocol/base/bytes.h"

namespace gnomon {

/// An uploaded model and the files that it names.
struct SceneBundle {
  Bytes model;                        ///< a GLB or glTF JSON
  std::map<std::string, Bytes> files; ///< by the name that the model uses, percent-decoded; never a path upwards
  bool strict = false;                ///< refused where it violates glTF, instead of repaired
};

} // namespace gnomon
