#pragma once

#include <exception>
#include <stdexcept>

namespace recoil {

/// The user has stopped long work, and its finished pieces are saved. The program prints the
/// message and then ends as if by the signal.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Long work was called off. Its result is lost.
class CalledOff : public std::exception {
 public:
  const char* what() const noexcept override { return "called off"; }
};

/// During the lifetime of a guard the first Ctrl-C (SIGINT), SIGTERM, SIGHUP, SIGXCPU or SIGUSR1
/// (which clusters send before a time limit) calls off all long work of this process; the next
/// signal of that kind acts as usual. The destructor restores the earlier handlers.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Has a signal arrived since the last guard was constructed?
bool stop_requested();

/// The number of that signal; 0 if none arrived.
int stop_signal();

/// Calls off all long work of this process during its lifetime. For programs that handle Ctrl-C
/// themselves, as Python does.
class CallingOff {
 public:
  CallingOff();
  ~CallingOff();
  CallingOff(const CallingOff&) = delete;
  CallingOff& operator=(const CallingOff&) = delete;
};

/// Should long work end now? It is cheap: long work polls it every few milliseconds.
bool called_off();

/// @throws CalledOff if long work should end now
inline void end_if_called_off() {
  if (called_off()) throw CalledOff();
}

}  // namespace recoil
