#pragma once

#include <filesystem>
#include <string>

/// A valid dataset to begin with, and a folder to write it to.
namespace example {

/// `datapackage.json` with all columns but rebound_velocity, over 27 lines.
extern const std::string package;
/// Four points of two series below a header.
extern const std::string points;

/// `text` with the first `old_text`, which must be there, replaced.
std::string changed(std::string text, const std::string& old_text, const std::string& new_text);

/// A dataset folder of its own that is removed at the end.
class DatasetFolder {
 public:
  explicit DatasetFolder(const std::string& package_text = package,
                         const std::string& points_text = points);
  ~DatasetFolder();
  DatasetFolder(const DatasetFolder&) = delete;
  DatasetFolder& operator=(const DatasetFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& text) const;

  /// The message with which loading fails, without the folder's path; "loaded" when it does not.
  std::string failure() const;

 private:
  std::filesystem::path path_;
};

/// A mistake: a file, what is replaced by what in it, and how the message begins and what it names.
struct Mistake {
  std::string name;
  std::string old_text;
  std::string new_text;
  std::string begin;  ///< "points.csv:3:7: "
  std::string word;   ///< of the problem
  std::string hint;   ///< of the suggestion
};

/// Checks the grammar: it begins so, is one line, and has problem, (why) and suggestion.
void expect_message(const std::string& message, const Mistake& mistake);

}  // namespace example
