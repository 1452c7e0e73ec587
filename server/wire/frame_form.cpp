#include "server/wire/frame_form.h"

namespace gnomon {

std::string_view mediaTypeOf(ImageFormat format) {
  return format == ImageFormat::png ? "image/png" : "image/x-exr";
}

std::string_view mediaTypeOf(FrameForm form) {
  switch (form.form) {
    case ReplyForm::image:
      return mediaTypeOf(form.format);
    case ReplyForm::multipart:
      return "multipart/mixed";
    case ReplyForm::json:
      return "application/json";
  }
  return "";
}

} // namespace gnomon
