#include "program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace program {
namespace {

namespace fs = std::filesystem;

const char* const kPoints =
    "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n"
    "small,2,1.6,0,0.015,20,20\n"
    "small,2,2.4,0.651,0.015,20,0\n"
    "small,2,5,0.842,0.015,20,0\n"
    "small,2,25,0.900,0.015,20,0\n"
    "large,4,0.8,0.505,0.015,20,0\n"
    "large,4,1.4,0.825,0.015,20,0\n"
    "large,4,5,0.937,0.015,20,0\n"
    "large,4,25,0.933,0.015,20,0\n";

const char* const kPackage = R"({
  "name": "example",
  "title": "An example",
  "resources": [
    {
      "name": "points",
      "path": "points.csv",
      "schema": {
        "fields": [
          { "name": "series", "type": "string" },
          { "name": "diameter", "type": "number", "unit": "um" },
          { "name": "incident_velocity", "type": "number", "unit": "m/s" },
          { "name": "restitution", "type": "number", "unit": "1" },
          { "name": "restitution_sd", "type": "number", "unit": "1" },
          { "name": "events", "type": "integer", "unit": "1" },
          { "name": "captured", "type": "integer", "unit": "1" }
        ]
      }
    }
  ],
  "recoil": {
    "provenance": "synthetic",
    "particle": {
      "material": "polystyrene", "density": 1050, "youngs_modulus": 2.56e9, "poisson_ratio": 0.35
    },
    "surface": { "material": "silicon", "youngs_modulus": 131e9, "poisson_ratio": 0.28 }
  }
}
)";

const char* const kFit = R"(dataset = "data"
[model]
adhesion_damping_phase = "rebound"
[parameters]
C_H = { initial = 3e-3, bounds = [0, 1] }
C_A = { initial = 3e-2, bounds = [0, 10] }
f0 = { free = false }
[uncertainty]
replicates = 39
level = 0.95
seed = 1
)";

std::string slurp(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

Workplace::Workplace() {
  std::string place = (fs::temp_directory_path() / "recoil-cli-XXXXXX").string();
  if (mkdtemp(place.data()) == nullptr) throw std::runtime_error("no folder to work in");
  folder_ = place;
  write("data/datapackage.json", kPackage);
  write("data/points.csv", kPoints);
  write("fit.toml", kFit);
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Workplace::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Workplace::read(const std::string& name) const { return slurp(folder_ / name); }

void Workplace::change(const std::string& name, const std::string& old_text,
                       const std::string& new_text) const {
  std::string text = read(name);
  const std::size_t at = text.find(old_text);
  ASSERT_NE(at, std::string::npos) << name << " holds no '" << old_text << "'";
  write(name, text.replace(at, old_text.size(), new_text));
}

Outcome Workplace::run(const std::vector<std::string>& arguments) const {
  // Beside the folder, so that the listing shows only what the command wrote.
  const std::string out = folder_.string() + ".out";
  const std::string err = folder_.string() + ".err";
  std::vector<char*> argv;
  std::string binary = RECOIL_BINARY;
  std::vector<std::string> words = arguments;
  argv.push_back(binary.data());
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    const int in_file = open("/dev/null", O_RDONLY);
    const int out_file = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int err_file = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(in_file, 0);
    dup2(out_file, 1);
    dup2(err_file, 2);
    if (chdir(folder_.c_str()) != 0) _exit(127);
    execv(binary.c_str(), argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Outcome result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = slurp(out);
  result.err = slurp(err);
  fs::remove(out);
  fs::remove(err);
  return result;
}

std::vector<std::string> Workplace::listing() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_)) {
    names.push_back(fs::relative(entry.path(), folder_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace program
