#include "renderer/image/exr_encode.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "renderer/core/stop.h"

namespace gnomon {
namespace {

/// Pinned, so that equal pictures have equal bytes.
constexpr const char* kDateTime = "2000:01:01 00:00:00";
constexpr const char* kSoftware = "Gnomon";

/// A file in memory: a process may write it that may open none.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}

  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, bytes, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

Imf::Compression compressionOf(ExrCompression compression) {
  switch (compression) {
    case ExrCompression::none:
      return Imf::NO_COMPRESSION;
    case ExrCompression::rle:
      return Imf::RLE_COMPRESSION;
    case ExrCompression::zip:
      return Imf::ZIP_COMPRESSION;
    case ExrCompression::piz:
      return Imf::PIZ_COMPRESSION;
  }
  return Imf::NO_COMPRESSION;
}

Imf::Header headerOf(const ExrPart& part, const ExrPart& first, ExrCompression compression) {
  const auto window = [](const ExrPart& of) {
    return Imath::Box2i(Imath::V2i(0, 0), Imath::V2i(of.width - 1, of.height - 1));
  };
  Imf::Header header(window(first), window(part));
  header.compression() = compressionOf(compression);
  header.setName(part.name);
  header.setType(Imf::SCANLINEIMAGE);
  Imf::addCapDate(header, kDateTime);
  header.insert("Software", Imf::StringAttribute(kSoftware));
  for (std::size_t i = 0; i < part.channels.size(); ++i) {
    header.channels().insert(part.channels[i], Imf::Channel(part.half[i] ? Imf::HALF : Imf::FLOAT));
  }
  return header;
}

/// Rows that are compressed at a time.
constexpr int kRows = 64;

/// The next rows, from `y` on. `halves`: room for kRows rows of every channel.
void writeRows(Imf::OutputPart& output, const ExrPart& part, int y, std::vector<half>& halves) {
  const std::size_t channels = part.channels.size();
  const std::size_t row = static_cast<std::size_t>(part.width) * channels;
  const int rows = std::min(kRows, part.height - y);
  const float* const first = part.pixels.data() + static_cast<std::size_t>(y) * row;
  halves.resize(row * kRows);
  std::copy_n(first, row * static_cast<std::size_t>(rows), halves.begin());
  const auto slice = [&](const auto* pixels, Imf::PixelType type) { // as if row 0 were there, too
    using Number = std::remove_cvref_t<decltype(*pixels)>;
    auto* base = const_cast<char*>(reinterpret_cast<const char*>(pixels));
    return Imf::Slice(type, base - static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * row * sizeof(Number)),
                      channels * sizeof(Number), row * sizeof(Number));
  };
  Imf::FrameBuffer frame;
  for (std::size_t i = 0; i < channels; ++i) {
    frame.insert(part.channels[i], part.half[i] ? slice(halves.data() + i, Imf::HALF) : slice(first + i, Imf::FLOAT));
  }
  output.setFrameBuffer(frame);
  output.writePixels(rows);
}

} // namespace

Result<Bytes> encodeExrParts(std::span<const ExrPart> parts, ExrCompression compression) {
  try {
    std::vector<Imf::Header> headers;
    for (const ExrPart& part : parts) headers.push_back(headerOf(part, parts[0], compression));
    MemoryStream stream;
    {
      constexpr int kThreads = 0; // none of its own: whole requests run side by side instead
      Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(parts.size()), false, kThreads);
      std::vector<half> halves;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        Imf::OutputPart output(file, static_cast<int>(i));
        for (int y = 0; y < parts[i].height; y += kRows) {
          stopIfAsked();
          writeRows(output, parts[i], y, halves);
        }
      }
    }
    return stream.take();
  } catch (const std::exception& error) {
    return Problem{ProblemCode::internal, "", std::string("The EXR could not be written: ") + error.what() + ".", "",
                   ""};
  }
}

} // namespace gnomon
