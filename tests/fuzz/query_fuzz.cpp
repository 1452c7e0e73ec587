// A request's target: path, query, and the frame spec that the query gives.
#include "protocol/json/json_codec.h"
#include "server/http/url.h"
#include "tests/fuzz/sound_problems.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const auto url = parseTarget({reinterpret_cast<const char*>(data), size});
  if (!url) {
    fuzz::requireSound(url.problems());
    return 0;
  }
  for (const std::string& segment : url->path) {
    fuzz::require(segment != ".." && segment != ".", "no path leads upwards");
  }
  const auto spec = decodeFrameQuery(url->query);
  if (!spec) fuzz::requireSound(spec.problems());
  return 0;
}
