#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Driving the built command as a user does, and a small dataset to drive it with.
namespace program {

/// What one run of the command left behind.
struct Outcome {
  int status = -1;  ///< exit status; 128 + signal when it was killed
  std::string out;
  std::string err;
};

/// A folder of its own that is removed at the end, with a valid dataset `data/` (two sizes, a
/// captured point) and a valid `fit.toml` in it.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  /// Replaces the first occurrence of `old_text`, which must be there.
  void change(const std::string& name, const std::string& old_text,
              const std::string& new_text) const;

  /// Runs the command in this folder, stdin empty.
  Outcome run(const std::vector<std::string>& arguments) const;

  /// Every file and folder below, sorted.
  std::vector<std::string> listing() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace program
