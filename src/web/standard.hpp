#pragma once

// What libc++ 14, emscripten's, lacks of the standard library; included before every source there.

#ifdef __cplusplus

#include <algorithm>
#include <bit>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>

#ifdef _LIBCPP_VERSION

namespace std {

#if !defined(__cpp_lib_bit_cast)
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

namespace ranges {

struct as_it_is {
  template <class T>
  constexpr T&& operator()(T&& value) const {
    return static_cast<T&&>(value);
  }
};
struct ascending {
  template <class A, class B>
  constexpr bool operator()(const A& a, const B& b) const {
    return a < b;
  }
};
template <class Compare, class Projection>
constexpr auto projected(Compare& compare, Projection& of) {
  return [&](auto&& a, auto&& b) {
    return bool(std::invoke(compare, std::invoke(of, a), std::invoke(of, b)));
  };
}

template <class Range, class Test, class Projection = as_it_is>
constexpr auto find_if(Range&& range, Test test, Projection of = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& one) { return bool(std::invoke(test, std::invoke(of, one))); });
}
template <class Range, class Test, class Projection = as_it_is>
constexpr auto find_if_not(Range&& range, Test test, Projection of = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& one) { return !bool(std::invoke(test, std::invoke(of, one))); });
}
template <class Range, class T, class Projection = as_it_is>
constexpr auto find(Range&& range, const T& value, Projection of = {}) {
  return std::find_if(std::begin(range), std::end(range),
                      [&](auto&& one) { return std::invoke(of, one) == value; });
}
template <class Range, class Test, class Projection = as_it_is>
constexpr bool any_of(Range&& range, Test test, Projection of = {}) {
  return ranges::find_if(range, test, of) != std::end(range);
}
template <class Range, class Test, class Projection = as_it_is>
constexpr bool none_of(Range&& range, Test test, Projection of = {}) {
  return !ranges::any_of(range, test, of);
}
template <class Range, class Test, class Projection = as_it_is>
constexpr bool all_of(Range&& range, Test test, Projection of = {}) {
  return ranges::find_if_not(range, test, of) == std::end(range);
}
template <class Range, class Test, class Projection = as_it_is>
constexpr auto count_if(Range&& range, Test test, Projection of = {}) {
  return std::count_if(std::begin(range), std::end(range),
                       [&](auto&& one) { return bool(std::invoke(test, std::invoke(of, one))); });
}
template <class Range, class T, class Projection = as_it_is>
constexpr auto count(Range&& range, const T& value, Projection of = {}) {
  return std::count_if(std::begin(range), std::end(range),
                       [&](auto&& one) { return std::invoke(of, one) == value; });
}

#define RECOIL_BY_ORDER(algorithm)                                                     \
  template <class Range, class Compare = ascending, class Projection = as_it_is>       \
  constexpr auto algorithm(Range&& range, Compare compare = {}, Projection of = {}) {  \
    return std::algorithm(std::begin(range), std::end(range), projected(compare, of)); \
  }
RECOIL_BY_ORDER(sort)
RECOIL_BY_ORDER(stable_sort)
RECOIL_BY_ORDER(is_sorted)
RECOIL_BY_ORDER(min_element)
RECOIL_BY_ORDER(max_element)
#undef RECOIL_BY_ORDER

template <class Range, class T, class Compare = ascending, class Projection = as_it_is>
constexpr auto lower_bound(Range&& range, const T& value, Compare compare = {},
                           Projection of = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](auto&& a, const T& b) {
    return bool(std::invoke(compare, std::invoke(of, a), b));
  });
}
template <class Range, class T, class Compare = ascending, class Projection = as_it_is>
constexpr auto upper_bound(Range&& range, const T& value, Compare compare = {},
                           Projection of = {}) {
  return std::upper_bound(std::begin(range), std::end(range), value, [&](const T& a, auto&& b) {
    return bool(std::invoke(compare, a, std::invoke(of, b)));
  });
}
template <class Range, class Test = std::equal_to<>, class Projection = as_it_is>
constexpr auto adjacent_find(Range&& range, Test test = {}, Projection of = {}) {
  return std::adjacent_find(std::begin(range), std::end(range), [&](auto&& a, auto&& b) {
    return bool(std::invoke(test, std::invoke(of, a), std::invoke(of, b)));
  });
}
template <class Range, class Out, class Test>
constexpr void copy_if(Range&& range, Out out, Test test) {
  std::copy_if(std::begin(range), std::end(range), out, test);
}
template <class Range, class T>
constexpr void replace(Range&& range, const T& old, const T& with) {
  std::replace(std::begin(range), std::end(range), old, with);
}
template <class Range, class Out>
constexpr void move(Range&& range, Out out) {
  std::move(std::begin(range), std::end(range), out);
}

template <class Iterator>
struct both_ends {
  Iterator min, max;
};
template <class Range, class Compare = ascending, class Projection = as_it_is>
constexpr auto minmax_element(Range&& range, Compare compare = {}, Projection of = {}) {
  const auto found =
      std::minmax_element(std::begin(range), std::end(range), projected(compare, of));
  return both_ends<std::decay_t<decltype(found.first)>>{found.first, found.second};
}

template <class Range, class Compare = ascending, class Projection = as_it_is>
constexpr auto minmax(Range&& range, Compare compare = {}, Projection of = {}) {
  const auto found = ranges::minmax_element(range, compare, of);
  return both_ends<std::decay_t<decltype(*found.min)>>{*found.min, *found.max};
}
template <class Range, class Compare = ascending, class Projection = as_it_is>
constexpr auto min(Range&& range, Compare compare = {}, Projection of = {}) {
  return *ranges::min_element(range, compare, of);
}

}  // namespace ranges
}  // namespace std

#endif
#endif
