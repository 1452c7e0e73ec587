#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/oiio/module.h"

namespace gnomon::codec {
namespace {

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

/// Of which the library makes blocks to compress: no more than so many of them.
constexpr int kRows = 64;

/// The next rows, from `y` on.
bool writeRows(OIIO::ImageOutput& output, const FloatPart& part, int y) {
  const std::size_t row = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.channelCount);
  return output.write_scanlines(y, std::min(y + kRows, part.height), 0, OIIO::TypeFloat,
                                part.pixels + static_cast<std::size_t>(y) * row);
}

} // namespace

bool encodeExr(const FloatPart* parts, std::size_t partCount, Compression compression, const Caller& caller,
               const Sink& encoded, const Sink& message) {
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
      if (!appended) return fail(message, output->geterror());
      for (int y = 0; y < parts[i].height; y += kRows) {
        if (!caller.wants(caller.task)) return fail(message, "it is wanted no more");
        if (!writeRows(*output, parts[i], y)) return fail(message, output->geterror());
      }
    }
    if (!output->close()) return fail(message, output->geterror());
    const std::span<const std::uint8_t> bytes = file.contents();
    if (bytes.empty()) return fail(message, "the memory file is empty");
    return encoded.accept(encoded.target, bytes.data(), bytes.size()) || fail(message, "out of memory");
  });
}

} // namespace gnomon::codec
