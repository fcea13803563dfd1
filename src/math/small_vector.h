/// A vector that keeps its first N elements in place: most rays cross few boundaries, some cross many.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace tyndall {

template <typename T, std::size_t N>
class SmallVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  SmallVector() {}  // leaves the elements in place uninitialised: most vectors use few
  SmallVector(const SmallVector& v) : heap_(v.heap_), size_(v.size_) { copy_inline(v); }
  SmallVector(SmallVector&& v) noexcept : heap_(std::move(v.heap_)), size_(v.size_) { copy_inline(v); }
  SmallVector& operator=(const SmallVector& v) {
    heap_ = v.heap_;
    size_ = v.size_;
    copy_inline(v);
    return *this;
  }
  SmallVector& operator=(SmallVector&& v) noexcept {
    heap_ = std::move(v.heap_);
    size_ = v.size_;
    copy_inline(v);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

  T* data() { return size_ > N ? heap_.data() : inline_.data(); }
  const T* data() const { return size_ > N ? heap_.data() : inline_.data(); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T& back() const { return data()[size_ - 1]; }

  void push_back(const T& value) {
    if (size_ < N) {
      inline_[size_++] = value;
      return;
    }
    if (size_ == N) heap_.assign(inline_.begin(), inline_.end());
    heap_.resize(size_);
    heap_.push_back(value);
    ++size_;
  }

  /// Keep the first `count` elements; `count` must not exceed size().
  void truncate(std::size_t count) {
    if (size_ > N && count <= N) std::copy_n(heap_.begin(), count, inline_.begin());
    size_ = count;
  }

  /// Remove element i, keeping the order of the others.
  void erase(std::size_t i) {
    for (std::size_t j = i + 1; j < size_; ++j) data()[j - 1] = data()[j];
    truncate(size_ - 1);
  }

 private:
  void copy_inline(const SmallVector& v) {
    if (size_ <= N) std::copy_n(v.inline_.begin(), size_, inline_.begin());
  }

  union {
    std::array<T, N> inline_;
  };
  std::vector<T> heap_;
  std::size_t size_ = 0;
};

}  // namespace tyndall
