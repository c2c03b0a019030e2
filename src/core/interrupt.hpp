#pragma once

#include <stdexcept>

namespace recoil {

/// Long work that was stopped by the user and has kept what was finished. The command line says so
/// and ends as the signal would have ended it.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// While one of these lives, the first Ctrl-C (SIGINT), SIGTERM or SIGUSR1 (which clusters send
/// before a time limit) only raises a flag, so that work in progress can put what is finished on
/// disk. The second one of a kind ends the process as ever. What was set before comes back at its
/// end.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Has the flag been raised? Cheap enough to ask before every replicate.
bool stop_requested();

/// The signal that raised the flag, 0 when none did.
int stop_signal();

}  // namespace recoil
