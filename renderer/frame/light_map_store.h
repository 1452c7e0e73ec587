#pragma once

#include <functional>
#include <optional>
#include <string>

#include "protocol/bake/bake.h"
#include "protocol/base/bytes.h"

/// Part of the door: see render.h.
namespace gnomon {

/// Where light maps outlive the process. A key is the scene's id, a hyphen, and 64 hexadecimal digits. What comes back
/// is checked before it is used. Any thread.
class LightMapStore {
 public:
  virtual ~LightMapStore() = default;

  virtual std::optional<Bytes> read(const std::string& key) = 0;         ///< nothing where there are none
  virtual void write(const std::string& key, const Bytes& lightMap) = 0; ///< as far as there is room
};

/// Called with the progress of a bake, its key left empty, by one thread at a time; false asks it to stop. Empty = not
/// reported.
using BakeListener = std::function<bool(const BakeStep&)>;

} // namespace gnomon
