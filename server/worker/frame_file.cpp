#include "server/worker/frame_file.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/format_traits.h"
#include "server/wire/frame_form.h"

namespace gnomon {
namespace {

std::string multipartBody(const Frame& frame, const std::vector<EncodedPicture>& pictures, ImageFormat format,
                          std::string_view boundary) {
  std::string body;
  const auto part = [&](std::string_view type, const std::string& name, std::string_view content) {
    body.append("--").append(boundary).append("\r\nContent-Type: ").append(type);
    body.append("\r\nContent-Disposition: attachment; filename=\"").append(name);
    body.append("\"\r\nContent-Length: ").append(std::to_string(content.size())).append("\r\n\r\n");
    body.append(content).append("\r\n");
  };
  part("application/json", "report.json", jsonText(toJson(frame.report)));
  const FormatTraits& traits = traitsOf(format);
  for (const EncodedPicture& picture : pictures) {
    part(traits.mediaType, std::string(traits.allViews ? "frame" : picture.view).append(traits.suffix),
         asText(picture.file));
  }
  return body.append("--").append(boundary).append("--\r\n");
}

std::string jsonBody(Frame frame, const std::vector<EncodedPicture>& pictures, ImageFormat format) {
  FrameReply reply;
  reply.report = std::move(frame.report);
  for (const EncodedPicture& picture : pictures) {
    reply.images.push_back({picture.view, std::string(mediaTypeOf(format)), base64Text(picture.file)});
  }
  return jsonText(toJson(reply));
}

} // namespace

Result<FrameFile> frameFile(Frame frame, ImageFormat format, std::string_view mediaType, std::string_view boundary,
                            const GoOn& goOn) {
  const auto start = std::chrono::steady_clock::now();
  const bool isPicture = mediaType == mediaTypeOf(format);
  const auto pictures = encodePictures(frame, isPicture ? 1 : frame.images.size(), goOn);
  if (!pictures) return pictures.problems();
  if (pictures->empty()) return Problem{ProblemCode::internal, "", "The frame has no picture.", "", ""};
  frame.report.stages.push_back({"encode", millisecondsSince(start)});
  FrameFile file{std::string(mediaType), {}, frame.report.stages, frame.report.warnings};
  if (isPicture) {
    file.body = asText(pictures->front().file);
  } else if (mediaType == mediaTypeOf({ReplyForm::multipart, format})) {
    file.contentType += "; boundary=" + std::string(boundary);
    file.body = multipartBody(frame, *pictures, format, boundary);
  } else {
    file.body = jsonBody(std::move(frame), *pictures, format);
  }
  constexpr std::size_t kMostBytes = std::numeric_limits<std::int32_t>::max();
  if (file.body.size() > kMostBytes) {
    return Problem{ProblemCode::tooLarge, "/views", "The frame's file is too large to be sent.",
                   std::to_string(kMostBytes) + " bytes", std::to_string(file.body.size()) + " bytes"};
  }
  return file;
}

} // namespace gnomon
