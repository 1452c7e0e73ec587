#include "renderer/image/exr_layout.h"

#include <algorithm>
#include <cstddef>
#include <variant>

namespace gnomon {
namespace {

Problem mistake(const std::string& detail) {
  return {ProblemCode::internal, "", detail, "", ""};
}

/// Null where the layer is not a float image whose pixels match its size and channels.
const std::vector<float>* floatsOf(const ImageLayer& layer) {
  return layer.image ? pixelsAs<float>(*layer.image) : nullptr;
}

bool isColor(const std::string& channel) {
  return channel == "R" || channel == "G" || channel == "B";
}

/// Copies `layer` into the channels of `part` that begin at `firstChannel`.
void placeLayer(ExrPart& part, std::size_t firstChannel, const Image& layer, const std::vector<float>& source) {
  const std::size_t stride = part.channels.size();
  const std::size_t channelCount = layer.channels.size();
  const auto alpha =
      static_cast<std::size_t>(std::find(layer.channels.begin(), layer.channels.end(), "A") - layer.channels.begin());
  for (std::size_t channel = 0; channel < channelCount; ++channel) {
    const bool associate = alpha < channelCount && isColor(layer.channels[channel]);
    float* target = part.pixels.data() + firstChannel + channel;
    for (std::size_t from = 0; from < source.size(); from += channelCount, target += stride) {
      *target = associate ? source[from + channel] * source[from + alpha] : source[from + channel];
    }
  }
}

bool hasDuplicates(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return std::adjacent_find(names.begin(), names.end()) != names.end();
}

/// The layers of one size, as one part.
ExrPart makePart(const std::vector<const ImageLayer*>& layers, ExrPixelType pixelType) {
  const ImageLayer& first = *layers.front();
  ExrPart part{first.name.empty() ? "main" : first.name, first.image->width, first.image->height, {}, {}, {}};
  for (const ImageLayer* layer : layers) {
    for (const std::string& channel : layer->image->channels) {
      part.channels.push_back(layer->name.empty() ? channel : layer->name + "." + channel);
      part.half.push_back(pixelType == ExrPixelType::half && !layer->wide);
    }
  }
  part.pixels.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height) *
                     part.channels.size());
  std::size_t firstChannel = 0;
  for (const ImageLayer* layer : layers) {
    placeLayer(part, firstChannel, *layer->image, *floatsOf(*layer));
    firstChannel += layer->image->channels.size();
  }
  return part;
}

} // namespace

Result<std::vector<ExrPart>> exrParts(std::span<const ImageLayer> layers, ExrPixelType pixelType) {
  if (layers.empty()) return mistake("An EXR needs a layer.");
  std::vector<std::vector<const ImageLayer*>> groups;
  for (const ImageLayer& layer : layers) {
    if (!floatsOf(layer)) return mistake("An EXR's layer is no float image of its own size.");
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& members) {
      const Image& member = *members.front()->image;
      return member.width == layer.image->width && member.height == layer.image->height;
    });
    if (group == groups.end()) {
      groups.push_back({&layer});
    } else {
      group->push_back(&layer);
    }
  }

  std::vector<ExrPart> parts;
  std::vector<std::string> partNames;
  for (const auto& group : groups) {
    parts.push_back(makePart(group, pixelType));
    partNames.push_back(parts.back().name);
    if (hasDuplicates(parts.back().channels)) return mistake("Two channels of an EXR have the same name.");
  }
  if (hasDuplicates(partNames)) return mistake("Two parts of an EXR have the same name.");
  return parts;
}

} // namespace gnomon
