#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace support {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  const std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

std::string changed(std::string text, const std::string& old_text, const std::string& new_text) {
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos) {
    ADD_FAILURE() << "there is no '" << old_text << "' in\n" << text;
    return text;
  }
  return text.replace(at, old_text.size(), new_text);
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "recoil-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void TemporaryFolder::write(const fs::path& name, const std::string& text) const {
  write_text(path_ / name, text);
}

std::string TemporaryFolder::read(const fs::path& name) const { return text_of(path_ / name); }

bool TemporaryFolder::has(const fs::path& name) const { return fs::exists(path_ / name); }

void TemporaryFolder::change(const fs::path& name, const std::string& old_text,
                             const std::string& new_text) const {
  write(name, changed(read(name), old_text, new_text));
}

std::vector<std::string> TemporaryFolder::listing() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_)) {
    names.push_back(fs::relative(entry.path(), path_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace support
