#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <future>
#include <optional>

#include "core/interrupt.hpp"

namespace recoil {

/// Allows `threads` threads even if the machine has fewer cores; TBB alone would warn on stderr and
/// run fewer.
class AllowedThreads {
 public:
  explicit AllowedThreads(int threads) {
    if (threads > tbb::this_task_arena::max_concurrency()) {
      allowance_.emplace(tbb::global_control::max_allowed_parallelism,
                         static_cast<std::size_t>(threads));
    }
  }

 private:
  std::optional<tbb::global_control> allowance_;
};

/// Calls body(i) for i in [0, count) on `threads` threads (0: all cores). If each call writes only
/// its own element, no result depends on the number of threads.
/// @throws CalledOff between two calls
template <class Body>
void parallel_over(std::size_t count, int threads, const Body& body) {
  const AllowedThreads allowed(threads);
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t i = range.begin(); i != range.end(); ++i) {
                          end_if_called_off();
                          body(i);
                        }
                      });
  });
}

/// Calls body(first, count) for blocks of at most `size` of `count` items, in parallel on the
/// threads of the calling arena. It may be called within `parallel_over`: a thread that waits for
/// its blocks starts no other task.
/// @throws CalledOff between two blocks
template <class Body>
void over_blocks(std::size_t count, std::size_t size, const Body& body) {
  if (count <= size) return body(std::size_t{0}, count);
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (count + size - 1) / size, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t b = range.begin(); b != range.end(); ++b) {
                          end_if_called_off();
                          body(b * size, std::min(size, count - b * size));
                        }
                      });
  });
}

/// The result of `work`, run on at most `threads` threads (0: those of the caller).
template <class Work>
auto on_threads(int threads, const Work& work) {
  if (threads <= 0) return work();
  const AllowedThreads allowed(threads);
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

/// Runs `main` on this thread and each of `others` on a thread of its own if `threads` is 0 and
/// there is more than one core; otherwise one after the other. These are threads and not TBB tasks,
/// because a TBB worker that finished a task beside `main` would not join an arena inside of it.
/// @throws the exception of `main`, or else the first of `others`, after all have ended
template <class Work, class... Others>
void at_once(int threads, const Work& main, const Others&... others) {
  const bool several = threads == 0 && tbb::this_task_arena::max_concurrency() > 1;
  const std::launch how = several ? std::launch::async : std::launch::deferred;
  std::future<void> started[] = {std::async(how, others)...};
  main();
  for (std::future<void>& one : started) one.wait();
  for (std::future<void>& one : started) one.get();
}

}  // namespace recoil
