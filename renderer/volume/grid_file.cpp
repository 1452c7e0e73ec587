#include "renderer/volume/grid_file.h"

#include <string_view>

#include "protocol/base/bytes.h"
#include "renderer/volume/npy.h"
#include "renderer/volume/vdb_file.h"

namespace gnomon {
namespace {

constexpr std::string_view kNumPy = "\x93NUMPY";
constexpr std::string_view kOpenVdb = " BDV";

} // namespace

Result<DensityGrid> readGridFile(std::span<const std::uint8_t> file, const std::string& name) {
  const std::string_view text = asText(file);
  if (text.starts_with(kOpenVdb)) return readVdb(file, name);
  if (!text.starts_with(kNumPy)) {
    return Problem{ProblemCode::unsupportedFeature, "", "The file of a volume is of no kind that is read.",
                   "NumPy's .npy, OpenVDB's .vdb", ""};
  }
  if (!name.empty()) {
    return Problem{ProblemCode::invalidValue, "", "A .npy file has one grid, which has no name.", "no name",
                   name.substr(0, 40)};
  }
  return readNpy(file);
}

} // namespace gnomon
