#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>

#include "core/interrupt.hpp"

namespace recoil {

/// What `work` gives, while other threads of Python run. Ctrl-C ends it, and any other work under
/// way in the process, as KeyboardInterrupt. To be called with the interpreter held.
template <class Work>
auto interruptible(const Work& work) {
  constexpr auto between_looks = std::chrono::milliseconds(50);
  auto running = std::async(std::launch::async, [&work] { return work(); });
  for (;;) {
    {
      const pybind11::gil_scoped_release release;
      if (running.wait_for(between_looks) == std::future_status::ready) break;
    }
    // Only the main thread of Python is told of signals.
    if (PyErr_CheckSignals() == 0) continue;
    const pybind11::error_already_set interrupt;
    {
      const pybind11::gil_scoped_release release;
      const CallingOff calling_off;
      running.wait();
    }
    throw interrupt;
  }
  return running.get();
}

}  // namespace recoil
