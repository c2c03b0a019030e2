#include "core/interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>

namespace recoil {
namespace {

std::atomic<int> raised{0};
std::atomic<int> calling_off{0};
std::atomic<int> guards{0};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler writes it");

// Clusters and time limits send SIGUSR1 or SIGXCPU before SIGKILL.
constexpr std::array<int, 5> watched = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGXCPU};
std::array<struct sigaction, watched.size()> previous;

void remember(int signal) { raised = signal; }

/// A signal that is ignored (`nohup`, a job in the background) stays ignored.
void watch(int signal, struct sigaction& before) {
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // the second one acts as usual
  sigaction(signal, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  raised = 0;
  ++guards;
  for (std::size_t i = 0; i < watched.size(); ++i) watch(watched[i], previous[i]);
}

InterruptGuard::~InterruptGuard() {
  --guards;
  for (std::size_t i = 0; i < watched.size(); ++i) sigaction(watched[i], &previous[i], nullptr);
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
