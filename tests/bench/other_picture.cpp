#include "tests/bench/other_picture.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "renderer/evaluation/evaluation_measures.h"
#include "tests/support/files.h"

namespace gnomon::bench {
namespace {

constexpr double kSameSurface = 0.5; ///< widths of a pixel

glm::dvec2 ndcOf(const Reference& truth, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(truth.width);
  const double x = static_cast<double>(pixel % width) + 0.5;
  const double y = static_cast<double>(pixel / width) + 0.5;
  return {2 * x / truth.width - 1, 1 - 2 * y / truth.height};
}

} // namespace

std::optional<OtherPicture> readOtherPicture(const std::filesystem::path& file, std::size_t pixels) {
  static_assert(std::endian::native == std::endian::little);
  const Bytes bytes = testing::readFile(file);
  if (pixels == 0 || bytes.size() != pixels * 2 * sizeof(float)) return std::nullopt;
  std::vector<float> values(2 * pixels);
  std::memcpy(values.data(), bytes.data(), bytes.size());
  OtherPicture picture;
  for (std::size_t i = 0; i < pixels; ++i) {
    picture.shown.push_back(values[2 * i]);
    picture.depth.push_back(values[2 * i + 1]);
  }
  return picture;
}

Alignment alignmentOf(const Reference& truth, const CameraView& view, const glm::dvec3& anchor,
                      std::span<const float> depth) {
  Alignment alignment{std::vector<std::uint8_t>(depth.size())};
  std::size_t coverage = 0;
  std::size_t surface = 0;
  std::vector<double> offsets;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const SurfacePoint& point = truth.surface[i];
    const bool here = point.instance != kNoSurface;
    if (here != (depth[i] > 0)) {
      ++coverage;
      continue;
    }
    double offset = 0;
    if (here) {
      const glm::dvec3 other = view.eye - anchor + pointAt(view, ndcOf(truth, i), static_cast<double>(depth[i]));
      offset = std::abs(glm::dot(other - point.position, glm::dvec3(point.normal))) /
               static_cast<double>(truth.pixelWidth[i]);
      offsets.push_back(offset);
    }
    const bool same = offset <= kSameSurface;
    alignment.same[i] = same ? 1 : 0;
    surface += same ? 0 : 1;
  }
  if (!offsets.empty()) alignment.offset = median(std::move(offsets));
  const auto pixels = static_cast<double>(depth.size());
  alignment.coverage = static_cast<double>(coverage) / pixels;
  alignment.surface = static_cast<double>(surface) / pixels;
  return alignment;
}

} // namespace gnomon::bench
