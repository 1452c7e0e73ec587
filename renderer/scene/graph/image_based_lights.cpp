#include "renderer/scene/graph/image_based_lights.h"

#include <bit>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "protocol/base/text.h"
#include "renderer/scene/scene_image.h"

namespace gnomon {
namespace {

const Repair kOtherSize{"A level of an image-based light has a face of another size than half of the level before",
                        "smaller levels are summed from the first"};
const Repair kOtherStatedSize{"The faces of an image-based light are not as large as `specularImageSize`",
                              "their own size counts"};
const Repair kNoPowerOfTwo{"The faces of an image-based light are no power of two wide", "they are read as they are"};

std::string textOf(const ImageSize& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// Reads the faces of lights. Pictures that lights share are kept once.
class FaceReader {
 public:
  explicit FaceReader(const LoadContext& load) : load_(load) {}

  /// Its faces; problems of a light that is left out go to `found`.
  std::optional<CubeLight> read(const gltf::ImageBasedLight& light, const std::string& pointer, Findings& found) {
    const int side = sideOfFirst(light, pointer, found);
    if (found.count() > 0 || side == 0) return std::nullopt;
    checkLevels(light, side, pointer);
    CubeLight cube;
    for (std::size_t face = 0; face < cube.faces.size(); ++face) {
      const int image = light.specularImages.front()[face];
      cube.places[face] = pointerTo("/images", static_cast<std::size_t>(image));
      cube.faces[face] = pictureOf(image, cube.places[face], found);
    }
    if (found.count() > 0) return std::nullopt;
    return cube;
  }

 private:
  /// Nothing where it has no header that can be read, which is said elsewhere of the first level.
  std::optional<ImageSize> sizeOf(int image) const {
    const auto size = imageSize(load_.document.images[static_cast<std::size_t>(image)].view());
    return size ? std::optional(*size) : std::nullopt;
  }

  /// 0 = it has no first level that can be read.
  int sideOfFirst(const gltf::ImageBasedLight& light, const std::string& pointer, Findings& found) {
    const std::string level = pointer + "/specularImages/0";
    if (light.specularImages.empty()) {
      found.invalid(pointer + "/specularImages", "An image-based light has no images.");
      return 0;
    }
    int side = 0;
    for (std::size_t face = 0; face < 6; ++face) {
      const std::string place = pointerTo(level, face);
      const auto size = sizeOf(light.specularImages.front()[face]);
      if (!size) {
        found.invalid(place, "A face of an image-based light has no picture that can be read.");
        continue;
      }
      if (face == 0) side = size->width;
      if (size->width != side || size->height != side) {
        found.invalid(place, "The faces of an image-based light are not squares of one size.", textOf({side, side}),
                      textOf(*size));
      }
    }
    const int most = load_.limits.maxEnvironmentWidth / 4;
    if (side > most) {
      found.tooLarge(level, "The faces of an image-based light are too large.", std::to_string(most) + " a side",
                     std::to_string(side));
      return side;
    }
    pixels_ += std::int64_t{6} * side * side;
    if (pixels_ > load_.limits.maxImagePixels) {
      found.tooLarge(level, "The image-based lights have too many pixels together.",
                     std::to_string(load_.limits.maxImagePixels), std::to_string(pixels_));
    }
    return side;
  }

  /// What is not used, and means that other viewers may draw something else.
  void checkLevels(const gltf::ImageBasedLight& light, int side, const std::string& pointer) {
    Findings& findings = load_.findings;
    if (!std::has_single_bit(static_cast<unsigned>(side))) {
      findings.repair(kNoPowerOfTwo, pointer + "/specularImages/0", {}, std::to_string(side));
    }
    if (light.specularImageSize != side) {
      findings.repair(kOtherStatedSize, pointer + "/specularImageSize", std::to_string(side),
                      shortNumber(light.specularImageSize));
    }
    for (std::size_t level = 1; level < light.specularImages.size(); ++level) {
      const int right = level < 31 ? side >> level : 0;
      for (std::size_t face = 0; face < 6; ++face) {
        const auto size = sizeOf(light.specularImages[level][face]);
        if (size && size->width == right && size->height == right) continue;
        findings.repair(kOtherSize, pointerTo(pointerTo(pointer + "/specularImages", level), face),
                        textOf({right, right}), size ? textOf(*size) : "no picture");
      }
    }
  }

  std::shared_ptr<const CheckedImage> pictureOf(int image, const std::string& place, Findings& found) {
    auto& kept = pictures_[image];
    if (kept) return kept;
    const auto bytes = load_.document.images[static_cast<std::size_t>(image)].view();
    auto checked = checkImage(bytes, load_.limits.maxImageSide, load_.limits.maxImagePixels);
    if (!checked) {
      found.take(locatedImageProblems(std::move(checked).problems(), place));
    } else if (checked->picture.cutShort) {
      found.invalid(place, "The picture of an image-based light is cut short.");
    } else {
      kept = std::make_shared<const CheckedImage>(*std::move(checked));
    }
    return kept;
  }

  const LoadContext& load_;
  std::map<int, std::shared_ptr<const CheckedImage>> pictures_;
  std::int64_t pixels_ = 0; ///< of all lights so far
};

/// Undoes the light's; nothing for four zeros.
std::optional<glm::dmat3> cubeFromWorld(const glm::dvec4& rotation) {
  const double length = glm::length(rotation);
  if (!(length > 0)) return std::nullopt;
  const glm::dvec4 q = rotation / length;
  return glm::transpose(glm::mat3_cast(glm::dquat(q.w, q.x, q.y, q.z)));
}

} // namespace

std::vector<std::shared_ptr<const EnvironmentFile>> readImageBasedLights(const LoadContext& load) {
  const std::vector<gltf::ImageBasedLight>& lights = load.document.model.imageBasedLights;
  std::vector<std::shared_ptr<const EnvironmentFile>> read(lights.size());
  FaceReader reader(load);
  for (std::size_t i = 0; i < lights.size() && !load.findings.refused(); ++i) {
    if (!lights[i].fault.empty()) continue;
    const std::string pointer = pointerTo("/extensions/EXT_lights_image_based/lights", i);
    Findings found;
    auto cube = reader.read(lights[i], pointer, found);
    const auto turn = cubeFromWorld(lights[i].rotation);
    if (!turn) found.invalid(pointer + "/rotation", "The rotation of an image-based light is no rotation.");
    if (cube && turn) {
      cube->cubeFromWorld = *turn;
      cube->intensity = lights[i].intensity;
      cube->irradiance = lights[i].irradianceCoefficients;
      read[i] = std::make_shared<const EnvironmentFile>(*std::move(cube));
    }
    load.findings.leaveOut(std::move(found), "the light is left out");
  }
  return read;
}

} // namespace gnomon
