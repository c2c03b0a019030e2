#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace recoil {

/// The place of a mistake in a user's file. Lines and columns count from 1; 0: not known.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
};

/// An error that the user can correct, in a file, a key, a value or on the command line. The
/// program exits with status 2.
///
/// `what()` is one line:
///
///   file:line:column: problem (why it is one); suggestion
///
/// The problem states what was found ("the file is empty", "'captured' is 5"). The reason may be
/// empty if the problem explains itself. The suggestion is an imperative or "did you mean ...?", or
/// empty. Empty parts are omitted with their punctuation. No code parses the line, because members
/// return its parts.
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

/// A computation without a usable result. The message names the parameter or point that caused it.
/// The program exits with status 3. Failures within a bootstrap are values, not exceptions, because
/// they must be counted.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `word` in small letters, without blanks, hyphens and underscores. Words that are equal in this
/// form mean the same.
std::string plain_word(std::string_view word);

/// The member of `known` that is nearest to `word` in edit distance, for "did you mean" hints;
/// empty when nothing is near. One letter in four may be wrong, but none of two. Two letters that
/// changed places count as one.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace recoil
