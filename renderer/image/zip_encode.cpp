// "APPNOTE.TXT - .ZIP File Format Specification", 6.3.10, pkware.cachefly.net/webdocs/casestudies/APPNOTE.TXT
#include "renderer/image/zip_encode.h"

#include <algorithm>
#include <libdeflate.h>
#include <limits>

#include "renderer/core/parallel.h"
#include "renderer/image/deflate_stripe.h"

namespace gnomon {
namespace {

constexpr std::uint32_t kLocalHeader = 0x04034b50, kCentralHeader = 0x02014b50, kDirectoryEnd = 0x06054b50;
constexpr std::uint16_t kVersion = 20; ///< 2.0: deflate
constexpr std::uint16_t kStored = 0, kDeflated = 8;
constexpr std::uint16_t kTime = 0, kDate = 0x21; ///< midnight, 1 January 1980: the first that there is

constexpr std::size_t kEntryStripeBytes = std::size_t{1} << 18; ///< deflated on their own
constexpr int kEntryLevel = 2;                                  ///< of deflateStripe: quick

void put16(Bytes& bytes, std::uint32_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

void put32(Bytes& bytes, std::uint32_t value) {
  put16(bytes, value & 0xffffu);
  put16(bytes, value >> 16);
}

std::vector<Bytes> deflatedStripes(std::span<const std::uint8_t> content) {
  std::vector<Bytes> stripes((content.size() + kEntryStripeBytes - 1) / kEntryStripeBytes);
  forEachPiece(content.size(), kEntryStripeBytes, [&](std::size_t first, std::size_t last) {
    stripes[first / kEntryStripeBytes] = deflateStripe(content.subspan(first, last - first), kEntryLevel);
  });
  stripes.emplace_back(std::begin(kDeflateEnd), std::end(kDeflateEnd));
  return stripes;
}

/// What the local and the central header have in common, from the method on.
void putFacts(Bytes& out, std::uint16_t method, std::uint32_t checksum, std::uint32_t packedBytes, std::uint32_t bytes,
              std::size_t nameLength) {
  put16(out, method);
  put16(out, kTime);
  put16(out, kDate);
  put32(out, checksum);
  put32(out, packedBytes);
  put32(out, bytes);
  put16(out, static_cast<std::uint32_t>(nameLength));
  put16(out, 0); // no extra field
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
  if (Status fits = checkFits(file_.size() + packed + (entries_.size() + 1) * (kHeaderBytes + 2 * name.size()));
      !fits) {
    return fits;
  }

  const Entry& entry = entries_.emplace_back(
      Entry{std::string(name), libdeflate_crc32(0, content.data(), content.size()), static_cast<std::uint32_t>(packed),
            static_cast<std::uint32_t>(content.size()), static_cast<std::uint32_t>(file_.size()), deflated});
  put32(file_, kLocalHeader);
  put16(file_, kVersion);
  put16(file_, 0); // no flags
  putFacts(file_, deflated ? kDeflated : kStored, entry.checksum, entry.packedBytes, entry.bytes, name.size());
  file_.insert(file_.end(), name.begin(), name.end());
  if (!deflated) {
    file_.insert(file_.end(), content.begin(), content.end());
    return Done{};
  }
  for (const Bytes& stripe : stripes) file_.insert(file_.end(), stripe.begin(), stripe.end());
  return Done{};
}

Result<Bytes> ZipWriter::finish() && {
  Bytes directory;
  for (const Entry& entry : entries_) {
    put32(directory, kCentralHeader);
    put16(directory, kVersion); // made by
    put16(directory, kVersion); // needed
    put16(directory, 0);        // no flags
    putFacts(directory, entry.deflated ? kDeflated : kStored, entry.checksum, entry.packedBytes, entry.bytes,
             entry.name.size());
    put16(directory, 0); // no comment
    put16(directory, 0); // disk
    put16(directory, 0); // internal attributes
    put32(directory, 0); // external attributes
    put32(directory, entry.offset);
    directory.insert(directory.end(), entry.name.begin(), entry.name.end());
  }
  if (Status fits = checkFits(file_.size() + directory.size()); !fits) return std::move(fits).problems();
  const auto offset = static_cast<std::uint32_t>(file_.size());
  file_.insert(file_.end(), directory.begin(), directory.end());
  put32(file_, kDirectoryEnd);
  put16(file_, 0); // this disk
  put16(file_, 0); // the directory's
  put16(file_, static_cast<std::uint32_t>(entries_.size()));
  put16(file_, static_cast<std::uint32_t>(entries_.size()));
  put32(file_, static_cast<std::uint32_t>(directory.size()));
  put32(file_, offset);
  put16(file_, 0); // no comment
  return std::move(file_);
}

} // namespace gnomon
