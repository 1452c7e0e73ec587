#include "renderer/image/jpeg_decode.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "renderer/core/stop.h"
#include "renderer/image/jpeg_errors.h"

namespace gnomon {
namespace {

void leaveAtWarning(j_common_ptr codec, int level) {
  if (level < 0) leaveWithMessage(codec);
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
  errors.base.emit_message = leaveAtWarning;
  const bool done = readInto(codec, errors, essential, to);
  return done ? std::string() : std::string(errors.message.data());
}

} // namespace gnomon
