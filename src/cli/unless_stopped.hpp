#pragma once

#include <fmt/format.h>

#include <exception>

#include "core/interrupt.hpp"
#include "core/kept_rows.hpp"

namespace recoil {

/// What `work` gives, which puts into `kept` what is finished of it. Ctrl-C and SIGTERM call it off
/// within milliseconds, if what is finished has a file; else they end the process as ever.
/// @throws Interrupted when that happened; what was finished is in the file then
template <class Work>
auto unless_stopped(KeptRows& kept, const Work& work) {
  if (kept.file().empty()) return work();
  const InterruptGuard guard(InterruptGuard::Work::is_called_off);
  const auto end_if_stopped = [&kept] {
    if (!stop_requested()) return;
    kept.keep();
    throw Interrupted(
        fmt::format("stopped: {} pieces are kept in {}; the same command goes on from there",
                    kept.size(), kept.file().string()));
  };
  try {
    auto result = work();
    end_if_stopped();  // it may have ended early, with anything
    return result;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception&) {
    end_if_stopped();
    throw;
  }
}

}  // namespace recoil
