#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "protocol/base/result.h"
#include "renderer/scene/scene_bundle.h"

namespace gnomon {

/// Bytes that either lie in the bundle, which must outlive this, or were decoded from a data: URI.
class ResourceBytes {
 public:
  ResourceBytes() = default;
  explicit ResourceBytes(std::span<const std::uint8_t> borrowed) : bytes_(borrowed) {}
  explicit ResourceBytes(Bytes owned) : bytes_(std::move(owned)) {}

  std::span<const std::uint8_t> view() const;

 private:
  std::variant<std::span<const std::uint8_t>, Bytes> bytes_;
};

/// What a glTF's `uri` stands for: a data: URI or a file of the bundle. Everything else is refused: other schemes,
/// absolute paths, paths upwards. `pointer` is the URI's place in the glTF, for the problem.
Result<ResourceBytes> resolveUri(std::string_view uri, const SceneBundle& bundle, const std::string& pointer);

} // namespace gnomon
