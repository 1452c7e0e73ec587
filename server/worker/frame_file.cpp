#include "server/worker/frame_file.h"

#include <nlohmann/json.hpp>

#include "protocol/base/elapsed.h"
#include "protocol/json/json_codec.h"
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
  const std::string ending = format == ImageFormat::png ? ".png" : ".exr";
  for (const EncodedPicture& picture : pictures) {
    part(mediaTypeOf(format), (format == ImageFormat::png ? picture.view : "frame") + ending, asText(picture.file));
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
  FrameFile file{std::string(mediaType), {}, frame.report.stages};
  if (isPicture) {
    file.body = asText(pictures->front().file);
  } else if (mediaType == mediaTypeOf({ReplyForm::multipart, format})) {
    file.contentType += "; boundary=" + std::string(boundary);
    file.body = multipartBody(frame, *pictures, format, boundary);
  } else {
    file.body = jsonBody(std::move(frame), *pictures, format);
  }
  return file;
}

} // namespace gnomon
