#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "protocol/spec/output_options.h"

namespace gnomon {

/// What a frame is sent as.
enum class ReplyForm {
  image,     ///< image/png of the first view, or image/x-exr of every view as layers
  multipart, ///< multipart/mixed: the report, then every picture
  json       ///< application/json: the report, and the pictures in base64
};

struct FrameForm {
  ReplyForm form = ReplyForm::image;
  ImageFormat format = ImageFormat::png; ///< of the pictures
};

std::string_view mediaTypeOf(ImageFormat format);
std::string_view mediaTypeOf(FrameForm form); ///< without the boundary

/// Which of the media types offered an Accept header likes best; of equals the first, which is also the choice where
/// there is no such header. Nothing: none can be given.
std::optional<std::size_t> preferred(std::optional<std::string_view> accept, std::span<const std::string_view> offers);

/// The form that Accept (RFC 9110, q-values included) likes best. An image type in Accept decides the format, also
/// against the spec's; where Accept leaves it open (no Accept, */*, image/*, or a tie) the spec's format stands.
/// Nothing: there is no acceptable form.
std::optional<FrameForm> negotiate(std::optional<std::string_view> accept, ImageFormat specFormat);

} // namespace gnomon
