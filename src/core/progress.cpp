#include "core/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace recoil {
namespace {
std::atomic<bool> shown_here{false};
thread_local bool silent_here = false;
constexpr auto redraw_interval = std::chrono::milliseconds(100);

/// True if standard error is a terminal that can redraw a line.
bool can_redraw() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}
}  // namespace

void Progress::show_in_this_process() { shown_here = true; }

Progress::Silence::Silence(bool silent) : before_(silent_here) { silent_here |= silent; }

Progress::Silence::~Silence() { silent_here = before_; }

Progress::Progress(std::string label, std::size_t total, Pace pace)
    : label_(std::move(label)),
      total_(total),
      silent_(silent_here || !shown_here),
      terminal_(!silent_ && can_redraw()),
      pace_(pace),
      start_(std::chrono::steady_clock::now()),
      due_(terminal_ ? start_ : start_ + pace_.first) {}

Progress::~Progress() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::advance(std::size_t steps) {
  if (silent_) return;
  const std::size_t done = done_ += steps;
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (!lock) return;  // another thread is drawing; the next step will catch up
  const auto now = std::chrono::steady_clock::now();
  if (now < due_) return;
  due_ = now + (terminal_ ? redraw_interval : pace_.next);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double steps_left = static_cast<double>(total_) - static_cast<double>(done);
  draw(done,
       elapsed * std::max(0.0, steps_left) / static_cast<double>(std::max<std::size_t>(done, 1)));
}

void Progress::draw(std::size_t done, double left) const {
  constexpr std::size_t width = 30;
  const std::size_t filled = total_ == 0 ? width : width * std::min(done, total_) / total_;
  const std::string state = fmt::format("{}/{}, {:.0f} s left", done, total_, left);
  const std::string line = terminal_ ? fmt::format("\r\033[K{} [{:#<{}}{:.<{}}] {}", label_, "",
                                                   filled, "", width - filled, state)
                                     : fmt::format("{}: {}\n", label_, state);
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
}

}  // namespace recoil
