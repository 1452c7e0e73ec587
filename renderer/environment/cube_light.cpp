#include "renderer/environment/cube_light.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "protocol/spec/limits.h"
#include "renderer/core/parallel.h"
#include "renderer/core/srgb.h"
#include "renderer/environment/environment_checks.h"

namespace gnomon {
namespace {

/// Where a face lies in the glTF's directions, and where its columns and rows go.
struct FaceAxes {
  glm::dvec3 out, across, down;
};
constexpr std::array<FaceAxes, 6> kFaceAxes{{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                             {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                             {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                             {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                             {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
                                             {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}}};

/// A place on a face, -1..1 along its columns and rows.
struct FacePlace {
  std::size_t face = 0;
  double across = 0, down = 0;
};

FacePlace placeOnCube(const glm::dvec3& direction) {
  const glm::dvec3 size = glm::abs(direction);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const bool negative = direction[axis] < 0;
  const std::size_t face = axis == 2 ? (negative ? 4 : 5) : static_cast<std::size_t>(2 * axis + (negative ? 1 : 0));
  const FaceAxes& axes = kFaceAxes[face];
  return {face, glm::dot(direction, axes.across) / size[axis], glm::dot(direction, axes.down) / size[axis]};
}

/// The faces with a border of one texel each, which holds what lies across their edges.
class CubeTexels {
 public:
  explicit CubeTexels(int side) : side_(side) {
    for (auto& face : faces_) face.resize(static_cast<std::size_t>(side + 2) * static_cast<std::size_t>(side + 2));
  }

  /// -1 and `side` are the border.
  glm::vec3& at(std::size_t face, int column, int row) { return faces_[face][indexOf(column, row)]; }
  const glm::vec3& at(std::size_t face, int column, int row) const { return faces_[face][indexOf(column, row)]; }

  void fillBorders() {
    for (std::size_t face = 0; face < faces_.size(); ++face) {
      for (int i = -1; i <= side_; ++i) {
        for (const auto& [column, row] : {std::pair(i, -1), std::pair(i, side_), std::pair(-1, i), std::pair(side_, i)})
          at(face, column, row) = across(face, column, row);
      }
    }
  }

  /// Linearly between texels.
  glm::vec3 towards(const glm::dvec3& direction) const {
    const FacePlace place = placeOnCube(direction);
    const double x = (place.across + 1) / 2 * side_ - 0.5, y = (place.down + 1) / 2 * side_ - 0.5;
    const int column = std::clamp(static_cast<int>(std::floor(x)), -1, side_ - 1);
    const int row = std::clamp(static_cast<int>(std::floor(y)), -1, side_ - 1);
    const auto s = static_cast<float>(x - column), t = static_cast<float>(y - row);
    const glm::vec3 first = glm::mix(at(place.face, column, row), at(place.face, column + 1, row), s);
    const glm::vec3 second = glm::mix(at(place.face, column, row + 1), at(place.face, column + 1, row + 1), s);
    return glm::mix(first, second, t);
  }

 private:
  std::size_t indexOf(int column, int row) const {
    return static_cast<std::size_t>(row + 1) * static_cast<std::size_t>(side_ + 2) +
           static_cast<std::size_t>(column + 1);
  }

  /// What another face has in the direction of a texel of the border.
  glm::vec3 across(std::size_t face, int column, int row) const {
    const FaceAxes& axes = kFaceAxes[face];
    const auto along = [&](int i) { return (2.0 * i + 1) / side_ - 1; };
    const FacePlace place = placeOnCube(axes.out + axes.across * along(column) + axes.down * along(row));
    const auto texel = [&](double p) { return std::clamp(static_cast<int>((p + 1) / 2 * side_), 0, side_ - 1); };
    return at(place.face, texel(place.across), texel(place.down));
  }

  int side_;
  std::array<std::vector<glm::vec3>, 6> faces_;
};

Status readFace(const CheckedImage& image, const std::string& place, double intensity, std::size_t face,
                CubeTexels& texels) {
  const DecodedImage decoded = decodeImage(image);
  if (!decoded.wrong.empty() || image.picture.cutShort) {
    return invalidValue("", "The picture of an image-based light at " + place + " is damaged.", "",
                        image.picture.cutShort ? "cut short" : decoded.wrong);
  }
  std::array<double, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearOf(static_cast<double>(i) / 255) * intensity;
  const std::uint8_t* rgba = std::get<std::vector<std::uint8_t>>(decoded.image.pixels).data();
  for (int row = 0; row < image.size.height; ++row) {
    for (int column = 0; column < image.size.width; ++column, rgba += 4) {
      if (rgba[3] == 0) {
        return invalidValue("",
                            "The picture of an image-based light at " + place +
                                " has an alpha of 0, by which its color would be divided: column " +
                                std::to_string(column) + ", row " + std::to_string(row) + ".",
                            "1..255", "0");
      }
      const double share = rgba[3] / 255.0;
      texels.at(face, column, row) = glm::dvec3(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]) / share;
    }
  }
  return Done{};
}

Result<CubeTexels> readFaces(const CubeLight& light) {
  CubeTexels texels(sideOf(light));
  const Status read = forEachOrProblems(light.faces.size(), [&](std::size_t face) {
    return readFace(*light.faces[face], light.places[face], light.intensity, face, texels);
  });
  if (!read) return read.problems();
  texels.fillBorders();
  return texels;
}

constexpr int kSamplesAcross = 4; ///< of a texel of the map: a texel of the cube is at no place finer than half of it

/// The directions of the samples of a row or a column: cosine and sine of each angle.
std::vector<glm::dvec2> turns(int texels, double angle, double from) {
  std::vector<glm::dvec2> all;
  const int samples = texels * kSamplesAcross;
  for (int i = 0; i < samples; ++i) {
    const double at = from + angle * (i + 0.5) / samples;
    all.emplace_back(std::cos(at), std::sin(at));
  }
  return all;
}

EnvironmentMap resampled(const CubeTexels& texels, const glm::dmat3& cubeFromWorld, const glm::ivec2& size) {
  EnvironmentMap map{size.x, size.y, {}};
  const auto width = static_cast<std::size_t>(size.x), height = static_cast<std::size_t>(size.y);
  map.texels.resize(width * height);
  const std::vector<glm::dvec2> longitudes = turns(size.x, glm::two_pi<double>(), -glm::pi<double>());
  const std::vector<glm::dvec2> colatitudes = turns(size.y, glm::pi<double>(), 0);
  forEachPiece(height, 4, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first * width; i < last * width; ++i) {
      const std::size_t left = i % width * kSamplesAcross, top = i / width * kSamplesAcross;
      glm::dvec3 sum(0);
      double weights = 0;
      for (std::size_t row = top; row < top + kSamplesAcross; ++row) {
        const auto [up, across] = std::pair(colatitudes[row].x, colatitudes[row].y);
        glm::dvec3 ofRow(0);
        for (std::size_t column = left; column < left + kSamplesAcross; ++column) {
          const glm::dvec2& turn = longitudes[column];
          ofRow += glm::dvec3(texels.towards(cubeFromWorld * glm::dvec3(across * turn.x, up, across * turn.y)));
        }
        sum += ofRow * across;
        weights += across * kSamplesAcross;
      }
      map.texels[i] = glm::vec3(sum / weights);
    }
  });
  return map;
}

} // namespace

glm::ivec2 mapSizeOf(int side) {
  const int width = std::max(4 * side, kLimits.minEnvironmentWidth);
  return {width, width / 2};
}

std::uint64_t bytesIn(const CubeLight& light) {
  std::uint64_t bytes = 0;
  for (const auto& face : light.faces) bytes += face->picture.bytes.size();
  return bytes;
}

Result<EnvironmentMap> readCube(const CubeLight& light) {
  const auto texels = readFaces(light);
  if (!texels) return texels.problems();
  EnvironmentMap map = resampled(*texels, light.cubeFromWorld, mapSizeOf(sideOf(light)));
  if (const Status sound = checkEnvironmentTexels(map); !sound) return sound.problems();
  return map;
}

} // namespace gnomon
