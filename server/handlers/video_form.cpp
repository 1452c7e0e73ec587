#include "server/handlers/video_form.h"

#include <string>
#include <utility>

#include "protocol/base/bytes.h"
#include "renderer/video/video_file.h"

namespace gnomon {
namespace {

Problem noRawPicture() {
  return {ProblemCode::internal, "", "The frame is none of a video.", "", ""};
}

class VideoForm final : public SequenceForm {
 public:
  VideoForm(std::unique_ptr<ByteLease> memory, VideoFile file) : memory_(std::move(memory)), file_(std::move(file)) {}

  bool begin(const BodySink& sink) override { return sink(file_.head()); }

  Status encode(const DoneFrame& frame) override {
    const PictureNews* const picture = frame.pictures.raw();
    if (picture == nullptr) return noRawPicture();
    auto piece = file_.add({picture->width, picture->height, frame.pictures.bytes().bytes()});
    if (!piece) return piece.problems();
    piece_ = *std::move(piece);
    return Done{};
  }

  bool frame(const BodySink& sink, const DoneFrame&, int) override { return sink(piece_); }
  bool report(const BodySink& sink, std::string_view json) override { return sink(webmTag(kVideoReportTag, json)); }
  bool problem(const BodySink& sink, std::string_view json) override { return sink(webmTag(kVideoProblemTag, json)); }

 private:
  std::unique_ptr<ByteLease> memory_; ///< given back last
  VideoFile file_;
  std::string piece_; ///< of the frame that was encoded last
};

std::string bytesText(std::size_t bytes) {
  return std::to_string(bytes) + " bytes";
}

} // namespace

Result<TypedForm> videoForm(const VideoSettings& settings, const DoneFrame& first, ByteBudget& memory,
                            const Holder& holder) {
  const PictureNews* const picture = first.pictures.raw();
  if (picture == nullptr) return noRawPicture();
  const std::size_t bytes = videoBytes(picture->width, picture->height);
  if (bytes > memory.total()) {
    return Problem{ProblemCode::tooLarge, "/spec/width",
                   "Encoding a video of this size takes more memory than all videos may (--video-memory-bytes).",
                   bytesText(memory.total()), bytesText(bytes)};
  }
  auto lease = std::make_unique<ByteLease>(memory, holder);
  if (!lease->grow(bytes)) {
    return Problem{ProblemCode::busy, "", "Other videos use the memory for videos.", bytesText(memory.total()), ""};
  }
  auto file =
      VideoFile::create({picture->width, picture->height, settings.framesPerSecond, settings.frames}, settings.quality);
  if (!file) return file.problems();
  return TypedForm{std::string(kVideoType), std::make_shared<VideoForm>(std::move(lease), *std::move(file))};
}

} // namespace gnomon
