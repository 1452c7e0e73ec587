#pragma once

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <jpeglib.h>

namespace gnomon {

/// libjpeg reports errors by leaving its functions, which C++ must not see: only plain data lives between.
struct JpegErrors {
  jpeg_error_mgr base;
  std::jmp_buf leave;
  std::array<char, JMSG_LENGTH_MAX> message; ///< empty = nothing was wrong
};

[[noreturn]] inline void leaveWithMessage(j_common_ptr codec) {
  auto* errors = reinterpret_cast<JpegErrors*>(codec->err);
  codec->err->format_message(codec, errors->message.data());
  std::longjmp(errors->leave, 1);
}

} // namespace gnomon
