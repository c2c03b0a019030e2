#pragma once

#include <cstddef>
#include <cstdint>

#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace recoil {

// Packs of doubles with the names and meanings of the C++ standard's std::simd, as far as the fast
// solver needs them, on the vector extensions of g++ and clang. Every lane does what double does.

template <class T, int n>
struct Register {
  using Type [[gnu::vector_size(sizeof(T) * n)]] = T;
};

template <int n>
class LaneMask {
 public:
  using Raw = typename Register<std::int64_t, n>::Type;  // of each lane: -1 or 0

  LaneMask() = default;
  [[gnu::always_inline]] LaneMask(bool all) : raw_(Raw{} - std::int64_t{all}) {}
  [[gnu::always_inline]] explicit LaneMask(const Raw& raw) : raw_(raw) {}

  [[gnu::always_inline]] const Raw& raw() const { return raw_; }
  [[gnu::always_inline]] bool operator[](std::size_t lane) const { return raw_[lane] != 0; }
  [[gnu::always_inline]] LaneMask operator!() const { return LaneMask(~raw_); }
  [[gnu::always_inline]] friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) {
    return LaneMask(a.raw_ & b.raw_);
  }
  [[gnu::always_inline]] friend LaneMask operator||(const LaneMask& a, const LaneMask& b) {
    return LaneMask(a.raw_ | b.raw_);
  }
  [[gnu::always_inline]] friend bool any_of(const LaneMask& mask) {
#ifdef __x86_64__
    if constexpr (n == 2) return _mm_movemask_pd(reinterpret_cast<__m128d>(mask.raw_)) != 0;
    if constexpr (n == 4) return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask.raw_)) != 0;
    if constexpr (n == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask.raw_)) != 0;
#endif
    std::int64_t some = mask.raw_[0];
    for (std::size_t lane = 1; lane < n; ++lane) some |= mask.raw_[lane];
    return some != 0;
  }
  [[gnu::always_inline]] friend bool none_of(const LaneMask& mask) { return !any_of(mask); }
  [[gnu::always_inline]] friend bool all_of(const LaneMask& mask) { return !any_of(!mask); }

  class Lane {
   public:
    [[gnu::always_inline]] Lane(Raw& raw, std::size_t lane) : raw_(raw), lane_(lane) {}
    [[gnu::always_inline]] operator bool() const { return raw_[lane_] != 0; }
    [[gnu::always_inline]] Lane& operator=(bool value) {
      raw_[lane_] = value ? -1 : 0;
      return *this;
    }
    [[gnu::always_inline]] Lane& operator=(const Lane& other) { return *this = bool(other); }

   private:
    Raw& raw_;
    std::size_t lane_;
  };
  [[gnu::always_inline]] Lane operator[](std::size_t lane) { return {raw_, lane}; }

 private:
  Raw raw_;
};

template <int n>
class Lanes {
 public:
  using Raw = typename Register<double, n>::Type;
  using mask_type = LaneMask<n>;

  Lanes() = default;
  [[gnu::always_inline]] Lanes(double all) : raw_(all - Raw{}) {}
  [[gnu::always_inline]] explicit Lanes(const Raw& raw) : raw_(raw) {}
  [[gnu::always_inline]] explicit Lanes(const double* from) {
    __builtin_memcpy(&raw_, from, 8 * n);
  }
  [[gnu::always_inline]] void copy_to(double* to) const { __builtin_memcpy(to, &raw_, 8 * n); }

  static constexpr std::size_t size() { return n; }
  [[gnu::always_inline]] const Raw& raw() const { return raw_; }
  [[gnu::always_inline]] double operator[](std::size_t lane) const { return raw_[lane]; }

  [[gnu::always_inline]] Lanes operator-() const { return Lanes(-raw_); }
  [[gnu::always_inline]] Lanes& operator+=(const Lanes& o) { return *this = *this + o; }
  [[gnu::always_inline]] Lanes& operator-=(const Lanes& o) { return *this = *this - o; }
  [[gnu::always_inline]] Lanes& operator*=(const Lanes& o) { return *this = *this * o; }
  [[gnu::always_inline]] Lanes& operator/=(const Lanes& o) { return *this = *this / o; }
  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return Lanes(a.raw_ + b.raw_);
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return Lanes(a.raw_ - b.raw_);
  }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return Lanes(a.raw_ * b.raw_);
  }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return Lanes(a.raw_ / b.raw_);
  }
  [[gnu::always_inline]] friend mask_type operator<(const Lanes& a, const Lanes& b) {
    return mask_type(a.raw_ < b.raw_);
  }
  [[gnu::always_inline]] friend mask_type operator<=(const Lanes& a, const Lanes& b) {
    return mask_type(a.raw_ <= b.raw_);
  }
  [[gnu::always_inline]] friend mask_type operator>(const Lanes& a, const Lanes& b) {
    return b < a;
  }
  [[gnu::always_inline]] friend mask_type operator>=(const Lanes& a, const Lanes& b) {
    return b <= a;
  }
  [[gnu::always_inline]] friend mask_type operator==(const Lanes& a, const Lanes& b) {
    return mask_type(a.raw_ == b.raw_);
  }

  /// The larger (smaller) of the two; `b` where either is not a number.
  [[gnu::always_inline]] friend Lanes max(const Lanes& a, const Lanes& b) {
#ifdef __x86_64__
    if constexpr (n == 2) return Lanes(_mm_max_pd(a.raw_, b.raw_));
    if constexpr (n == 4) return Lanes(_mm256_max_pd(a.raw_, b.raw_));
    if constexpr (n == 8) return Lanes(_mm512_max_pd(a.raw_, b.raw_));
#endif
    return Lanes(a.raw_ > b.raw_ ? a.raw_ : b.raw_);
  }
  [[gnu::always_inline]] friend Lanes min(const Lanes& a, const Lanes& b) {
#ifdef __x86_64__
    if constexpr (n == 2) return Lanes(_mm_min_pd(a.raw_, b.raw_));
    if constexpr (n == 4) return Lanes(_mm256_min_pd(a.raw_, b.raw_));
    if constexpr (n == 8) return Lanes(_mm512_min_pd(a.raw_, b.raw_));
#endif
    return Lanes(a.raw_ < b.raw_ ? a.raw_ : b.raw_);
  }
  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) {
    using Bits = typename mask_type::Raw;
    return Lanes(reinterpret_cast<Raw>(reinterpret_cast<Bits>(a.raw_) & INT64_MAX));
  }
  [[gnu::always_inline]] friend Lanes sqrt(const Lanes& a) {
#ifdef __x86_64__
    if constexpr (n == 2) return Lanes(_mm_sqrt_pd(a.raw_));
    if constexpr (n == 4) return Lanes(_mm256_sqrt_pd(a.raw_));
    if constexpr (n == 8) return Lanes(_mm512_sqrt_pd(a.raw_));
#endif
    Lanes root;
    for (std::size_t lane = 0; lane < n; ++lane) root.raw_[lane] = __builtin_sqrt(a.raw_[lane]);
    return root;
  }

  class Lane {
   public:
    [[gnu::always_inline]] Lane(Raw& raw, std::size_t lane) : raw_(raw), lane_(lane) {}
    [[gnu::always_inline]] operator double() const { return raw_[lane_]; }
    [[gnu::always_inline]] Lane& operator=(double value) {
      raw_[lane_] = value;
      return *this;
    }
    [[gnu::always_inline]] Lane& operator=(const Lane& other) { return *this = double(other); }

   private:
    Raw& raw_;
    std::size_t lane_;
  };
  [[gnu::always_inline]] Lane operator[](std::size_t lane) { return {raw_, lane}; }

 private:
  Raw raw_;
};

/// What an assignment to where(mask, pack) changes: the lanes of `pack` that `mask` names.
template <int n, class Pack>
struct Chosen {
  const LaneMask<n> mask;
  Pack& pack;

  [[gnu::always_inline]] Chosen& operator=(const Pack& value) {
    pack = Pack(mask.raw() ? value.raw() : pack.raw());
    return *this;
  }
  [[gnu::always_inline]] void operator+=(const Pack& value) { *this = pack + value; }
  [[gnu::always_inline]] void operator*=(const Pack& value) { *this = pack * value; }
};
template <int n>
[[gnu::always_inline]] inline Chosen<n, Lanes<n>> where(const LaneMask<n>& mask, Lanes<n>& pack) {
  return {mask, pack};
}
template <int n>
[[gnu::always_inline]] inline Chosen<n, LaneMask<n>> where(const LaneMask<n>& mask,
                                                           LaneMask<n>& pack) {
  return {mask, pack};
}

}  // namespace recoil
