#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <jpeglib.h>
#include <string>

#include "renderer/core/stop.h"
#include "renderer/image/picture_decode.h"
#include "renderer/image/picture_encode.h"

namespace gnomon {

namespace {

/// libjpeg reports errors by leaving its functions, which C++ must not see: only plain data lives between.
struct JpegErrors {
  jpeg_error_mgr base;
  std::jmp_buf leave;
  std::array<char, JMSG_LENGTH_MAX> message; ///< empty = nothing was wrong
};

[[noreturn]] void leaveWithMessage(j_common_ptr codec) {
  auto* errors = reinterpret_cast<JpegErrors*>(codec->err);
  codec->err->format_message(codec, errors->message.data());
  std::longjmp(errors->leave, 1);
}

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

Result<Bytes> encodeJpeg(const Image& image, int quality) {
  const auto* pixels = pixelsAs<std::uint8_t>(image);
  if (!pixels || !isPicture(image)) {
    return Problem{ProblemCode::internal, "", "A JPEG needs an 8-bit image of 1, 3 or 4 channels."};
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
                 "The JPEG could not be written: " + std::string(errors.message.data()) + "."};
}

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
