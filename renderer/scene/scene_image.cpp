#include "renderer/scene/scene_image.h"

#include <algorithm>
#include <new>
#include <utility>

#include "renderer/core/parallel.h"

namespace gnomon {

SceneImage::SceneImage(CheckedImage file, std::string pointer)
    : size_(file.size),
      bytes_(std::max(
          std::uint64_t{4} * static_cast<std::uint64_t>(size_.width) * static_cast<std::uint64_t>(size_.height),
          std::uint64_t{file.picture.bytes.size()})),
      cutShort_(file.picture.cutShort),
      pointer_(std::move(pointer)),
      file_(std::make_shared<const CheckedImage>(std::move(file))) {}

SceneImage::SceneImage(Image decoded)
    : size_{decoded.width, decoded.height},
      bytes_(std::get<std::vector<std::uint8_t>>(decoded.pixels).size()),
      decoded_(std::make_shared<const Image>(std::move(decoded))) {}

const std::shared_ptr<const Image>& SceneImage::decoded() const {
  std::call_once(once_, [this] {
    if (decoded_) return;
    DecodedImage decoded = decodeImage(*file_);
    decoded_ = std::make_shared<const Image>(std::move(decoded.image));
    note(decoded.wrong);
    const std::lock_guard lock(mutex_);
    file_.reset();
  });
  return decoded_;
}

void SceneImage::note(const std::string& wrong) const {
  if (cutShort_) return; // told when it was loaded
  const std::lock_guard lock(mutex_);
  wrong_ = wrong;
}

std::string SceneImage::damage() const {
  const std::lock_guard lock(mutex_);
  if (wrong_.empty()) return {};
  return "The image at " + pointer_ + " is damaged (" + wrong_ + "); what could be read of it is drawn.";
}

Problem SceneImage::noMemory() const {
  return {ProblemCode::tooLarge, pointer_, "There is not enough memory for this image."};
}

Status SceneImage::decode() const {
  try {
    decoded();
    return Done{};
  } catch (const std::bad_alloc&) {
    return noMemory();
  }
}

std::shared_ptr<const AlphaLevels> SceneImage::alpha() const {
  const Image& image = pixels();
  const std::lock_guard lock(mutex_);
  auto alpha = alpha_.lock();
  if (alpha == nullptr) alpha_ = alpha = std::make_shared<const AlphaLevels>(AlphaPlane(image));
  return alpha;
}

Status SceneImage::readRows(int atOnce, const TakeRows& take) const {
  std::shared_ptr<const CheckedImage> file;
  {
    const std::lock_guard lock(mutex_);
    file = file_;
  }
  try {
    if (file) {
      note(decodeRows(*file, atOnce, take));
      return Done{};
    }
    take(0, std::get<std::vector<std::uint8_t>>(decoded()->pixels));
    return Done{};
  } catch (const std::bad_alloc&) {
    return noMemory();
  }
}

Problems locatedImageProblems(Problems problems, const std::string& pointer) {
  for (Problem& problem : problems) {
    problem.pointer = pointer;
    if (problem.code == ProblemCode::malformed || problem.code == ProblemCode::invalidValue) {
      problem.code = ProblemCode::invalidScene;
    }
  }
  return problems;
}

std::vector<std::string> damageOf(const SceneImages& images) {
  std::vector<std::string> damage;
  for (const auto& image : images) {
    if (std::string found = image->damage(); !found.empty()) damage.push_back(std::move(found));
  }
  return damage;
}

Status decodeImages(const SceneImages& images, std::span<const int> indices) {
  return forEachOrProblems(indices.size(),
                           [&](std::size_t i) { return images[static_cast<std::size_t>(indices[i])]->decode(); });
}

} // namespace gnomon
