#include "protocol/sequence/video_frames.h"

#include <string>
#include <utility>

namespace gnomon {
namespace {

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

} // namespace

FrameSpec videoFrame(FrameSpec spec) {
  spec.views.resize(1);
  spec.output.format = ImageFormat::png; // whose pixels are those of a picture that is seen
  spec.output.pngBits = 8;
  return spec;
}

void FrameSizes::see(const FrameSpec& spec) {
  if (seen_ == 0) {
    width_ = spec.width;
    height_ = spec.height;
  }
  const bool isOther = spec.width != width_ || spec.height != height_;
  if (isOther && !other_) other_ = {seen_, spec.width, spec.height};
  ++seen_;
}

std::optional<Problem> FrameSizes::problem(const Sequence& sequence) const {
  if (!other_) return std::nullopt;
  return Problem{
      ProblemCode::invalidValue,
      framePlace(sequence, sequence.first + other_->number) + (other_->width != width_ ? "/width" : "/height"),
      "All frames of a video have the size of its first.", sizeText(width_, height_),
      sizeText(other_->width, other_->height)};
}

} // namespace gnomon
