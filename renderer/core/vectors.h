#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace gnomon {

/// A vector whose copies share its elements until one of them is edited. Reading takes no more than reading a vector.
/// Threads may read copies at the same time; of those that share, one may be edited while others are read.
template <class T>
class SharedVector {
 public:
  SharedVector() : values_(std::make_shared<std::vector<T>>()) {}
  SharedVector(std::vector<T> values) : values_(std::make_shared<std::vector<T>>(std::move(values))) {}
  SharedVector(std::initializer_list<T> values) : SharedVector(std::vector<T>(values)) {}

  const std::vector<T>& operator*() const { return *values_; }
  operator const std::vector<T>&() const { return *values_; }

  std::size_t size() const { return values_->size(); }
  bool empty() const { return values_->empty(); }
  const T* data() const { return values_->data(); }
  const T& operator[](std::size_t i) const { return (*values_)[i]; }
  auto begin() const { return values_->cbegin(); }
  auto end() const { return values_->cend(); }

  /// The elements to be changed: this vector's own from now on. What is changed through a reference that is older than
  /// a copy shows in that copy.
  std::vector<T>& edit() {
    if (values_.use_count() > 1) values_ = std::make_shared<std::vector<T>>(*values_);
    return *values_;
  }

  bool sharesWith(const SharedVector& other) const { return values_ == other.values_; }
  bool operator==(const SharedVector& other) const { return sharesWith(other) || *values_ == *other.values_; }

 private:
  std::shared_ptr<std::vector<T>> values_;
};

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
