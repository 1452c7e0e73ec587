#pragma once

#include <optional>
#include <string_view>

namespace gnomon {

enum class GridFileKind { numPy, openVdb };

/// The format of a file with the grid of a volume, by its first bytes; nothing for other files.
inline std::optional<GridFileKind> gridFileKind(std::string_view file) {
  if (file.starts_with("\x93NUMPY")) return GridFileKind::numPy;
  if (file.starts_with(" BDV")) return GridFileKind::openVdb;
  return std::nullopt;
}

} // namespace gnomon
