#include "core/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace recoil {
namespace {

std::atomic<int> raised{0};
std::atomic<int> calling_off{0};
std::atomic<int> guards{0};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler writes it");

struct sigaction previous_interrupt;
struct sigaction previous_terminate;
struct sigaction previous_user;

void remember(int signal) { raised = signal; }

/// A signal that is ignored (`nohup`, a job in the background) stays ignored.
void watch(int signal, struct sigaction& previous) {
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // the second one acts as usual
  sigaction(signal, nullptr, &previous);
  if (previous.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  raised = 0;
  ++guards;
  watch(SIGINT, previous_interrupt);
  watch(SIGTERM, previous_terminate);
  watch(SIGUSR1, previous_user);
}

InterruptGuard::~InterruptGuard() {
  --guards;
  sigaction(SIGINT, &previous_interrupt, nullptr);
  sigaction(SIGTERM, &previous_terminate, nullptr);
  sigaction(SIGUSR1, &previous_user, nullptr);
}

bool stop_requested() { return raised.load(std::memory_order_relaxed) != 0; }

int stop_signal() { return raised; }

CallingOff::CallingOff() { ++calling_off; }
CallingOff::~CallingOff() { --calling_off; }

bool called_off() {
  if (calling_off.load(std::memory_order_relaxed) != 0) return true;
  return guards.load(std::memory_order_relaxed) != 0 && stop_requested();
}

}  // namespace recoil
