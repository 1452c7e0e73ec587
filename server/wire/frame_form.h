#pragma once

#include <string_view>

#include "protocol/spec/traits.h"

namespace gnomon {

/// What a frame is sent as.
enum class ReplyForm {
  image,     ///< one file in the format's media type: of the first view, or of all where the format holds them
  multipart, ///< multipart/mixed: the report, then every picture
  json       ///< application/json: the report, and the pictures in base64
};

struct FrameForm {
  ReplyForm form = ReplyForm::image;
  ImageFormat format = ImageFormat::png; ///< of the pictures
};

inline std::string_view mediaTypeOf(ImageFormat format) {
  return traitsOf(format).mediaType;
}

/// Without the boundary.
inline std::string_view mediaTypeOf(FrameForm form) {
  if (form.form == ReplyForm::image) return mediaTypeOf(form.format);
  return form.form == ReplyForm::multipart ? "multipart/mixed" : "application/json";
}

/// Holds the frame's report, and so differs each time that it is made.
inline bool tellsTimes(FrameForm form) {
  return form.form != ReplyForm::image || traitsOf(form.format).hasReport;
}

} // namespace gnomon
