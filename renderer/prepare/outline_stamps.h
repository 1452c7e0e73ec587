#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace gnomon {

/// Marks the cells of one tile that edges and triangles pass through, given in the tile's clip space (x y -1..1 over
/// the tile after the division by w). A cell lies between the centres of four texels and is named after the lowest.
class Stamps {
 public:
  Stamps(int width, int height);

  void stampEdge(const glm::dvec4& a, const glm::dvec4& b);
  /// The box around the triangle.
  void stampTriangle(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c);

  /// A byte a cell, the lowest row first; 255 = marked. Leaves nothing.
  std::vector<std::uint8_t> take() { return std::move(cells_); }

 private:
  struct Span {
    glm::dvec2 lowest, highest;
  };
  void fill(const Span& box);

  int width_;
  int height_;
  std::vector<std::uint8_t> cells_;
};

} // namespace gnomon
