#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <random>
#include <vector>

namespace gnomon::cpu {

/// Numbers that a kernel takes or gives, column after column.
struct NumberTable {
  std::size_t rows = 0; ///< a multiple of 16
  std::vector<float> numbers;

  NumberTable(std::size_t rows_, std::size_t columns) : rows(rows_), numbers(rows_ * columns) {}
  std::size_t columns() const { return numbers.size() / rows; }
  float* column(std::size_t column) { return numbers.data() + column * rows; }
  const float* column(std::size_t column) const { return numbers.data() + column * rows; }
  float at(std::size_t row, std::size_t column) const { return numbers[column * rows + row]; }
  glm::vec3 triple(std::size_t row, std::size_t first) const {
    return {at(row, first), at(row, first + 1), at(row, first + 2)};
  }
};

/// Evenly spread between the bounds; the same each time.
inline NumberTable randomNumbers(std::size_t rows, std::size_t columns, float low, float high) {
  NumberTable table(rows, columns);
  std::mt19937 generator(20240607);
  std::uniform_real_distribution<float> spread(low, high);
  for (float& number : table.numbers) number = spread(generator);
  return table;
}

} // namespace gnomon::cpu
