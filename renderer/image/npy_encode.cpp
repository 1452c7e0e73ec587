#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/zip.h"
#include "renderer/core/parallel.h"
#include "renderer/image/deflate_stripe.h"
#include "renderer/image/image.h"
#include "renderer/image/picture_encode.h"

// "The NPY format", numpy.org/doc/stable/reference/generated/numpy.lib.format.html
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

constexpr std::size_t kEntryStripeBytes = std::size_t{1} << 18; ///< deflated on their own
constexpr int kEntryLevel = 2;                                  ///< of deflateStripe: quick

std::vector<Bytes> deflatedStripes(std::span<const std::uint8_t> content) {
  std::vector<Bytes> stripes((content.size() + kEntryStripeBytes - 1) / kEntryStripeBytes);
  forEachPiece(content.size(), kEntryStripeBytes, [&](std::size_t first, std::size_t last) {
    stripes[first / kEntryStripeBytes] = deflateStripe(content.subspan(first, last - first), kEntryLevel);
  });
  stripes.emplace_back(std::begin(kDeflateEnd), std::end(kDeflateEnd));
  return stripes;
}

void putAll(Bytes& bytes, std::span<const std::uint8_t> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

Status checkFits(std::size_t bytes) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (bytes < kMost) return Done{};
  return Problem{ProblemCode::tooLarge, "", "The frame's ZIP would be too large: fewer views or pixels are less.",
                 std::to_string(kMost - 1) + " bytes", std::to_string(bytes) + " bytes"};
}

} // namespace

Result<Bytes> encodeNpy(const Image& image, ArrayNumbers numbers) {
  const auto* bytes = pixelsAs<std::uint8_t>(image);
  const auto* floats = pixelsAs<float>(image);
  if (!bytes && !floats) {
    return Problem{ProblemCode::internal, "", "An array needs an image of bytes or floats of its own size."};
  }
  if (bytes) return npyFile(image, "|u1", *bytes);
  if (numbers == ArrayNumbers::int32) return npyFile(image, "<i4", wholeNumbers(*floats));
  return hasAlpha(image) ? npyFile(image, "<f4", associated(image)) : npyFile(image, "<f4", *floats);
}

Status ZipWriter::add(std::string_view name, std::span<const std::uint8_t> content) {
  constexpr std::size_t kHeaderBytes = 128; // more than the two headers of an entry take without its name
  if (Status fits = checkFits(content.size()); !fits) return fits;
  const std::vector<Bytes> stripes = deflatedStripes(content);
  std::size_t packed = 0;
  for (const Bytes& stripe : stripes) packed += stripe.size();
  const bool deflated = packed < content.size();
  if (!deflated) packed = content.size();
  const std::size_t heads = directory_.size() + kHeaderBytes + 2 * name.size();
  if (Status fits = checkFits(file_.size() + packed + heads); !fits) return fits;

  const ZipFile file{.name = name,
                     .crc32 = crc32Of(content),
                     .bytes = static_cast<std::uint32_t>(content.size()),
                     .packedBytes = static_cast<std::uint32_t>(packed),
                     .isDeflated = deflated};
  directory_ += zipDirectoryEntry(file, file_.size());
  ++files_;
  putAll(file_, asBytes(zipHead(file)));
  if (!deflated) putAll(file_, content);
  for (const Bytes& stripe : stripes) {
    if (deflated) putAll(file_, stripe);
  }
  return Done{};
}

Result<Bytes> ZipWriter::finish() && {
  const std::string tail = directory_ + zipEnd(files_, directory_.size(), file_.size());
  if (Status fits = checkFits(file_.size() + tail.size()); !fits) return std::move(fits).problems();
  putAll(file_, asBytes(tail));
  return std::move(file_);
}

} // namespace gnomon
