// An upload: the first line is the Content-Type, what follows it the body. Bundles that it gives are stored and read
// back.
#include <algorithm>

#include "server/http/multipart.h"
#include "server/scenes/upload.h"
#include "server/wire/bundle.h"
#include "tests/fuzz/sound_problems.h"

namespace {

using namespace gnomon;

void requireKept(const SceneBundle& bundle) {
  for (const auto& [name, content] : bundle.files) {
    fuzz::require(isBundleFileName(name), "a file's name leads nowhere");
  }
  Bytes stored;
  writeBundle(bundle,
              [&](std::span<const std::uint8_t> bytes) { stored.insert(stored.end(), bytes.begin(), bytes.end()); });
  fuzz::require(stored.size() == packed(bundle)->bytes, "a bundle is as long as it says");
  (void)readBundle(stored);
}

void readStored(std::string_view text) {
  const auto bundle = readBundle(Bytes(text.begin(), text.end()));
  if (!bundle) return fuzz::requireSound(bundle.problems());
  Bytes stored;
  writeBundle(*bundle,
              [&](std::span<const std::uint8_t> bytes) { stored.insert(stored.end(), bytes.begin(), bytes.end()); });
  fuzz::require(std::equal(text.begin(), text.end(), stored.begin(), stored.end(),
                           [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }),
                "a bundle has one form");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  readStored(text);
  const std::size_t end = std::min(text.find('\n'), size);
  const auto boundary = boundaryOf(text.substr(0, end));
  if (!boundary) return 0;
  const auto parts = parseMultipart(text.substr(std::min(end + 1, size)), *boundary, kLimits.maxBundleFiles + 2);
  if (!parts) {
    fuzz::requireSound(parts.problems());
    return 0;
  }
  fuzz::require(parts->size() <= kLimits.maxBundleFiles + 2, "no more parts than may come");
  const auto bundle = bundleFromParts(*parts, {"spec"});
  if (bundle) {
    requireKept(*bundle);
  } else {
    fuzz::requireSound(bundle.problems());
  }
  return 0;
}
