#pragma once

#include <exception>
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
  enum class Work {
    asks,          ///< with `stop_requested`, where it likes to end
    is_called_off  ///< ends where it next asks `called_off`, as under a `CallingOff`
  };
  explicit InterruptGuard(Work work = Work::asks);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  bool calls_off_;
};

/// Has the flag been raised? Cheap enough to ask before every replicate.
bool stop_requested();

/// The signal that raised the flag, 0 when none did.
int stop_signal();

/// Thrown out of work that was called off: nothing of it is kept.
class CalledOff : public std::exception {
 public:
  const char* what() const noexcept override { return "called off"; }
};

/// While one of these lives, all long work of this process ends where it next asks, within some
/// milliseconds. For a program that has Ctrl-C to itself, as Python has.
class CallingOff {
 public:
  CallingOff();
  ~CallingOff();
  CallingOff(const CallingOff&) = delete;
  CallingOff& operator=(const CallingOff&) = delete;
};

bool called_off();

/// @throws CalledOff when the work that asks is to end.
inline void end_if_called_off() {
  if (called_off()) throw CalledOff();
}

}  // namespace recoil
