#include "protocol/spec/enum_rows.h"
#include "protocol/spec/output_options.h"
#include "protocol/spec/traits.h"
#include "renderer/image/image_codec.h"
#include "renderer/image/png_encode.h"
#include "renderer/render.h"

namespace gnomon {
namespace {

/// The layer's name in an EXR; the color view has the plain channels R G B (A).
std::string layerName(View view) {
  return view == View::color ? "" : std::string(spell(view));
}

} // namespace

Result<Bytes> encodePng(const Frame& frame, std::size_t index) {
  return encodePng(frame.images[index].image, frame.report.spec.output.pngCompression);
}

Result<Bytes> encodeExr(const Frame& frame) {
  std::vector<ImageLayer> layers;
  for (const ViewImage& view : frame.images)
    layers.push_back({layerName(view.view), &view.image, traitsOf(view.view).wide});
  const Output& output = frame.report.spec.output;
  return encodeExr(layers, output.exrCompression, output.exrPixelType);
}

namespace {

Result<std::vector<EncodedPicture>> allEncoded(const Frame& frame, std::size_t most) {
  const bool layered = frame.report.spec.output.format == ImageFormat::exr;
  const std::size_t count = std::min(frame.images.size(), layered ? std::size_t{1} : most);
  std::vector<EncodedPicture> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    auto file = layered ? encodeExr(frame) : encodePng(frame, i);
    if (!file) return std::move(file).problems();
    pictures.push_back({std::string(spell(frame.images[i].view)), *std::move(file)});
  }
  return pictures;
}

} // namespace

Result<std::vector<EncodedPicture>> encodePictures(const Frame& frame, std::size_t most, const GoOn& goOn) {
  return untilStopped(goOn, [&] { return allEncoded(frame, most); });
}

} // namespace gnomon
