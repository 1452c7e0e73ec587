#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "renderer/scene/findings.h"

namespace gnomon {

/// The two parts of a model file; both look into the file's bytes.
struct ModelContainer {
  std::string_view json;
  std::optional<std::span<const std::uint8_t>> binary; ///< the GLB's BIN chunk
};

/// Distinguishes GLB and JSON by the first bytes and checks every length of a GLB; the problem names other kinds of
/// files.
Result<ModelContainer> openContainer(const Bytes& model, Findings& findings);

} // namespace gnomon
