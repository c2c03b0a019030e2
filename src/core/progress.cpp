#include "core/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace recoil {
namespace {
constexpr auto redraw_interval = std::chrono::milliseconds(100);
}

Progress::Progress(std::string label, std::size_t total)
    : label_(std::move(label)),
      total_(total),
      visible_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (visible_) std::fputs("\r\033[K", stderr);
}

void Progress::advance(std::size_t steps) {
  const std::size_t done = done_ += steps;
  if (!visible_) return;
  const std::unique_lock lock(drawing_, std::try_to_lock);
  if (!lock) return;  // another thread is drawing; the next step will catch up
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < redraw_interval) return;
  drawn_ = now;
  draw(done);
}

void Progress::draw(std::size_t done) {
  constexpr std::size_t width = 30;
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double left =
      elapsed *
      (static_cast<double>(total_) / static_cast<double>(std::max<std::size_t>(done, 1)) - 1.0);
  const std::size_t filled = total_ == 0 ? width : width * std::min(done, total_) / total_;
  const std::string bar = fmt::format("\r\033[K{} [{:#<{}}{:.<{}}] {}/{}, {:.0f} s left", label_,
                                      "", filled, "", width - filled, done, total_, left);
  std::fwrite(bar.data(), 1, bar.size(), stderr);
  std::fflush(stderr);
}

}  // namespace recoil
