#include "renderer/volume/grid_file.h"

#include "protocol/base/bytes.h"
#include "renderer/core/grid_file_kind.h"
#include "renderer/volume/npy.h"
#include "renderer/volume/vdb_file.h"

namespace gnomon {
Result<DensityGrid> readGridFile(std::span<const std::uint8_t> file, const std::string& name) {
  const auto kind = gridFileKind(asText(file));
  if (!kind) {
    return Problem{ProblemCode::unsupportedFeature, "", "The file of a volume is of no kind that is read.",
                   "NumPy's .npy, OpenVDB's .vdb", ""};
  }
  if (*kind == GridFileKind::openVdb) return readVdb(file, name);
  if (!name.empty()) {
    return Problem{ProblemCode::invalidValue, "", "A .npy file has one grid, which has no name.", "no name",
                   name.substr(0, 40)};
  }
  return readNpy(file);
}

} // namespace gnomon
