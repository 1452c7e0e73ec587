#pragma once

#include <algorithm>
#include <cstddef>

#include "renderer/techniques/same_surface.h"
#include "renderer/techniques/sky_square.h"

/// Weighted sums over the pixels around each pixel of a row of a square, as planes are fitted to: over those that show
/// the same surface, compared pair by pair; or, where all of a square show one, over all of them, first along rows,
/// then across.
namespace gnomon::sky_sums {

inline constexpr std::size_t kRow = SkySquare::kSide; ///< pixels

inline constexpr SurfaceLimits kSkySurface{.flat = 0.04f, .leastCosine = 0.9f};
inline constexpr float kSkyFewest = 1e-3f; ///< squared pixels; without a second direction there is no slope

/// Weighted sums over the pixels of one surface around each pixel of a row.
struct Weighted {
  alignas(64) float one[kRow], x[kRow], y[kRow], xx[kRow], xy[kRow], yy[kRow], squared[kRow];
};
struct OfShare {
  alignas(64) float sum[kRow], byX[kRow], byY[kRow];
};

[[gnu::always_inline]] inline void clear(Weighted& sums) {
  for (std::size_t i = 0; i < kRow; ++i) {
    sums.one[i] = sums.x[i] = sums.y[i] = sums.xy[i] = sums.squared[i] = 0;
    sums.xx[i] = sums.yy[i] = kSkyFewest;
  }
}
[[gnu::always_inline]] inline void clear(OfShare& sums) {
  for (std::size_t i = 0; i < kRow; ++i) sums.sum[i] = sums.byX[i] = sums.byY[i] = 0;
}

/// The diffuse shares, and the mirrored ones: each with weights of its own.
struct Sums {
  Weighted diffuse, mirrored;
  OfShare share[4];
  alignas(64) float squares[2][kRow], noise[2][kRow];
};

[[gnu::always_inline]] inline void add(const SkySquare& square, std::size_t first, int right, int up, float part,
                                       Sums& sums) {
  const auto to = static_cast<std::size_t>(up * SkySquare::kWidth + right);
  const auto x = static_cast<float>(right);
  const auto y = static_cast<float>(up);
  for (std::size_t i = 0; i < kRow; ++i) {
    const std::size_t other = first + i + to;
    const float same = showsSame(square, other, first + i, kSkySurface) != 0 ? part : 0.0f;
    const float one = same * square.weight[other];
    const float mirror = same * square.mirror[other];
    const auto addTo = [&](Weighted& w, float by) {
      w.one[i] += by;
      w.x[i] += by * x;
      w.y[i] += by * y;
      w.xx[i] += by * x * x;
      w.xy[i] += by * x * y;
      w.yy[i] += by * y * y;
      w.squared[i] += by * by;
    };
    addTo(sums.diffuse, one);
    addTo(sums.mirrored, mirror);
    for (std::size_t c = 0; c < 4; ++c) {
      const float by = (c < 3 ? one : mirror) * square.share[c][other];
      sums.share[c].sum[i] += by;
      sums.share[c].byX[i] += by * x;
      sums.share[c].byY[i] += by * y;
    }
    const float green = square.share[1][other];
    const float alpha = square.share[3][other];
    sums.squares[0][i] += one * green * green;
    sums.squares[1][i] += mirror * alpha * alpha;
    sums.noise[0][i] += one * square.noise[other];
    sums.noise[1][i] += mirror * square.noise[other];
  }
}

[[gnu::always_inline]] inline void clear(Sums& sums) {
  clear(sums.diffuse);
  clear(sums.mirrored);
  for (OfShare& share : sums.share) clear(share);
  for (auto& squares : sums.squares) std::fill_n(squares, kRow, 0.0f);
  for (auto& noise : sums.noise) std::fill_n(noise, kRow, 0.0f);
}

/// Pixels at the border count by halves.
constexpr float partAt(int away, int reach) {
  return away == reach || away == -reach ? 0.5f : 1.0f;
}

[[gnu::always_inline]] inline void addAll(const SkySquare& square, std::size_t first, int reach, Sums& sums) {
  for (int up = -reach; up <= reach; ++up) {
    for (int right = -reach; right <= reach; ++right) {
      add(square, first, right, up, partAt(right, reach) * partAt(up, reach), sums);
    }
  }
}

/// Sums over the pixels to the left and right of each pixel of a row, by powers of how far they are to the right.
struct RowSums {
  struct OfWeight {
    alignas(64) float one[kRow], x[kRow], xx[kRow], squared[kRow], squares[kRow], noise[kRow];
  };
  struct OfShare {
    alignas(64) float sum[kRow], byX[kRow];
  };
  OfWeight diffuse, mirrored;
  OfShare share[4];
};

[[gnu::always_inline]] inline void addRow(const float* weight, const float* share, const float* noise, float x,
                                          float part, RowSums::OfWeight& sums) {
  for (std::size_t i = 0; i < kRow; ++i) {
    const float by = part * weight[i];
    sums.one[i] += by;
    sums.x[i] += by * x;
    sums.xx[i] += by * x * x;
    sums.squared[i] += by * by;
    sums.squares[i] += by * share[i] * share[i];
    sums.noise[i] += by * noise[i];
  }
}

[[gnu::always_inline]] inline void addRow(const float* weight, const float* share, float x, float part,
                                          RowSums::OfShare& sums) {
  for (std::size_t i = 0; i < kRow; ++i) {
    const float by = part * weight[i] * share[i];
    sums.sum[i] += by;
    sums.byX[i] += by * x;
  }
}

[[gnu::always_inline]] inline void addRow(const SkySquare& square, std::size_t from, float x, float part,
                                          RowSums& sums) {
  addRow(square.weight + from, square.share[1] + from, square.noise + from, x, part, sums.diffuse);
  addRow(square.mirror + from, square.share[3] + from, square.noise + from, x, part, sums.mirrored);
  for (std::size_t c = 0; c < 3; ++c) addRow(square.weight + from, square.share[c] + from, x, part, sums.share[c]);
  addRow(square.mirror + from, square.share[3] + from, x, part, sums.share[3]);
}

[[gnu::always_inline]] inline void addUp(const RowSums::OfWeight& row, float y, float part, Weighted& sums,
                                         float* squares, float* noise) {
  for (std::size_t i = 0; i < kRow; ++i) {
    const float one = part * row.one[i];
    const float byX = part * row.x[i];
    sums.one[i] += one;
    sums.x[i] += byX;
    sums.y[i] += one * y;
    sums.xx[i] += part * row.xx[i];
    sums.xy[i] += byX * y;
    sums.yy[i] += one * y * y;
    sums.squared[i] += part * part * row.squared[i];
    squares[i] += part * row.squares[i];
    noise[i] += part * row.noise[i];
  }
}

[[gnu::always_inline]] inline void addUp(const RowSums& row, float y, float part, Sums& sums) {
  addUp(row.diffuse, y, part, sums.diffuse, sums.squares[0], sums.noise[0]);
  addUp(row.mirrored, y, part, sums.mirrored, sums.squares[1], sums.noise[1]);
  for (std::size_t c = 0; c < 4; ++c) {
    OfShare& share = sums.share[c];
    for (std::size_t i = 0; i < kRow; ++i) {
      const float sum = part * row.share[c].sum[i];
      share.sum[i] += sum;
      share.byX[i] += part * row.share[c].byX[i];
      share.byY[i] += sum * y;
    }
  }
}

[[gnu::always_inline]] inline void addRows(const SkySquare& square, int reach, RowSums* rows) {
  for (std::size_t y = 0; y < SkySquare::kWidth; ++y) {
    RowSums sums{}; // what nothing else can refer to becomes vectors
    const std::size_t first = y * SkySquare::kWidth + SkySquare::kReach;
    for (int right = -reach; right <= reach; ++right) {
      addRow(square, first + static_cast<std::size_t>(right), static_cast<float>(right), partAt(right, reach), sums);
    }
    rows[y] = sums;
  }
}

[[gnu::always_inline]] inline void addAcross(const RowSums* rows, std::size_t y, int reach, Sums& sums) {
  for (int up = -reach; up <= reach; ++up) {
    addUp(rows[y + static_cast<std::size_t>(up)], static_cast<float>(up), partAt(up, reach), sums);
  }
}

} // namespace gnomon::sky_sums
