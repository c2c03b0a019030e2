#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace recoil {

/// Where in a user's file a mistake stands. Lines and columns count from 1; 0 means "not known".
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// The one error for whatever a user can put right: a file, a key, a value, the command line. The
/// command line ends with status 2 on it.
///
/// `what()` is one line, as a person would say it:
///
///   file:line:column: problem (why it is one); suggestion
///
/// The problem says what is there ("the file is empty", "'captured' is 5"); the reason is given
/// where the problem alone does not explain itself, and the suggestion, an imperative or "did you
/// mean ...?", where there is something to suggest. What is empty is left out with its punctuation.
/// The parts are available as members; no code parses the line.
class InputError : public std::runtime_error {
 public:
  InputError(const Location& where, const std::string& problem, const std::string& why,
             const std::string& suggestion);

  const Location& where() const { return where_; }
  const std::string& problem() const { return problem_; }
  const std::string& why() const { return why_; }
  const std::string& suggestion() const { return suggestion_; }

 private:
  Location where_;
  std::string problem_;
  std::string why_;
  std::string suggestion_;
};

/// A computation that ended without a usable answer, with the parameter or point that stood in the
/// way. The command line ends with status 3 on it. Failures *inside* a bootstrap are values, not
/// exceptions, because they must be counted.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The member of `known` that is nearest to `word` in edit distance, for "did you mean" hints;
/// empty when nothing is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace recoil
