#include "renderer/image/jpeg_encode.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "renderer/core/stop.h"
#include "renderer/image/jpeg_errors.h"

namespace gnomon {
namespace {

/// Where the file goes, a block at a time.
struct JpegFile {
  jpeg_destination_mgr base;
  std::array<JOCTET, 65536> block;
  Bytes* file;
};

JpegFile& jpegFileOf(j_compress_ptr codec) {
  return *reinterpret_cast<JpegFile*>(codec->dest);
}

void beginBlock(j_compress_ptr codec) {
  JpegFile& file = jpegFileOf(codec);
  file.base.next_output_byte = file.block.data();
  file.base.free_in_buffer = file.block.size();
}

boolean takeBlock(j_compress_ptr codec) { // all of it, whatever free_in_buffer says
  JpegFile& file = jpegFileOf(codec);
  file.file->insert(file.file->end(), file.block.begin(), file.block.end());
  beginBlock(codec);
  return TRUE;
}

void takeRest(j_compress_ptr codec) {
  JpegFile& file = jpegFileOf(codec);
  file.file->insert(file.file->end(), file.block.data(),
                    file.block.data() + file.block.size() - file.base.free_in_buffer);
}

struct Compressor : jpeg_compress_struct {
  ~Compressor() { jpeg_destroy_compress(this); }
};

constexpr JDIMENSION kWrittenAtOnce = 16; ///< written at a time

/// False with a message in `errors`.
bool writeJpeg(jpeg_compress_struct& codec, JpegErrors& errors, JpegFile& file, const Image& image,
               const std::uint8_t* pixels, int quality) {
  if (setjmp(errors.leave) != 0) return false; // NOLINT(cert-err52-cpp): the library knows no other way
  jpeg_create_compress(&codec);
  codec.dest = &file.base;
  codec.image_width = static_cast<JDIMENSION>(image.width);
  codec.image_height = static_cast<JDIMENSION>(image.height);
  codec.input_components = static_cast<int>(image.channels.size());
  codec.in_color_space = codec.input_components == 1   ? JCS_GRAYSCALE
                         : codec.input_components == 3 ? JCS_RGB
                                                       : JCS_EXT_RGBX;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  for (int i = 0; i < codec.num_components; ++i)
    codec.comp_info[i].h_samp_factor = codec.comp_info[i].v_samp_factor = 1;
  jpeg_start_compress(&codec, TRUE);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
  while (codec.next_scanline < codec.image_height) {
    stopIfAsked();
    std::array<JSAMPROW, kWrittenAtOnce> rows{};
    const JDIMENSION count = std::min(kWrittenAtOnce, codec.image_height - codec.next_scanline);
    for (JDIMENSION i = 0; i < count; ++i) rows[i] = const_cast<JSAMPROW>(pixels + row * (codec.next_scanline + i));
    jpeg_write_scanlines(&codec, rows.data(), count);
  }
  jpeg_finish_compress(&codec);
  return true;
}

} // namespace

Result<Bytes> encodeJpeg(const Image& image, int quality) {
  const auto* pixels = pixelsAs<std::uint8_t>(image);
  if (!pixels || !isPicture(image)) {
    return Problem{ProblemCode::internal, "", "A JPEG needs an 8-bit image of 1, 3 or 4 channels.", "", ""};
  }
  Bytes bytes;
  JpegFile file{};
  file.base = {nullptr, 0, beginBlock, takeBlock, takeRest};
  file.file = &bytes;
  JpegErrors errors{};
  Compressor codec{};
  codec.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = leaveWithMessage;
  errors.base.emit_message = [](j_common_ptr, int) {};
  if (writeJpeg(codec, errors, file, image, pixels->data(), quality)) return bytes;
  return Problem{ProblemCode::internal, "",
                 "The JPEG could not be written: " + std::string(errors.message.data()) + ".", "", ""};
}

} // namespace gnomon
