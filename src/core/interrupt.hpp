#pragma once

#include <exception>
#include <stdexcept>

namespace recoil {

/// Long work that the user stopped and that has kept its finished pieces. The program prints the
/// message and then ends as the signal would have ended it.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown by work that was called off. Its result is lost.
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

/// Has a signal arrived since the last guard was made?
bool stop_requested();

/// That signal; 0 if none arrived.
int stop_signal();

/// During the lifetime of one of these all long work of this process is called off. For a program
/// that handles Ctrl-C itself, as Python does.
class CallingOff {
 public:
  CallingOff();
  ~CallingOff();
  CallingOff(const CallingOff&) = delete;
  CallingOff& operator=(const CallingOff&) = delete;
};

/// Should long work end now? Cheap; long work asks every few milliseconds.
bool called_off();

/// @throws CalledOff if long work should end now
inline void end_if_called_off() {
  if (called_off()) throw CalledOff();
}

}  // namespace recoil
