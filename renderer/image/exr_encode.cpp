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
#include <array>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <variant>
#include <vector>

#include "renderer/core/stop.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {

namespace {

Problem mistake(const std::string& detail) {
  return {ProblemCode::internal, "", detail};
}

/// Null where the layer is not a float image whose pixels match its size and channels.
const std::vector<float>* floatsOf(const ImageLayer& layer) {
  return layer.image ? pixelsAs<float>(*layer.image) : nullptr;
}

bool isColor(const std::string& channel) {
  return channel == "R" || channel == "G" || channel == "B";
}

/// Copies `layer` into the channels of `part` that begin at `firstChannel`.
void placeLayer(ExrPart& part, std::size_t firstChannel, const Image& layer, const std::vector<float>& source) {
  const std::size_t stride = part.channels.size();
  const std::size_t channelCount = layer.channels.size();
  const auto alpha =
      static_cast<std::size_t>(std::find(layer.channels.begin(), layer.channels.end(), "A") - layer.channels.begin());
  for (std::size_t channel = 0; channel < channelCount; ++channel) {
    const bool associate = alpha < channelCount && isColor(layer.channels[channel]);
    float* target = part.pixels.data() + firstChannel + channel;
    for (std::size_t from = 0; from < source.size(); from += channelCount, target += stride) {
      *target = associate ? source[from + channel] * source[from + alpha] : source[from + channel];
    }
  }
}

bool hasDuplicates(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return std::adjacent_find(names.begin(), names.end()) != names.end();
}

/// The layers of one size, as one part.
ExrPart makePart(const std::vector<const ImageLayer*>& layers, ExrPixelType pixelType) {
  const ImageLayer& first = *layers.front();
  ExrPart part{first.name.empty() ? "main" : first.name, first.image->width, first.image->height, {}, {}, {}};
  for (const ImageLayer* layer : layers) {
    for (const std::string& channel : layer->image->channels) {
      part.channels.push_back(layer->name.empty() ? channel : layer->name + "." + channel);
      part.half.push_back(pixelType == ExrPixelType::half && !layer->wide);
    }
  }
  part.pixels.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height) *
                     part.channels.size());
  std::size_t firstChannel = 0;
  for (const ImageLayer* layer : layers) {
    placeLayer(part, firstChannel, *layer->image, *floatsOf(*layer));
    firstChannel += layer->image->channels.size();
  }
  return part;
}

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

constexpr std::array kCompressions{Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION,
                                   Imf::PIZ_COMPRESSION}; ///< in the order of ExrCompression

Imf::Header headerOf(const ExrPart& part, const ExrPart& first, ExrCompression compression) {
  const auto window = [](const ExrPart& of) {
    return Imath::Box2i(Imath::V2i(0, 0), Imath::V2i(of.width - 1, of.height - 1));
  };
  Imf::Header header(window(first), window(part));
  header.compression() = kCompressions[static_cast<std::size_t>(compression)];
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

/// All share one display window, that of the first.
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
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return Problem{ProblemCode::internal, "", std::string("The EXR could not be written: ") + error.what() + "."};
  }
}

} // namespace

Result<std::vector<ExrPart>> exrParts(std::span<const ImageLayer> layers, ExrPixelType pixelType) {
  if (layers.empty()) return mistake("An EXR needs a layer.");
  std::vector<std::vector<const ImageLayer*>> groups;
  for (const ImageLayer& layer : layers) {
    if (!floatsOf(layer)) return mistake("An EXR's layer is no float image of its own size.");
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& members) {
      const Image& member = *members.front()->image;
      return member.width == layer.image->width && member.height == layer.image->height;
    });
    if (group == groups.end()) {
      groups.push_back({&layer});
    } else {
      group->push_back(&layer);
    }
  }

  std::vector<ExrPart> parts;
  std::vector<std::string> partNames;
  for (const auto& group : groups) {
    parts.push_back(makePart(group, pixelType));
    partNames.push_back(parts.back().name);
    if (hasDuplicates(parts.back().channels)) return mistake("Two channels of an EXR have the same name.");
  }
  if (hasDuplicates(partNames)) return mistake("Two parts of an EXR have the same name.");
  return parts;
}

Result<Bytes> encodeExr(std::span<const ImageLayer> layers, ExrCompression compression, ExrPixelType pixelType) {
  auto parts = exrParts(layers, pixelType);
  if (!parts) return std::move(parts).problems();
  return encodeExrParts(*parts, compression);
}

} // namespace gnomon
