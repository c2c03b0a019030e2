#include "core/progress.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

namespace recoil {
namespace {

using std::chrono::milliseconds;

/// What 5 steps print into a pipe.
std::string printed(milliseconds between_steps, Progress::Pace pace) {
  Progress::show_in_this_process();
  testing::internal::CaptureStderr();
  {
    Progress progress("refits", 5, pace);
    for (int step = 0; step < 5; ++step) {
      std::this_thread::sleep_for(between_steps);
      progress.advance();
    }
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, IsSilentInAPipeWhileTheWorkIsShort) {
  EXPECT_EQ(printed(milliseconds(1), Progress::Pace()), "");
}

TEST(Progress, PrintsALineInAPipeWhenTheWorkTakesLonger) {
  const std::string text = printed(milliseconds(20), {milliseconds(50), std::chrono::hours(1)});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_EQ(text.find("refits: "), 0U) << text;
  EXPECT_NE(text.find("/5, 0 s left"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos) << "no bar in a pipe";
}

TEST(Progress, IsSilentWhereASilenceLives) {
  constexpr Progress::Pace every_step = {milliseconds(0), milliseconds(0)};
  {
    const Progress::Silence silence;
    const Progress::Silence inner(false);
    EXPECT_EQ(printed(milliseconds(1), every_step), "");
    std::string elsewhere;
    std::thread([&] { elsewhere = printed(milliseconds(1), every_step); }).join();
    EXPECT_NE(elsewhere, "");
  }
  EXPECT_NE(printed(milliseconds(1), every_step), "");
}

/// What 5 steps print on a terminal of this kind.
std::string shown(const char* kind) {
  Progress::show_in_this_process();
  int ends[2];
  if (openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) != 0) return "no terminal";
  const int before = dup(STDERR_FILENO);
  dup2(ends[1], STDERR_FILENO);
  setenv("TERM", kind, 1);
  {
    Progress progress("refits", 5, {milliseconds(0), milliseconds(0)});
    for (int step = 0; step < 5; ++step) progress.advance();
  }
  dup2(before, STDERR_FILENO);
  char text[4096];
  const ssize_t size = read(ends[0], text, sizeof text);
  for (const int end : {ends[0], ends[1], before}) close(end);
  return {text, static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

TEST(Progress, RedrawsALineOnlyOnATerminalThatCan) {
  EXPECT_NE(shown("xterm").find("\033[K"), std::string::npos);
  EXPECT_EQ(shown("dumb").find("\033"), std::string::npos);
  EXPECT_NE(shown("dumb").find("refits: 1/5"), std::string::npos);
}

TEST(Progress, GoesOnPrintingAtItsPace) {
  const std::string text = printed(milliseconds(20), {milliseconds(0), milliseconds(0)});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5) << text;
}

}  // namespace
}  // namespace recoil
