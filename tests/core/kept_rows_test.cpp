#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <thread>

#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/resumable.hpp"
#include "support/mistake.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

using namespace std::chrono_literals;

class KeptRowsTest : public ::testing::Test {
 protected:
  KeptRows kept(const std::string& key = "k") const { return KeptRows(folder_ / "kept", key); }

  support::TemporaryFolder folder_;
};

TEST_F(KeptRowsTest, TheNextOneTakesOverEveryDigit) {
  const std::vector<double> numbers = {0.1, 1.0 / 3.0, 5e-324, -1.7976931348623157e308};
  {
    KeptRows first(folder_ / "kept", "k");
    first.put(7, numbers);
    first.put(std::size_t{1} << 40, "words");
    first.keep();
  }
  const KeptRows second(folder_ / "kept", "k");
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ(second.find(7)->get<std::vector<double>>(), numbers);
  EXPECT_EQ(*second.find(std::size_t{1} << 40), "words");
  EXPECT_FALSE(second.find(8));
}

TEST_F(KeptRowsTest, AnotherKeyAndADamagedFileGiveNothing) {
  KeptRows first(folder_ / "kept", "k");
  for (std::size_t i = 0; i < 9; ++i) first.put(i, i);
  first.keep();
  EXPECT_EQ(KeptRows(folder_ / "kept", "other").size(), 0U);
  const std::string whole = folder_.read("kept");
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
    folder_.write("kept", whole.substr(0, length));
    ASSERT_EQ(KeptRows(folder_ / "kept", "k").size(), 0U) << "cut at " << length;
  }
}

TEST_F(KeptRowsTest, RowsOfAnotherFormGiveNothing) {
  // One row is promised, and the bytes and their sum are right.
  const auto size_of = [this](const std::string& rows) {
    const std::string head = fmt::format(R"({{"key":"k","rows":1,"bytes":{})", rows.size());
    folder_.write("kept", fmt::format("{},\"sha256\":\"{}\"}}\n{}", head,
                                      sha256_hex(head + "}\n" + rows), rows));
    return kept().size();
  };
  EXPECT_EQ(size_of("[0,[1]]\n"), 1U);
  for (const char* rows : {"", "[-1,2]\n", "7\n", "[7]\n", "[99999999999999999999999,1]\n",
                           "[\"a\",1]\n", "[0,1]\n[1,2]\n", "[0,1]\n[1,2", "[0,1]\n\n"}) {
    EXPECT_EQ(size_of(rows), 0U) << rows;
  }
  size_of("[0,nonsense]\n");
  EXPECT_FALSE(kept().find(0));
}

TEST_F(KeptRowsTest, AResultIsReadOrMade) {
  KeptRows rows;
  int made = 0;
  const auto get = [&](KeptRows* kept, std::size_t piece) {
    return kept_or_made(
        kept, piece,
        [&] {
          return std::vector<double>{1.0 * ++made, -INFINITY};
        },
        row_json, row_numbers);
  };
  EXPECT_EQ(get(&rows, 4), (std::vector<double>{1, -INFINITY}));
  EXPECT_EQ(get(&rows, 4), (std::vector<double>{1, -INFINITY}));
  EXPECT_EQ(get(nullptr, 4), (std::vector<double>{2, -INFINITY}));
  rows.put(4, "no numbers");
  EXPECT_EQ(get(&rows, 4), (std::vector<double>{3, -INFINITY}));
}

TEST_F(KeptRowsTest, IsWrittenWhenItIsTimeAndNotBefore) {
  KeptRows slow(folder_ / "slow", "k");
  slow.put(1, 1);
  EXPECT_FALSE(folder_.has("slow"));
  KeptRows quick(folder_ / "quick", "k", KeepingPace(0ms));
  quick.put(1, 1);
  EXPECT_TRUE(folder_.has("quick"));
}

TEST_F(KeptRowsTest, WithoutAFileRowsStayInMemory) {
  KeptRows kept("", "k", KeepingPace(0ms));
  kept.put(3, 4);
  kept.keep();
  EXPECT_EQ(*kept.find(3), 4);
}

TEST_F(KeptRowsTest, WhatWasCalledOffIsNotTaken) {
  KeptRows rows(folder_ / "kept", "k");
  {
    const CallingOff off;
    EXPECT_THROW(rows.put(1, 1), CalledOff);
  }
  const InterruptGuard guard;
  rows.put(2, 2);
  std::raise(SIGTERM);
  EXPECT_THROW(rows.put(3, 3), CalledOff);
  EXPECT_EQ(rows.size(), 1U);
}

// Whatever else the machine does: by how long the writing really took.
TEST(KeepingPace, TakesNoMoreThanATenthOfTheTime) {
  using Clock = KeepingPace::Clock;
  KeepingPace pace(1ms);
  Clock::time_point begun, written;
  const Clock::time_point before = Clock::now();
  pace.keep([&] {
    begun = Clock::now();
    usleep(30000);
    written = Clock::now();
  });
  const Clock::time_point after = Clock::now();
  const bool due = pace.is_due();
  if (Clock::now() < written + 10 * (written - begun)) {
    EXPECT_FALSE(due) << "30 ms of writing ask for 300 ms of work";
  }
  std::this_thread::sleep_until(after + 10 * (after - before));
  EXPECT_TRUE(pace.is_due());
}

TEST(KeptRowsOnASmallDisk, WorkGoesOnWhereNothingCanBeWritten) {
  support::SmallDisk disk;
  ASSERT_TRUE(disk.is_mounted());
  const auto file = disk / "place/disk/kept";
  KeptRows rows(file, "k", KeepingPace(0ms));
  rows.put(1, std::string(3000, 'x'));
  disk.fill();
  testing::internal::CaptureStderr();
  for (std::size_t i = 2; i < 9; ++i) {
    usleep(50000);  // writing takes no more than a tenth of the time
    rows.put(i, std::string(3000, 'x'));
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("No space left on device"), std::string::npos) << told;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  EXPECT_EQ(KeptRows(file, "k").size(), 1U) << "the file that was there is whole";
  EXPECT_THROW(rows.keep(), InputError);
  disk.empty();
  rows.keep();
  EXPECT_EQ(KeptRows(file, "k").size(), 8U);
}

/// What another process is told of a claim on `result`.
std::string told_elsewhere(const std::filesystem::path& result,
                           const support::TemporaryFolder& folder) {
  const pid_t child = fork();
  if (child == 0) {
    folder.write("told", support::message_of([&] { const Claim claim(result); }));
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  return folder.read("told");
}

TEST(Claim, IsOneProcessAtATimeAndLeavesNothing) {
  const support::TemporaryFolder folder;
  const auto result = folder / "new/deep/fit.json";
  {
    const Claim claim(result);
    const std::string told = told_elsewhere(result, folder);
    EXPECT_NE(told.find("another recoil process is writing this result (process " +
                        std::to_string(getpid())),
              std::string::npos)
        << told;
    EXPECT_EQ(told_elsewhere(folder / "new/deep/other.json", folder), "no error");
  }
  EXPECT_FALSE(folder.has("new")) << "folders that were made for nothing";
  EXPECT_EQ(told_elsewhere(result, folder), "no error");
}

TEST(RowOfNumbers, GivesBackEveryDigit) {
  const std::vector<double> numbers = {1.0 / 3.0, -0.0,     5e-324, 1.7976931348623157e308,
                                       INFINITY,  -INFINITY};
  EXPECT_EQ(row_numbers(Json::parse(json_line(row_json(numbers)))), numbers);
  EXPECT_TRUE(std::isnan(row_numbers(row_json({NAN})).at(0)));
  EXPECT_THROW(row_numbers(Json("word")), JsonMismatch);
  EXPECT_THROW(row_numbers(Json::parse("[1,\"word\"]")), JsonMismatch);
}

// Locks of two open files exclude each other in one process, too.
TEST(Claim, WhatIsNoLockAndWhatCannotBeMadeIsRefused) {
  const support::TemporaryFolder folder;
  const auto told = [&](const char* name) {
    return support::message_of([&] { const Claim claim(folder / name); });
  };
  folder.write("precious", "text");
  folder.write("text.lock", "text");
  std::filesystem::create_symlink("precious", folder / "link.lock");
  std::filesystem::create_directory(folder / "folder.lock");
  for (const char* name : {"text", "link"}) {
    EXPECT_NE(told(name).find("this is not a lock file of recoil"), std::string::npos)
        << told(name);
  }
  EXPECT_NE(told("folder").find("the file cannot be written"), std::string::npos);
  EXPECT_NE(told("precious/below").find("the file cannot be written"), std::string::npos);
  EXPECT_EQ(folder.read("precious"), "text");
  EXPECT_EQ(folder.read("text.lock"), "text");
  {
    const Claim claim(folder / "deep/mine");
    EXPECT_NE(told("deep/mine").find("(process " + std::to_string(getpid())), std::string::npos);
  }
  EXPECT_FALSE(folder.has("deep"));
}

TEST(Claim, OneThatWasKilledIsTakenOver) {
  const support::TemporaryFolder folder;
  const auto result = folder / "fit.json";
  const pid_t child = fork();
  if (child == 0) {
    const Claim claim(result);
    std::raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  ASSERT_TRUE(folder.has("fit.json.lock"));
  { const Claim claim(result); }
  EXPECT_FALSE(folder.has("fit.json.lock"));
}

}  // namespace
}  // namespace recoil
