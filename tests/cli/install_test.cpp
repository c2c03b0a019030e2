// What is installed works where there is no source tree.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::run_command;

const std::string kBuild = fs::path(RECOIL_BINARY).parent_path().string();

void expect_a_whole_installation(const fs::path& prefix) {
  for (const char* file :
       {"bin/recoil", "share/man/man1/recoil.1", "share/man/man1/recoil-fit.1",
        "share/bash-completion/completions/recoil", "share/zsh/site-functions/_recoil",
        "share/fish/vendor_completions.d/recoil.fish", "share/doc/recoil/LICENSE"}) {
    EXPECT_TRUE(fs::is_regular_file(prefix / file)) << file;
    EXPECT_GT(fs::file_size(prefix / file), 200U) << file;
  }
  const support::TemporaryFolder elsewhere;
  const std::string program = prefix / "bin/recoil";
  const Outcome help = run_command({program, "help", "export"}, elsewhere.path());
  EXPECT_EQ(help.status, 0) << help.err;
  EXPECT_GT(help.out.size(), 1000U);
  const Outcome made =
      run_command({program, "init", "mine", "--diameter", "5", "--particle",
                   "material=glass,density=2500,youngs_modulus=70e9,poisson_ratio=0.22",
                   "--surface", "material=steel,youngs_modulus=200e9,poisson_ratio=0.3"},
                  elsewhere.path());
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(
      run_command({program, "fit", "mine/fit.toml", "--replicates", "0"}, elsewhere.path()).status,
      0);
}

TEST(Install, TheProgramComesWithItsPagesAndCompletions) {
  const support::TemporaryFolder place;
  const std::string prefix = place / "there";
  const Outcome done =
      run_command({"cmake", "--install", kBuild, "--prefix", prefix}, place.path());
  ASSERT_EQ(done.status, 0) << done.err;
  expect_a_whole_installation(prefix);
}

TEST(Install, ADebianPackageHoldsTheSame) {
  const support::TemporaryFolder place;
  const Outcome made = run_command(
      {"cpack", "-G", "DEB", "--config", kBuild + "/CPackConfig.cmake", "-B", place / "package"},
      place.path());
  ASSERT_EQ(made.status, 0) << made.out << made.err;
  const Outcome unpacked = run_command(
      {"sh", "-c", "dpkg-deb -x package/recoil_*.deb there && dpkg-deb -I package/recoil_*.deb"},
      place.path());
  ASSERT_EQ(unpacked.status, 0) << unpacked.err;
  EXPECT_NE(unpacked.out.find("gnuplot"), std::string::npos) << unpacked.out;
  EXPECT_NE(unpacked.out.find("libgsl"), std::string::npos) << unpacked.out;
  expect_a_whole_installation(place / "there/usr");
}

}  // namespace
