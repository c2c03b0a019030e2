// Other programs: what they print, and that none is waited for without end.
#include "validation/studies/child.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>

#include "core/interrupt.hpp"

namespace recoil {
namespace {

using namespace std::chrono_literals;

TEST(Child, GivesItsOutputsAndStatus) {
  const ChildOutcome child = run_child({"sh", "-c", "cat; echo no >&2; exit 7"}, "text", 10s);
  EXPECT_EQ(child.out, "text");
  EXPECT_EQ(child.err, "no\n");
  EXPECT_EQ(child.status, 7);
  EXPECT_FALSE(child.timed_out);
}

TEST(Child, OneThatIsMissingIsTold) {
  EXPECT_EQ(run_child({"no-such-program"}, "", 1s).failed, ENOENT);
}

TEST(Child, OneThatHangsIsEnded) {
  const auto begin = std::chrono::steady_clock::now();
  const ChildOutcome child = run_child({"sleep", "1000"}, "", 50ms);
  EXPECT_TRUE(child.timed_out);
  EXPECT_EQ(child.status, -1);
  const CallingOff calling_off;
  EXPECT_THROW(run_child({"sleep", "1000"}, "", 1000s), CalledOff);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 100s);
}

}  // namespace
}  // namespace recoil
