#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace gnomon {

/// Marks the texels of one tile that lie near edges and triangles, given in the tile's clip space (x y -1..1 over the
/// tile after the division by w). A texel is marked where one passes within a texel of its centre along x and along y.
class Stamps {
 public:
  Stamps(int width, int height);

  void stampEdge(const glm::dvec4& a, const glm::dvec4& b);
  /// The box around the triangle.
  void stampTriangle(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c);

  /// A byte a texel, the lowest row first; 255 = marked. Leaves nothing.
  std::vector<std::uint8_t> take() { return std::move(texels_); }

 private:
  struct Span {
    glm::dvec2 lowest, highest;
  };
  void fill(const Span& box);

  int width_;
  int height_;
  std::vector<std::uint8_t> texels_;
};

} // namespace gnomon
