#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace support {

/// The bytes of a file; fails the current test when it cannot be read.
std::string text_of(const std::filesystem::path& file);

/// Writes `text`, with the folders above it.
void write_text(const std::filesystem::path& file, const std::string& text);

/// `text` with the first `old_text`, which must be there, replaced.
std::string changed(std::string text, const std::string& old_text, const std::string& new_text);

/// A folder of one's own that is removed at the end, whatever happens.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

  void write(const std::filesystem::path& name, const std::string& text) const;
  std::string read(const std::filesystem::path& name) const;
  bool has(const std::filesystem::path& name) const;
  /// Replaces the first occurrence of `old_text`, which must be there.
  void change(const std::filesystem::path& name, const std::string& old_text,
              const std::string& new_text) const;
  /// Every file and folder below, sorted.
  std::vector<std::string> listing() const;

 private:
  std::filesystem::path path_;
};

}  // namespace support
