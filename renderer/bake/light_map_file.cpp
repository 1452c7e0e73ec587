#include "renderer/bake/light_map_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace gnomon {
namespace {

constexpr std::string_view kForm = "gnomon light map 1\n";
constexpr std::size_t kNumbers = 4 + 4 + 8; ///< width, height, nanoseconds
constexpr std::size_t kHash = 64;
constexpr std::size_t kHead = kForm.size() + kNumbers + kHash;

void addNumber(Bytes& bytes, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

/// Of where the triangles lie, of the numbers, and of the shares as bytes.
std::string hashOf(const LightMapLayout& layout, std::span<const std::uint8_t> numbers,
                   std::span<const std::uint8_t> shares) {
  Sha256 hash;
  const std::span<const glm::vec2> corners = layout.corners;
  hash.add({reinterpret_cast<const std::uint8_t*>(corners.data()), corners.size_bytes()});
  const std::span<const std::size_t> first = layout.firstCorner;
  hash.add({reinterpret_cast<const std::uint8_t*>(first.data()), first.size_bytes()});
  hash.add(numbers);
  hash.add(shares);
  return hash.hex();
}

} // namespace

Bytes lightMapFile(const BakedLight& baked) {
  const LightMap& map = baked.map;
  Bytes shares;
  for (const LightMap* plane : {&map, &baked.greenAndBlue[0], &baked.greenAndBlue[1]}) {
    shares.reserve(shares.size() + plane->shares.size() * 2);
    for (const std::uint16_t share : plane->shares) addNumber(shares, share, 2);
  }
  Bytes numbers;
  addNumber(numbers, static_cast<std::uint64_t>(map.width), 4);
  addNumber(numbers, static_cast<std::uint64_t>(map.height), 4);
  addNumber(numbers, static_cast<std::uint64_t>(std::llround(baked.milliseconds * 1e6)), 8);
  const std::string hash = hashOf(*baked.layout, numbers, shares);
  Bytes file(kForm.begin(), kForm.end());
  file.reserve(kHead + shares.size());
  file.insert(file.end(), numbers.begin(), numbers.end());
  file.insert(file.end(), hash.begin(), hash.end());
  file.insert(file.end(), shares.begin(), shares.end());
  return file;
}

std::optional<BakedLight> readLightMapFile(std::span<const std::uint8_t> file,
                                           const std::shared_ptr<const LightMapLayout>& layout, BakedPlanes planes) {
  const auto texels = static_cast<std::size_t>(layout->width) * static_cast<std::size_t>(layout->height);
  const std::size_t count = planes == BakedPlanes::rgb ? 3 : 1;
  if (file.size() != kHead + 2 * texels * count || !asText(file).starts_with(kForm)) return std::nullopt;
  const auto numbers = file.subspan(kForm.size(), kNumbers);
  const auto hash = asText(file.subspan(kForm.size() + kNumbers, kHash));
  const auto shares = file.subspan(kHead);
  if (littleEndian(numbers.first(4)) != static_cast<std::uint64_t>(layout->width) ||
      littleEndian(numbers.subspan(4, 4)) != static_cast<std::uint64_t>(layout->height) ||
      hashOf(*layout, numbers, shares) != hash) {
    return std::nullopt;
  }
  BakedLight baked{layout, {}, 0};
  const std::array to{&baked.map, &baked.greenAndBlue[0], &baked.greenAndBlue[1]};
  for (std::size_t plane = 0; plane < count; ++plane) {
    *to[plane] = {layout->width, layout->height, std::vector<std::uint16_t>(texels)};
    for (std::size_t i = 0; i < texels; ++i) {
      to[plane]->shares[i] = static_cast<std::uint16_t>(littleEndian(shares.subspan(2 * (plane * texels + i), 2)));
    }
  }
  baked.milliseconds = static_cast<double>(littleEndian(numbers.subspan(8))) / 1e6;
  return baked;
}

} // namespace gnomon
