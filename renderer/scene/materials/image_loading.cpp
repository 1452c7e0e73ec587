#include "renderer/scene/materials/image_loading.h"

#include <map>
#include <string_view>

#include "renderer/core/stop.h"
#include "renderer/image/image_codec.h"
#include "renderer/scene/materials/materials.h"

namespace gnomon {

namespace {

using Encoded = std::span<const std::uint8_t>;

bool startsWith(Encoded bytes, std::string_view signature) {
  return bytes.size() >= signature.size() &&
         std::string_view(reinterpret_cast<const char*>(bytes.data()), signature.size()) == signature;
}

/// The name of a known format that is not decoded; empty for those that are, and for bytes of no known format.
std::string_view unsupportedFormat(Encoded bytes) {
  if (startsWith(bytes, "\xABKTX 20\xBB")) return "KTX 2";
  if (startsWith(bytes, "DDS ")) return "DDS";
  return {};
}

std::string imageName(const GltfDocument& document, int index) {
  const auto& name = document.model.images[static_cast<std::size_t>(index)].name;
  return "image " + std::to_string(index) + (name ? ' ' + inQuotes(*name) : "");
}

const char* const kLeftOut = "the textures that use it are left out";

void leaveOut(Problems problems, const std::string& pointer, Findings& findings) {
  Findings image;
  image.take(locatedImageProblems(std::move(problems), pointer));
  findings.leaveOut(std::move(image), kLeftOut);
}

/// What no material uses is not drawn, and told all the same where it can't be read.
void checkUnused(const GltfDocument& document, const std::map<int, int>& used, Findings& findings) {
  for (std::size_t i = 0; i < document.images.size(); ++i) {
    const Encoded bytes = document.images[i].view();
    if (bytes.empty() || used.contains(static_cast<int>(i)) || !unsupportedFormat(bytes).empty()) continue;
    auto size = imageSize(bytes);
    if (!size) leaveOut(std::move(size).problems(), pointerTo("/images", i), findings);
  }
}

/// The images of the file that a material uses; -1 = it is left out, else its place in Scene::images, yet to be found.
std::map<int, int> usedImages(const GltfDocument& document, std::vector<Material>& materials, Findings& findings) {
  std::map<int, int> slots;
  for (Material& material : materials) {
    for (const auto* texture : texturesOf(material)) {
      if (*texture) slots.emplace((*texture)->image, -1);
    }
  }
  for (auto& [image, slot] : slots) {
    const Encoded bytes = document.images[static_cast<std::size_t>(image)].view();
    const std::string_view format = unsupportedFormat(bytes);
    if (bytes.empty()) {
      continue; // told where it is missing
    } else if (format.empty()) {
      slot = 0; // found its place once it has been checked
    } else {
      findings.warn("The " + imageName(document, image) + " is " + std::string(format) +
                    ", which is not supported; the textures that use it are left out.");
    }
  }
  return slots;
}

/// Holds the images against the limits; those without a size are left out.
void checkSizes(const GltfDocument& document, std::map<int, int>& slots, const Limits& limits, Findings& findings) {
  std::int64_t pixels = 0;
  for (auto& [image, slot] : slots) {
    if (slot < 0) continue;
    const std::string pointer = pointerTo("/images", static_cast<std::size_t>(image));
    auto size = imageSize(document.images[static_cast<std::size_t>(image)].view());
    if (!size) {
      leaveOut(std::move(size).problems(), pointer, findings);
      slot = -1;
      continue;
    }
    const std::string actual = std::to_string(size->width) + " x " + std::to_string(size->height);
    if (size->width > limits.maxImageSide || size->height > limits.maxImageSide) {
      findings.tooLarge(pointer, "The image is too large.", std::to_string(limits.maxImageSide) + " a side", actual);
      continue;
    }
    pixels += std::int64_t{size->width} * size->height;
    if (pixels > limits.maxImagePixels) {
      findings.tooLarge(pointer, "The images have too many pixels together.", std::to_string(limits.maxImagePixels),
                        std::to_string(pixels));
      return;
    }
  }
}

/// SHA-256 of an image and of its place in the file, which problems tell.
std::string imageContent(Encoded bytes, const std::string& pointer) {
  Sha256 hash;
  hash.add(pointer);
  hash.add(std::string_view("\0", 1));
  hash.add(bytes);
  return hash.hex();
}

} // namespace

SceneImages loadImages(const GltfDocument& document, const Limits& limits, std::vector<Material>& materials,
                       Findings& findings, KnownContent* known) {
  std::map<int, int> slots = usedImages(document, materials, findings);
  checkUnused(document, slots, findings);
  checkSizes(document, slots, limits, findings);
  SceneImages images;
  if (findings.refused()) return images;
  for (auto& [image, slot] : slots) {
    if (slot < 0) continue;
    stopIfAsked();
    const std::string pointer = pointerTo("/images", static_cast<std::size_t>(image));
    const Encoded bytes = document.images[static_cast<std::size_t>(image)].view();
    const std::string content = known != nullptr ? imageContent(bytes, pointer) : std::string();
    auto picture = known != nullptr ? known->image(content) : nullptr;
    if (!picture) {
      auto checked = checkImage(bytes, limits.maxImageSide, limits.maxImagePixels);
      if (!checked) {
        leaveOut(std::move(checked).problems(), pointer, findings);
        slot = -1;
        continue;
      }
      picture = std::make_shared<const SceneImage>(*std::move(checked), pointer);
      if (known != nullptr) known->keepImage(content, picture);
    }
    if (picture->cutShort()) findings.repair({"An image is cut short", "what it has is drawn"}, pointer);
    slot = static_cast<int>(images.size());
    images.push_back(std::move(picture));
  }
  for (Material& material : materials) {
    for (auto* texture : texturesOf(material)) {
      if (!*texture) continue;
      const int slot = slots.at((*texture)->image);
      if (slot < 0) {
        texture->reset();
      } else {
        (*texture)->image = slot;
      }
    }
  }
  return images;
}

} // namespace gnomon
