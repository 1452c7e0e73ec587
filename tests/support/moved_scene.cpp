#include "tests/support/moved_scene.h"

#include "tests/support/glb_builder.h"

namespace gnomon::testing {
namespace {

std::size_t word(const Bytes& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::size_t>(bytes.at(at + i)) << 8 * i;
  return value;
}

Bytes slice(const Bytes& bytes, std::size_t first, std::size_t count) {
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

} // namespace

Bytes movedBy(const Bytes& glb, const std::array<double, 3>& metres) {
  constexpr std::size_t kHeader = 12; // then the chunks: a length, a kind, the bytes
  const std::size_t length = word(glb, kHeader);
  const std::size_t binary = kHeader + 8 + length;
  const Bytes text = slice(glb, kHeader + 8, length);
  nlohmann::json json = nlohmann::json::parse(text.begin(), text.end());
  for (nlohmann::json& scene : json["scenes"]) {
    json["nodes"].push_back({{"translation", metres}, {"children", scene.at("nodes")}});
    scene["nodes"] = {json["nodes"].size() - 1};
  }
  return makeGlb(json.dump(), binary < glb.size() ? slice(glb, binary + 8, word(glb, binary)) : Bytes{});
}

} // namespace gnomon::testing
