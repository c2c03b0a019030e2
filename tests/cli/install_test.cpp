// The installed program and library work without the source tree.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/json.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::run_command;

const std::string kBuild = fs::path(RECOIL_BINARY).parent_path().string();

/// Means something to a shell, and in a regular expression.
const std::string kMeaningful = "c++ (new)";

void expect_a_whole_installation(const fs::path& prefix) {
  for (const char* file : {"bin/recoil", "share/doc/recoil/LICENSE", "share/doc/recoil/README.md",
                           "share/doc/recoil/fit.md", "share/recoil/schemas/fit.schema.json"}) {
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

TEST(Install, TheInstalledProgramNeedsNoSourceTree) {
  const support::TemporaryFolder place;
  const std::string prefix = place / "there";
  const Outcome done =
      run_command({"cmake", "--install", kBuild, "--prefix", prefix}, place.path());
  ASSERT_EQ(done.status, 0) << done.err;
  expect_a_whole_installation(prefix);
}

TEST(Install, AnotherProjectFindsTheEstimatorAndTheLibrary) {
  const support::TemporaryFolder place;
  const std::string prefix = place / kMeaningful;
  ASSERT_EQ(run_command({"cmake", "--install", kBuild, "--prefix", prefix}, place.path()).status,
            0);
  place.write("CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.25)
project(mine LANGUAGES CXX)
find_package(recoil 0.2 REQUIRED)
add_executable(fits fits.cpp)
target_link_libraries(fits PRIVATE recoil::estimator)
add_executable(hits hits.cpp)
target_link_libraries(hits PRIVATE recoil::library)
add_executable(analyses analyses.cpp)
target_link_libraries(analyses PRIVATE recoil::library)
target_include_directories(analyses BEFORE PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
)");
  // a straight line through 1, 3, 5 at 0, 1, 2
  place.write("fits.cpp", R"(#include <cstdio>
#include "recoil/uncertainty/estimator.hpp"
int main() {
  recoil::LeastSquaresProblem problem;
  problem.residual_count = 3;
  problem.lower = {-10.0, -10.0};
  problem.upper = {10.0, 10.0};
  problem.log_scale = {false, false};
  problem.evaluate = [](auto theta, auto residuals, auto jacobian) {
    for (int i = 0; i < 3; ++i) {
      residuals[i] = theta[0] + theta[1] * i - (1.0 + 2.0 * i);
      if (!jacobian.empty()) { jacobian[2 * i] = 1.0; jacobian[2 * i + 1] = i; }
    }
    return true;
  };
  const auto found = recoil::minimise(problem, std::vector<double>{0.0, 0.0});
  std::printf("%.6f %.6f\n", found.theta[0], found.theta[1]);
}
)");
  place.write("hits.cpp", R"(#include <cstdio>
#include "recoil/impact/impact.hpp"
int main() {
  const auto impact = recoil::simulate_impact({0.1, 0.0, 0.0, 0.0});
  std::printf("%.6f\n", impact.restitution_squared);
}
)");
  place.write("data/dataset.hpp", "struct Mine {};\n");  // hides none of ours
  place.write("analyses.cpp", R"(#include <cstdio>
#include "data/dataset.hpp"
#include "recoil/analysis/analysis.hpp"
#include "recoil/diagnosis/diagnose.hpp"
#include "recoil/report/result_json.hpp"
int main(int, char** arguments) {
  recoil::AnalysisOptions options;
  options.replicates = 0;
  options.threads = 1;
  const recoil::Analysis analysis =
      recoil::analyse(recoil::load_inputs(arguments[1]), options);
  recoil::DiagnosisOptions within;
  within.threads = 1;
  const recoil::Diagnosis diagnosis =
      recoil::diagnose(analysis.spec, analysis.datasets, analysis.fitted, within,
                       analysis.uncertainty.intervals);
  std::printf("[%s,%s]", recoil::fit_json(analysis).c_str(),
              recoil::diagnosis_json(diagnosis).c_str());
}
)");
  const Outcome built = run_command(
      {"sh", "-c", "cmake -G Ninja -B build -DCMAKE_PREFIX_PATH=\"$0\" && cmake --build build",
       prefix},
      place.path());
  ASSERT_EQ(built.status, 0) << built.out << built.err;
  EXPECT_EQ(run_command({place / "build/fits"}, place.path()).out, "1.000000 2.000000\n");
  // C_H V = 0.1: e = 0.9374755799, from 0.1 (1 + e) = ln[1.1 / (1 - 0.1 e)]
  EXPECT_EQ(run_command({place / "build/hits"}, place.path()).out, "0.878860\n");
  ASSERT_EQ(run_command({prefix + "/bin/recoil", "init", "mine", "--diameter", "5", "--particle",
                         "material=glass,density=2500,youngs_modulus=70e9,poisson_ratio=0.22",
                         "--surface", "material=steel,youngs_modulus=200e9,poisson_ratio=0.3"},
                        place.path())
                .status,
            0);
  const Outcome analysed = run_command({place / "build/analyses", "mine/fit.toml"}, place.path());
  ASSERT_EQ(analysed.status, 0) << analysed.err;
  EXPECT_EQ(analysed.err, "") << "a library is silent";
  const recoil::Json both = recoil::Json::parse(analysed.out);
  EXPECT_TRUE(both[0]["parameters"]["C_H"]["value"].is_number());
  EXPECT_TRUE(both[1]["verdict"].is_string());
}

// The source folder may have special characters in its name: configures the build there, builds one
// target, and runs the scripts that get files of this folder.
TEST(Install, TheFolderOfTheSourcesMayHaveAnyName) {
  const support::TemporaryFolder place;
  const fs::path tree = place / kMeaningful;
  fs::create_directory(tree);
  for (const auto& entry : fs::directory_iterator(RECOIL_SOURCE_DIR)) {
    const fs::path name = entry.path().filename();
    if (name == "build" || name == ".git") continue;
    fs::copy(entry.path(), tree / name, fs::copy_options::recursive);
  }
  const Outcome configured =
      run_command({"cmake", "--preset", "release", "-DRECOIL_PYTHON=ON"}, tree);
  ASSERT_EQ(configured.status, 0) << configured.err;
  const fs::path build = tree / "build/release";
  EXPECT_EQ(run_command({"ninja", "-n"}, build).status, 0);
  const Outcome built = run_command({"ninja", "failing_calls"}, build);
  EXPECT_EQ(built.status, 0) << built.out;
  EXPECT_NE(run_command({tree / "run", "help"}, place.path()).out.find("./run test"),
            std::string::npos);
  // an inline function that two kernels share is found
  for (const char* folder : {"one", "two"}) {
    support::write_text(tree / folder / "kernel.cpp",
                        "inline int shared() { static int n; return ++n; }\n"
                        "int " +
                            std::string(folder) + "() { return shared(); }\n");
    ASSERT_EQ(run_command({"g++", "-c", "kernel.cpp"}, tree / folder).status, 0);
  }
  const Outcome shared = run_command(
      {tree / "tests/impact/kernel_symbols.sh", tree / "one/kernel.o", tree / "two/kernel.o"},
      place.path());
  EXPECT_EQ(shared.status, 1) << shared.out;
  EXPECT_NE(shared.out.find("shared()"), std::string::npos) << shared.out;
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
  EXPECT_NE(unpacked.out.find("libgsl"), std::string::npos) << unpacked.out;
  EXPECT_NE(unpacked.out.find("Maintainer: "), std::string::npos) << unpacked.out;
  EXPECT_EQ(unpacked.out.find("@localhost"), std::string::npos) << "nobody reads mail there";
  EXPECT_FALSE(fs::exists(place / "there/usr/include"));  // that is in librecoil-dev
  EXPECT_EQ(
      run_command({"sh", "-c", "dpkg-deb -x package/librecoil-dev_*.deb dev"}, place.path()).status,
      0);
  EXPECT_TRUE(fs::exists(place / "dev/usr/include/recoil/analysis/analysis.hpp"));
  EXPECT_FALSE(fs::exists(place / "dev/usr/bin"));
  const Outcome flags = run_command(
      {"sh", "-c",
       "PKG_CONFIG_PATH=$(dirname $(find dev -name recoil.pc)) pkg-config --libs recoil"},
      place.path());
  EXPECT_NE(flags.out.find("-lrecoil_library"), std::string::npos) << flags.err;
  const Outcome completed = run_command(
      {"bash", "-c",
       ". there/usr/share/bash-completion/completions/recoil; COMP_WORDS=(recoil export --to la); "
       "COMP_CWORD=3; _recoil; echo ${COMPREPLY[*]}"},
      place.path());
  EXPECT_EQ(completed.out, "lammps\n") << completed.err;
  EXPECT_TRUE(fs::exists(place / "there/usr/share/man/man1/recoil.1"));
  expect_a_whole_installation(place / "there/usr");
}

}  // namespace
