#pragma once

#include <optional>
#include <string_view>

namespace gnomon {

enum class GridFileKind { numPy, openVdb };

/// What a file that holds the grid of a volume says of itself in its first bytes; nothing for other files.
inline std::optional<GridFileKind> gridFileKind(std::string_view file) {
  if (file.starts_with("\x93NUMPY")) return GridFileKind::numPy;
  if (file.starts_with(" BDV")) return GridFileKind::openVdb;
  return std::nullopt;
}

} // namespace gnomon
