#include "core/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

namespace recoil {
namespace {

using std::chrono::milliseconds;

/// What 5 steps print into a pipe.
std::string printed(milliseconds between_steps, Progress::Pace pace) {
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

TEST(Progress, GoesOnPrintingAtItsPace) {
  const std::string text = printed(milliseconds(20), {milliseconds(0), milliseconds(0)});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5) << text;
}

}  // namespace
}  // namespace recoil
