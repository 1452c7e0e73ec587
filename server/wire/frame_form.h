#pragma once

#include <string_view>

#include "protocol/spec/output_options.h"

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

std::string_view mediaTypeOf(ImageFormat format);
std::string_view mediaTypeOf(FrameForm form); ///< without the boundary

/// Holds the frame's report, and so differs each time that it is made.
bool tellsTimes(FrameForm form);

} // namespace gnomon
