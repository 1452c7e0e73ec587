#pragma once

namespace gnomon {

/// A rectangle of texels; x y is the lowest corner.
struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const Rect&) const = default;
};

} // namespace gnomon
