#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "renderer/core/stop.h"
#include "renderer/image/jpeg_errors.h"
#include "renderer/image/picture_decode.h"

namespace gnomon {
namespace {

void keepFirstWarning(j_common_ptr codec, int level) {
  auto* errors = reinterpret_cast<JpegErrors*>(codec->err);
  if (level < 0 && errors->base.num_warnings++ == 0) codec->err->format_message(codec, errors->message.data());
}

/// Grey and opaque, from this row on.
void greyFrom(int row, DecodedRows& to) {
  constexpr std::uint32_t kGrey = 0xff808080;
  for (int y = row; y < to.size().height; ++y) {
    std::uint8_t* place = to.at(y);
    for (int x = 0; x < to.size().width; ++x) std::memcpy(place + 4 * x, &kGrey, sizeof kGrey);
    to.complete(y + 1);
  }
}

struct Codec : jpeg_decompress_struct {
  ~Codec() { jpeg_destroy_decompress(this); }
};

constexpr JDIMENSION kScanlinesAtOnce = DecodedRows::kStep; ///< read at a time

/// False with a message in `errors`.
bool readInto(jpeg_decompress_struct& codec, JpegErrors& errors, EncodedBytes essential, DecodedRows& to) {
  if (setjmp(errors.leave) != 0) return false; // NOLINT(cert-err52-cpp): the library knows no other way
  jpeg_create_decompress(&codec);
  jpeg_mem_src(&codec, essential.data(), essential.size());
  jpeg_read_header(&codec, TRUE);
  const auto width = static_cast<JDIMENSION>(to.size().width);
  const auto height = static_cast<JDIMENSION>(to.size().height);
  if (codec.image_width != width || codec.image_height != height) {
    std::snprintf(errors.message.data(), errors.message.size(), "its header contradicts itself");
    return false;
  }
  codec.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&codec);
  while (codec.output_scanline < height) {
    stopIfAsked();
    std::array<JSAMPROW, kScanlinesAtOnce> rows{};
    const JDIMENSION first = codec.output_scanline; // a call may read fewer than it could
    const JDIMENSION count = std::min(kScanlinesAtOnce - first % kScanlinesAtOnce, height - first);
    for (JDIMENSION i = 0; i < count; ++i) rows[i] = to.at(static_cast<int>(first + i));
    jpeg_read_scanlines(&codec, rows.data(), count);
    to.complete(static_cast<int>(codec.output_scanline));
  }
  jpeg_finish_decompress(&codec);
  return true;
}

} // namespace

std::string decodeJpeg(EncodedBytes essential, DecodedRows& to) {
  JpegErrors errors{};
  Codec codec{};
  codec.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = leaveWithMessage;
  errors.base.emit_message = keepFirstWarning;
  const bool done = readInto(codec, errors, essential, to);
  if (!done) greyFrom(static_cast<int>(std::min<JDIMENSION>(codec.output_scanline, codec.output_height)), to);
  return std::string(errors.message.data());
}

} // namespace gnomon
