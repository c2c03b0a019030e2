// Which studies are current, and that their committed pages say what their results say.
#include "validation/studies/study_list.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

const fs::path source_root = RECOIL_SOURCE_DIR;

class Tree : public testing::Test {
 protected:
  Tree() : root_(testing::TempDir() + "recoil-studies-" + std::to_string(getpid())) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~Tree() override { fs::remove_all(root_); }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  void write(const fs::path& file, const std::string& text) const {
    write_whole_file(root_ / file, text, Replacing::data);
  }
  std::string key() const { return study_key(root_, "coverage-grid fits/a.toml"); }
  std::string diagnosis_key() const { return study_key(root_, "hidden-effects"); }

  fs::path root_;
};

// Every folder whose code decides a number: a list of folders once forgot src/mechanism.
TEST_F(Tree, TheKeyChangesWithEveryFolderThatDecidesNumbers) {
  std::set<std::string> stages;
  for (const auto& entry : fs::directory_iterator(source_root / "src")) {
    if (entry.is_directory()) stages.insert(entry.path().filename().string());
  }
  ASSERT_TRUE(stages.contains("mechanism"));
  for (const std::string& stage : stages) write("src/" + stage + "/a.cpp", "1");
  for (const std::string& stage : stages) {
    const std::string before = diagnosis_key();
    write("src/" + stage + "/a.cpp", "2");
    EXPECT_EQ(diagnosis_key() == before, shows_results("src/" + stage + "/a.cpp")) << stage;
  }
  for (const char* file : {"src/core/a.cpp", "src/mechanism/a.cpp", "src/coverage/a.cpp",
                           "tests/validation/truth/a.cpp", "tests/validation/studies/a.cpp"}) {
    EXPECT_FALSE(shows_results(file)) << file;
  }
  EXPECT_TRUE(shows_results("tests/validation/studies/a_page.cpp"));
}

// From the sources of a study, along their includes and the sources of what they include: x.cpp
// beside x.hpp, and x_more.cpp if it has no header of its own.
TEST(Studies, ReachNothingThatIsApartFromThem) {
  const std::regex include("#include \"([^\"]+)\"");
  const std::map<std::string, std::vector<std::string>> first = {
      {"coverage-grid",
       {"coverage_study", "coverage_grid", "coverage_noise", "bent_truth", "independent_coverage"}},
      {"posterior-ranks", {"rank_study"}}};
  for (const auto& [command, names] : first) {
    std::set<fs::path> seen;
    std::vector<fs::path> next;
    for (const std::string& name : names)
      next.push_back("tests/validation/studies/" + name + ".cpp");
    while (!next.empty()) {
      const fs::path file = next.back();
      next.pop_back();
      if (!fs::exists(source_root / file) || shows_results(file) || !seen.insert(file).second)
        continue;
      EXPECT_FALSE(is_apart(file, command)) << command << " reaches " << file;
      const std::string text = read_text_file(source_root / file);
      for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at) {
        for (const char* root : {"src/", "tests/"}) {
          const fs::path header = root + (*at)[1].str();
          if (!fs::exists(source_root / header)) continue;
          next.push_back(header);
          for (const auto& entry : fs::directory_iterator(source_root / header.parent_path())) {
            const std::string beside = entry.path().stem();
            const std::string stem = header.stem();
            const bool headed = fs::exists(fs::path(entry).replace_extension(".hpp"));
            if (beside == stem || (beside.starts_with(stem + "_") && !headed)) {
              next.push_back(fs::relative(entry.path(), source_root));
            }
          }
        }
      }
    }
    EXPECT_TRUE(seen.contains("src/estimate/fit.cpp")) << command;
  }
  for (const char* command : {"hidden-effects", "pairing"}) {
    EXPECT_FALSE(is_apart("src/diagnosis/diagnose.cpp", command)) << command;
  }
}

TEST_F(Tree, TheKeyChangesWithCodeAndNotWithItsComments) {
  write("src/core/a.cpp", "/// Twice x.\nint f(int x) { return 2 * x; }  // twice\n");
  const std::string first = key();
  write("src/core/a.cpp", "/// x + x, as \"f\".\nint f(int x) {\n  return 2*x;\n}\n");
  EXPECT_EQ(key(), first);
  write("src/core/a.cpp", "int f(int x) { return 3 * x; }");
  EXPECT_NE(key(), first);
}

TEST(Studies, CodeIsWhatStandsOutsideOfComments) {
  EXPECT_EQ(code_of("int  x = 1'000; // y\nint z;"), "int x=1'000;int z;");
  EXPECT_EQ(code_of(R"(f("a // b", '"', "\"//");  // c)"), R"(f("a // b",'"',"\"//");)");
  EXPECT_EQ(code_of("g(R\"x(// \" )\" kept)x\") // gone"), "g(R\"x(// \" )\" kept)x\")");
  EXPECT_EQ(code_of("return // the\nx"), "return x");
  EXPECT_EQ(code_of("\"not closed // "), "\"not closed // ");
}

TEST_F(Tree, TheKeyChangesWithFitsDataAndTheCommandButNotWithResults) {
  write("src/core/a.cpp", "1");
  write("fits/a.toml", "1");
  write("datasets/a/points.csv", "1");
  const std::string first = key();
  EXPECT_EQ(key(), first);
  EXPECT_NE(study_key(root_, "coverage-grid fits/b.toml"), first);
  write("datasets/a/points.csv", "2");
  const std::string second = key();
  EXPECT_NE(second, first);
  write("fits/a.toml", "2");
  EXPECT_NE(key(), second);
  const std::string third = key();
  fs::rename(root_ / "src/core/a.cpp", root_ / "src/core/b.cpp");
  EXPECT_NE(key(), third);
}

TEST_F(Tree, AStudyIsCurrentOnlyWithTheKeyOfTheSourcesThatAreThere) {
  write("src/core/a.cpp", "1");
  const Study study = {"a", "pairing"};
  EXPECT_EQ(state_of(root_, study), StudyState::missing);
  write(study.result(), R"({"key": "0123456789abcdef"})");
  EXPECT_EQ(state_of(root_, study), StudyState::stale);
  write(study.result(), "no json");
  EXPECT_EQ(state_of(root_, study), StudyState::stale);
  write(study.result(), R"({"key": ")" + study_key(root_, study.command) + R"("})");
  EXPECT_EQ(state_of(root_, study), StudyState::current);
  write("src/core/a.cpp", "2");
  EXPECT_EQ(state_of(root_, study), StudyState::stale);
}

TEST(Studies, AreFoundByTheirNames) {
  std::set<std::string> results;
  for (const Study& study : all_studies()) {
    EXPECT_EQ(study_named(study.name).command, study.command);
    EXPECT_TRUE(results.insert(study.result()).second) << study.result();
  }
  EXPECT_THROW(study_named("coverage-grid-n12-stated"), InputError);
}

// Pages and pictures are made from the JSON and from nothing else.
TEST_F(Tree, CommittedPagesAreThoseOfTheCommittedResults) {
  int pages = 0;
  for (const auto& entry : fs::directory_iterator(source_root / "reports")) {
    const fs::path& file = entry.path();
    if (file.extension() != ".json") continue;
    const bool known = std::any_of(
        all_studies().begin(), all_studies().end(),
        [&](const Study& study) { return fs::path(study.result()).filename() == file.filename(); });
    if (!known) continue;
    fs::copy_file(file, root_ / file.filename());
    render_study(root_ / file.filename());
    ++pages;
  }
  ASSERT_GE(pages, 8);
  write_coverage_summary(root_);
  for (const auto& entry : fs::directory_iterator(root_)) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(read_text_file(entry.path()), read_text_file(source_root / "reports" / name))
        << name << ": let recoil_study render make it again";
  }
}

}  // namespace
}  // namespace recoil
