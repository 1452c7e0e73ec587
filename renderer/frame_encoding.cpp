#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/enum_rows.h"
#include "protocol/spec/traits.h"
#include "renderer/image/image_codec.h"
#include "renderer/image/picture_encode.h"
#include "renderer/render.h"

namespace gnomon {
namespace {

/// The layer's name in an EXR; the color view has the plain channels R G B (A).
std::string layerName(View view) {
  return view == View::color ? "" : std::string(spell(view));
}

/// One EXR of every view as named layers.
Result<Bytes> encodeLayers(const Frame& frame) {
  std::vector<ImageLayer> layers;
  for (const ViewImage& view : frame.images)
    layers.push_back({layerName(view.view), &view.image, traitsOf(view.view).wide});
  const Output& output = frame.report.spec.output;
  return encodeExr(layers, output.exrCompression, output.exrPixelType);
}

Result<Bytes> encodeArray(const ViewImage& view) {
  return encodeNpy(view.image, holdsIndices(view.view) ? ArrayNumbers::int32 : ArrayNumbers::float32);
}

/// Every view's array, and the report.
Result<Bytes> encodeNpz(const Frame& frame) {
  ZipWriter zip;
  for (const ViewImage& view : frame.images) {
    const auto array = encodeArray(view);
    if (!array) return array.problems();
    if (auto added = zip.add(std::string(spell(view.view)) + ".npy", *array); !added) return added.problems();
  }
  if (auto added = zip.add("report.json", asBytes(jsonText(toJson(frame.report)))); !added) return added.problems();
  return std::move(zip).finish();
}

/// In the format of its spec: of view `index`, or of all.
Result<Bytes> encodeFile(const Frame& frame, std::size_t index) {
  const Output& output = frame.report.spec.output;
  const ViewImage& view = frame.images[index];
  switch (output.format) {
    case ImageFormat::png:
      return encodePng(view.image, output.pngCompression);
    case ImageFormat::exr:
      return encodeLayers(frame);
    case ImageFormat::npy:
      return encodeArray(view);
    case ImageFormat::npz:
      return encodeNpz(frame);
    case ImageFormat::tiff:
      return encodeTiff(view.image);
    case ImageFormat::jpeg:
      return encodeJpeg(view.image, output.jpegQuality);
    case ImageFormat::webp:
      return encodeWebp(view.image, output.webpQuality);
  }
  return Problem{ProblemCode::internal, "", "This format has no encoder.", "", ""};
}

Result<std::vector<EncodedPicture>> allEncoded(const Frame& frame, std::size_t most) {
  const bool allViews = traitsOf(frame.report.spec.output.format).allViews;
  const std::size_t count = std::min(frame.images.size(), allViews ? std::size_t{1} : most);
  std::vector<EncodedPicture> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    auto file = encodeFile(frame, i);
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
