#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

namespace recoil {

/// A value together with its first partial derivatives that are not identically zero: bit k of
/// `Carried` is set if the derivative in variable k is stored. Products and sums determine their
/// derivatives at compile time, so that q * q of a q without derivatives costs one multiplication.
template <class T, unsigned Carried>
struct Partial {
  T value;
  std::array<T, static_cast<std::size_t>(std::popcount(Carried))> derivatives;

  static constexpr bool carries(unsigned k) { return (Carried >> k & 1U) != 0; }
  static constexpr std::size_t place(unsigned k) {
    return static_cast<std::size_t>(std::popcount(Carried & ((1U << k) - 1U)));
  }
  /// d value / d (variable k); zero if it is not stored.
  template <unsigned k>
  constexpr T derivative() const {
    if constexpr (carries(k)) {
      return derivatives[place(k)];
    } else {
      return T(0.0);
    }
  }
};

/// The independent variable number k.
template <unsigned k, class T>
constexpr Partial<T, 1U << k> variable(const T& value) {
  return {value, {T(1.0)}};
}

namespace partial_detail {

inline constexpr unsigned most_variables = 16;

/// Calls rule.template operator()<k>() for every variable of `Carried`.
template <unsigned Carried, class Rule>
constexpr void for_each_carried(Rule&& rule) {
  [&]<unsigned... k>(std::integer_sequence<unsigned, k...>) {
    const auto visit = [&]<unsigned variable>() {
      if constexpr ((Carried >> variable & 1U) != 0) rule.template operator()<variable>();
    };
    (visit.template operator()<k>(), ...);
  }
  (std::make_integer_sequence<unsigned, most_variables>{});
}

}  // namespace partial_detail

template <class T, unsigned A, unsigned B>
constexpr Partial<T, A | B> operator*(const Partial<T, A>& a, const Partial<T, B>& b) {
  using First = Partial<T, A>;
  using Second = Partial<T, B>;
  Partial<T, A | B> product{a.value * b.value, {}};
  partial_detail::for_each_carried<A | B>([&]<unsigned k>() {
    T& entry = product.derivatives[product.place(k)];
    if constexpr (First::carries(k) && Second::carries(k)) {
      entry = a.template derivative<k>() * b.value + a.value * b.template derivative<k>();
    } else if constexpr (First::carries(k)) {
      entry = a.template derivative<k>() * b.value;
    } else {
      entry = a.value * b.template derivative<k>();
    }
  });
  return product;
}

template <class T, unsigned A, unsigned B>
constexpr Partial<T, A | B> operator+(const Partial<T, A>& a, const Partial<T, B>& b) {
  using First = Partial<T, A>;
  using Second = Partial<T, B>;
  Partial<T, A | B> sum{a.value + b.value, {}};
  partial_detail::for_each_carried<A | B>([&]<unsigned k>() {
    T& entry = sum.derivatives[sum.place(k)];
    if constexpr (First::carries(k) && Second::carries(k)) {
      entry = a.template derivative<k>() + b.template derivative<k>();
    } else if constexpr (First::carries(k)) {
      entry = a.template derivative<k>();
    } else {
      entry = b.template derivative<k>();
    }
  });
  return sum;
}

template <class T, unsigned A>
constexpr Partial<T, A> operator-(const Partial<T, A>& a) {
  Partial<T, A> negative{-a.value, {}};
  for (std::size_t i = 0; i < a.derivatives.size(); ++i) {
    negative.derivatives[i] = -a.derivatives[i];
  }
  return negative;
}

/// Product with a factor that depends on no variable.
template <class T, unsigned A>
constexpr Partial<T, A> operator*(const std::type_identity_t<T>& factor, const Partial<T, A>& a) {
  Partial<T, A> product{factor * a.value, {}};
  for (std::size_t i = 0; i < a.derivatives.size(); ++i) {
    product.derivatives[i] = factor * a.derivatives[i];
  }
  return product;
}
template <class T, unsigned A>
constexpr Partial<T, A> operator*(const Partial<T, A>& a, const std::type_identity_t<T>& factor) {
  return factor * a;
}

/// Sum with a term that depends on no variable.
template <class T, unsigned A>
constexpr Partial<T, A> operator+(const std::type_identity_t<T>& term, const Partial<T, A>& a) {
  return {term + a.value, a.derivatives};
}
template <class T, unsigned A>
constexpr Partial<T, A> operator+(const Partial<T, A>& a, const std::type_identity_t<T>& term) {
  return {a.value + term, a.derivatives};
}

/// Quotient with a numerator that depends on no variable.
template <class T, unsigned B>
constexpr Partial<T, B> operator/(const std::type_identity_t<T>& numerator,
                                  const Partial<T, B>& b) {
  const T reciprocal = T(1.0) / b.value;
  Partial<T, B> quotient{numerator * reciprocal, {}};
  const T slope = -(quotient.value * reciprocal);
  for (std::size_t i = 0; i < b.derivatives.size(); ++i) {
    quotient.derivatives[i] = slope * b.derivatives[i];
  }
  return quotient;
}

template <class T, unsigned A>
Partial<T, A> sqrt(const Partial<T, A>& a) {
  using std::sqrt;
  Partial<T, A> root{sqrt(a.value), {}};
  const T slope = T(0.5) * (T(1.0) / root.value);
  for (std::size_t i = 0; i < a.derivatives.size(); ++i) {
    root.derivatives[i] = slope * a.derivatives[i];
  }
  return root;
}

}  // namespace recoil
