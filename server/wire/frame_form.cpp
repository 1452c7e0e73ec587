#include "server/wire/frame_form.h"

#include "protocol/spec/format_traits.h"

namespace gnomon {

std::string_view mediaTypeOf(ImageFormat format) {
  return traitsOf(format).mediaType;
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

bool tellsTimes(FrameForm form) {
  return form.form != ReplyForm::image || traitsOf(form.format).hasReport;
}

} // namespace gnomon
