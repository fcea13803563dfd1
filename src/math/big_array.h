/// A fixed number of elements, possibly millions, that are visited in no order.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace tyndall {

/// Uninitialised at first, so that threads may fill it page by page. Large arrays ask for large pages, against page faults and
/// the cost of address translation.
template <typename T>
class BigArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  BigArray() = default;
  /// Throws std::bad_alloc.
  explicit BigArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    const bool large = bytes() >= kPage;
    const std::size_t alignment = large ? kPage : kLine;
    const std::size_t rounded = (bytes() + kLine - 1) / kLine * kLine;
    if (size > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_alloc();
    data_.reset(static_cast<T*>(std::aligned_alloc(alignment, (rounded + alignment - 1) / alignment * alignment)));
    if (!data_) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    if (large) madvise(data_.get(), rounded / kPage * kPage, MADV_HUGEPAGE);  // a hint: its failure changes nothing
#endif
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  operator std::span<T>() { return {data(), size_}; }
  operator std::span<const T>() const { return {data(), size_}; }

 private:
  static constexpr std::size_t kPage = std::size_t(1) << 21, kLine = 64;
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace tyndall
