#include "protocol/spec/output_options.h"
#include "renderer/image/image_codec.h"
#include "renderer/render.h"

namespace gnomon {
namespace {

/// The layer's name in an EXR; the color view has the plain channels R G B (A).
std::string layerName(View view) {
  switch (view) {
    case View::color:
      return "";
    case View::depth:
      return "depth";
    case View::normal:
      return "normal";
    case View::cascades:
      return "cascades";
    case View::shadow:
      return "shadow";
    case View::atlas:
      return "atlas";
    case View::tile:
      return "tile";
    case View::texelGrid:
      return "texelGrid";
    case View::texelDensity:
      return "texelDensity";
    case View::blendWeight:
      return "blendWeight";
    case View::bias:
      return "bias";
    case View::casterIds:
      return "casterIds";
    case View::lightContribution:
      return "lightContribution";
    case View::reference:
      return "reference";
    case View::error:
      return "error";
    case View::edgeDistance:
      return "edgeDistance";
  }
  return "";
}

} // namespace

Result<Bytes> encodePng(const Frame& frame, std::size_t index) {
  return encodePng(frame.images[index].image, frame.report.spec.output.pngCompression);
}

Result<Bytes> encodeExr(const Frame& frame) {
  std::vector<ImageLayer> layers;
  for (const ViewImage& view : frame.images) layers.push_back({layerName(view.view), &view.image});
  const Output& output = frame.report.spec.output;
  return encodeExr(layers, output.exrCompression, output.exrPixelType);
}

void warmEncoders() {
  warmImageCodec();
}

} // namespace gnomon
