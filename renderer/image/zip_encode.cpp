#include "renderer/image/zip_encode.h"

#include <limits>
#include <vector>

#include "protocol/base/zip.h"
#include "renderer/core/parallel.h"
#include "renderer/image/deflate_stripe.h"

namespace gnomon {
namespace {

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
