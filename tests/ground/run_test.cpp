// What ./run says about a folder in which nothing can be built.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;

TEST(Run, NamesALetterThatCMakeDoesNotTake) {
  for (const char* name : {"a;b", "a\"b", "a#b", "a\\b"}) {
    const support::TemporaryFolder folder;
    fs::create_directory(folder / name);
    fs::copy_file(fs::path(RECOIL_SOURCE_DIR) / "run", folder / name / "run");
    for (const char* command : {"report", "test", "clean"}) {
      const support::Outcome run = support::run_command({"./run", command}, folder / name);
      EXPECT_EQ(run.status, 2) << name << run.out;
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
      EXPECT_EQ(run.out, "");
    }
    EXPECT_EQ(support::run_command({"./run", "help"}, folder / name).status, 0);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / name), {}), 1) << "nothing is made";
  }
  const support::TemporaryFolder usual;
  fs::create_directory(usual / "a 'b' $c & (d)");
  fs::copy_file(fs::path(RECOIL_SOURCE_DIR) / "run", usual / "a 'b' $c & (d)" / "run");
  EXPECT_EQ(support::run_command({"./run", "clean"}, usual / "a 'b' $c & (d)").status, 0);
}

}  // namespace
