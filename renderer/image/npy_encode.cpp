// "The NPY format", numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include "renderer/image/npy_encode.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

#include "renderer/image/associated_alpha.h"

namespace gnomon {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::string_view kNpyBegin("\x93NUMPY\x01\x00", 8); ///< with the version
constexpr std::size_t kDataAlignment = 64;                    ///< of the data in the file

std::string npyHeader(const Image& image, std::string_view type) {
  std::string shape = std::to_string(image.height) + ", " + std::to_string(image.width);
  if (image.channels.size() > 1) shape += ", " + std::to_string(image.channels.size());
  std::string text = "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  const std::size_t before = kNpyBegin.size() + 2; // the header's length
  const std::size_t end = (before + text.size() + 1 + kDataAlignment - 1) / kDataAlignment * kDataAlignment;
  text.resize(end - before - 1, ' ');
  text += '\n';
  std::string header(kNpyBegin);
  header += static_cast<char>(text.size() & 0xff);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

template <class Number>
Bytes npyFile(const Image& image, std::string_view type, const std::vector<Number>& numbers) {
  const std::string header = npyHeader(image, type);
  Bytes file(header.size() + numbers.size() * sizeof(Number));
  std::memcpy(file.data(), header.data(), header.size());
  std::memcpy(file.data() + header.size(), numbers.data(), numbers.size() * sizeof(Number));
  return file;
}

std::vector<std::int32_t> wholeNumbers(const std::vector<float>& floats) {
  std::vector<std::int32_t> whole;
  whole.reserve(floats.size());
  for (const float number : floats) whole.push_back(static_cast<std::int32_t>(std::lround(number)));
  return whole;
}

} // namespace

Result<Bytes> encodeNpy(const Image& image, ArrayNumbers numbers) {
  const auto* bytes = pixelsAs<std::uint8_t>(image);
  const auto* floats = pixelsAs<float>(image);
  if (!bytes && !floats) {
    return Problem{ProblemCode::internal, "", "An array needs an image of bytes or floats of its own size.", "", ""};
  }
  if (bytes) return npyFile(image, "|u1", *bytes);
  if (numbers == ArrayNumbers::int32) return npyFile(image, "<i4", wholeNumbers(*floats));
  return hasAlpha(image) ? npyFile(image, "<f4", associated(image)) : npyFile(image, "<f4", *floats);
}

} // namespace gnomon
