#pragma once

#include <future>

namespace recoil {

/// Does `main` on this thread and `others` each on one more, where no number of `threads` is asked
/// for (0); one after the other where one is. Threads and no tasks of TBB: a worker that has ended
/// a task beside `main` would not come to the help of an arena within it.
/// @throws what `main` throws, or else the first of `others` that does, after all have ended
template <class Work, class... Others>
void at_once(int threads, const Work& main, const Others&... others) {
  const std::launch how = threads == 0 ? std::launch::async : std::launch::deferred;
  std::future<void> started[] = {std::async(how, others)...};
  main();
  for (std::future<void>& one : started) one.wait();
  for (std::future<void>& one : started) one.get();
}

}  // namespace recoil
