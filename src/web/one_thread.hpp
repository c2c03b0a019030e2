#pragma once

// What recoil uses of TBB, on the one thread that a page has.

#include <cstddef>
#include <functional>
#include <optional>

namespace tbb {

template <class T>
class blocked_range {
 public:
  blocked_range(T begin, T end, T = 1) : begin_(begin), end_(end) {}
  T begin() const { return begin_; }
  T end() const { return end_; }

 private:
  T begin_, end_;
};

template <class Range, class Body>
void parallel_for(const Range& range, const Body& body) {
  body(range);
}

struct global_control {
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t) {}
};

struct task_arena {
  static constexpr int automatic = -1;
  explicit task_arena(int = automatic) {}
  template <class Work>
  auto execute(const Work& work) {
    return work();
  }
};

namespace this_task_arena {
inline int max_concurrency() { return 1; }
template <class Work>
auto isolate(const Work& work) {
  return work();
}
}  // namespace this_task_arena

template <class T>
class enumerable_thread_specific {
 public:
  enumerable_thread_specific() : make_([] { return T(); }) {}
  template <class Make>
  explicit enumerable_thread_specific(Make make) : make_(make) {}
  T& local() {
    if (!only_) only_.emplace(make_());
    return *only_;
  }

 private:
  std::function<T()> make_;
  std::optional<T> only_;
};

}  // namespace tbb
