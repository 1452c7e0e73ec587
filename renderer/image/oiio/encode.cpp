#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/oiio/module.h"

namespace gnomon::codec {
namespace {

/// libpng's PNG_FILTER_SUB. Trying every filter on every row, its default, takes half as long again for the same size;
/// PNG_FILTER_PAETH a quarter longer, for 4 % less.
constexpr int kSubFilter = 0x10;

/// The library writes the time of day where none is given; pinned, equal pictures have equal bytes.
constexpr const char* kDateTime = "2000:01:01 00:00:00";
constexpr const char* kSoftware = "Gnomon";

const char* nameOf(Compression compression) {
  switch (compression) {
    case Compression::none:
      return "none";
    case Compression::rle:
      return "rle";
    case Compression::zip:
      return "zip";
    case Compression::piz:
      return "piz";
  }
  return "none";
}

/// All parts of an EXR share one display window: that of `first`.
OIIO::ImageSpec specOf(const FloatPart& part, const FloatPart& first, Compression compression) {
  OIIO::ImageSpec spec(part.width, part.height, part.channelCount, OIIO::TypeFloat);
  spec.full_width = first.width;
  spec.full_height = first.height;
  spec.channelnames.assign(part.channelNames, part.channelNames + part.channelCount);
  bool anyFloat = false;
  for (int i = 0; i < part.channelCount; ++i) {
    spec.channelformats.push_back(part.channelIsHalf[i] ? OIIO::TypeHalf : OIIO::TypeFloat);
    anyFloat = anyFloat || !part.channelIsHalf[i];
  }
  if (!anyFloat) spec.set_format(OIIO::TypeHalf);
  spec.attribute("compression", nameOf(compression));
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("oiio:subimagename", part.name);
  spec.attribute("DateTime", kDateTime);
  spec.attribute("Software", kSoftware);
  return spec;
}

bool deliver(std::span<const std::uint8_t> bytes, const Sink& encoded, const Sink& message) {
  return encoded.accept(encoded.target, bytes.data(), bytes.size()) || fail(message, "out of memory");
}

} // namespace

bool encodePng(const BytePicture& picture, int level, const Sink& encoded, const Sink& message) {
  return guarded(message, [&] {
    OIIO::ImageSpec spec(picture.width, picture.height, picture.channelCount, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("png:compressionLevel", level);
    spec.attribute("png:filter", kSubFilter);
    const auto output = OIIO::ImageOutput::create("png");
    if (!output) return fail(message, OIIO::geterror());
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory) || !output->open("picture.png", spec) ||
        !output->write_image(OIIO::TypeUInt8, picture.pixels) || !output->close()) {
      return fail(message, output->geterror());
    }
    return deliver(bytes, encoded, message);
  });
}

bool encodeExr(const FloatPart* parts, std::size_t partCount, Compression compression, const Sink& encoded,
               const Sink& message) {
  return guarded(message, [&] {
    std::vector<OIIO::ImageSpec> specs;
    for (std::size_t i = 0; i < partCount; ++i) specs.push_back(specOf(parts[i], parts[0], compression));
    const auto output = OIIO::ImageOutput::create("openexr");
    if (!output) return fail(message, OIIO::geterror());
    MemoryFile file;
    if (!file.valid()) return fail(message, "no memory file could be made");
    if (!output->open(file.path(), static_cast<int>(specs.size()), specs.data())) {
      return fail(message, output->geterror());
    }
    for (std::size_t i = 0; i < partCount; ++i) {
      const bool appended = i == 0 || output->open(file.path(), specs[i], OIIO::ImageOutput::AppendSubimage);
      if (!appended || !output->write_image(OIIO::TypeFloat, parts[i].pixels)) {
        return fail(message, output->geterror());
      }
    }
    if (!output->close()) return fail(message, output->geterror());
    const std::span<const std::uint8_t> bytes = file.contents();
    if (bytes.empty()) return fail(message, "the memory file is empty");
    return deliver(bytes, encoded, message);
  });
}

} // namespace gnomon::codec
