#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace gnomon {

/// Of vectors whose new elements hold anything until they are written: a large one takes no memory before.
template <class T>
struct Unfilled : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = Unfilled<U>;
  };
  template <class U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... From>
  void construct(U* at, From&&... from) {
    ::new (static_cast<void*>(at)) U(std::forward<From>(from)...);
  }
};

template <class T>
using UnfilledVector = std::vector<T, Unfilled<T>>;

} // namespace gnomon
