#include "server/wire/bundle.h"

#include <algorithm>
#include <array>

#include "protocol/base/bytes.h"
#include "protocol/base/text.h"

namespace gnomon {
namespace {

constexpr std::string_view kMagic = "gnomon bundle 1\n";
constexpr std::size_t kNameLength = 4;
constexpr std::size_t kContentLength = 8;

template <std::size_t N>
std::array<std::uint8_t, N> littleEndianBytes(std::uint64_t value) {
  std::array<std::uint8_t, N> bytes;
  for (std::size_t i = 0; i < N; ++i) {
    bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
  return bytes;
}

Problem brokenBundle() {
  return {ProblemCode::malformed, "", "The stored bundle is damaged.", "", ""};
}

} // namespace

void writeBundle(const SceneBundle& bundle, const std::function<void(std::span<const std::uint8_t>)>& sink) {
  if (bundle.files.empty()) {
    sink(bundle.model);
    return;
  }
  const auto entry = [&](std::string_view name, const Bytes& content) {
    sink(littleEndianBytes<kNameLength>(name.size()));
    sink(littleEndianBytes<kContentLength>(content.size()));
    sink(asBytes(name));
    sink(content);
  };
  sink(asBytes(kMagic));
  entry("", bundle.model);
  for (const auto& [name, content] : bundle.files) {
    entry(name, content);
  }
}

Result<SceneBundle> readBundle(Bytes bytes, const Limits& limits) {
  SceneBundle bundle;
  std::span<const std::uint8_t> rest(bytes);
  if (rest.size() < kMagic.size() || !std::equal(kMagic.begin(), kMagic.end(), rest.begin())) {
    bundle.model = std::move(bytes);
    return bundle;
  }
  rest = rest.subspan(kMagic.size());
  for (std::size_t entries = 0; !rest.empty(); ++entries) {
    if (rest.size() < kNameLength + kContentLength || entries > limits.maxBundleFiles) return brokenBundle();
    const std::uint64_t nameLength = littleEndian(rest.first(kNameLength));
    const std::uint64_t contentLength = littleEndian(rest.subspan(kNameLength, kContentLength));
    rest = rest.subspan(kNameLength + kContentLength);
    if (nameLength > rest.size() || contentLength > rest.size() - nameLength) return brokenBundle();
    const std::string name(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(nameLength));
    const auto content = rest.subspan(nameLength, contentLength);
    rest = rest.subspan(nameLength + contentLength);
    if (entries == 0) {
      if (!name.empty()) return brokenBundle();
      bundle.model.assign(content.begin(), content.end());
      continue;
    }
    const bool ascends = bundle.files.empty() || bundle.files.rbegin()->first < name;
    if (!ascends || !isBundleFileName(name)) return brokenBundle();
    bundle.files.emplace(name, Bytes(content.begin(), content.end()));
  }
  if (bundle.files.empty()) { // a model alone is its own bytes
    return brokenBundle();
  }
  return bundle;
}

bool isBundleFileName(std::string_view name) {
  if (name.empty() || name.size() > 255 || name.find_first_of("\\:") != std::string_view::npos ||
      std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; })) {
    return false;
  }
  const std::vector<std::string> segments = splitTrimmed(name, '/');
  return std::none_of(segments.begin(), segments.end(),
                      [](const std::string& segment) { return segment.empty() || segment == "." || segment == ".."; });
}

} // namespace gnomon
