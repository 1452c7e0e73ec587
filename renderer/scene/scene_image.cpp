#include "renderer/scene/scene_image.h"

#include <algorithm>
#include <new>
#include <numeric>
#include <utility>
#include <variant>

#include "renderer/core/parallel.h"
#include "renderer/image/image.h"

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
  if (cutShort_) return; // reported when it was loaded
  const std::lock_guard lock(mutex_);
  wrong_ = wrong;
}

std::string SceneImage::damage() const {
  const std::lock_guard lock(mutex_);
  if (wrong_.empty()) return {};
  return "The image at " + pointer_ + " is damaged (" + wrong_ + "); what could be read of it is drawn.";
}

Problem SceneImage::withoutMemory() const {
  return noMemory(pointer_, "There is not enough memory for this image.");
}

Status SceneImage::decode() const {
  try {
    decoded();
    return Done{};
  } catch (const std::bad_alloc&) {
    return withoutMemory();
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
    return withoutMemory();
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

AlphaPlane::AlphaPlane(int width, int height)
    : width_(width),
      height_(height),
      squaresAcross_(squaresOf(width)),
      texels_(squaresAcross_ * squaresOf(height) * kSide * kSide) {}

AlphaPlane::AlphaPlane(const Image& image) : AlphaPlane(image.width, image.height) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const std::uint8_t* alpha = std::get<std::vector<std::uint8_t>>(image.pixels).data() + 3;
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t first = 0; first < width; first += kSide) {
      const std::size_t count = std::min(kSide, width - first);
      std::uint8_t* to = &texels_[placeOf(first, row)];
      for (std::size_t i = 0; i < count; ++i) to[i] = alpha[4 * (row * width + first + i)];
    }
  }
}

AlphaPlane AlphaPlane::halved() const {
  AlphaPlane half(std::max(width_ / 2, 1), std::max(height_ / 2, 1));
  const std::vector<BetweenTexels> across = betweenTexels(width_, half.width_);
  const std::vector<BetweenTexels> down = betweenTexels(height_, half.height_);
  for (std::size_t row = 0; row < down.size(); ++row) {
    const BetweenTexels& y = down[row];
    for (std::size_t column = 0; column < across.size(); ++column) {
      const BetweenTexels& x = across[column];
      const double above = at(x.first, y.first) * (1 - x.share) + at(x.second, y.first) * x.share;
      const double below = at(x.first, y.second) * (1 - x.share) + at(x.second, y.second) * x.share;
      half.texels_[half.placeOf(column, row)] =
          static_cast<std::uint8_t>(above * (1 - y.share) + below * y.share + 0.5);
    }
  }
  return half;
}

AlphaLevels::AlphaLevels(AlphaPlane largest) {
  levels_.push_back(std::move(largest));
  while (levels_.back().width() > 1 || levels_.back().height() > 1) levels_.push_back(levels_.back().halved());
}

std::size_t AlphaLevels::bytes() const {
  return std::accumulate(levels_.begin(), levels_.end(), std::size_t{0},
                         [](std::size_t sum, const AlphaPlane& level) { return sum + level.bytes(); });
}

} // namespace gnomon
