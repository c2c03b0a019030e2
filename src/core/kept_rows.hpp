#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/json.hpp"

/// The results of numbered pieces of work as rows of a file.
namespace recoil {

/// The rows of a file by the number of their piece. Each row is JSON on one line.
using Rows = std::map<std::uint64_t, std::string>;

/// Writes a file of rows as a whole. Its first line is the object `head` with the added keys "rows"
/// (their number), "bytes" and "sha256". Every further line is one row, [piece, row].
/// @throws InputError if the file cannot be written
void write_rows(const std::filesystem::path& file, Json head, const Rows& rows);

/// The first line of a file of rows; nullopt if the file is missing, truncated or of another kind.
std::optional<Json> read_row_head(const std::filesystem::path& file);

/// All rows of a file; nullopt if it is missing or its rows were changed.
/// @throws InputError if it is too large
std::optional<Rows> read_rows(const std::filesystem::path& file);

/// A row of numbers that round-trips every double.
inline Json row_json(const std::vector<double>& numbers) {
  return as_json(numbers, NonFinite::word);
}
/// The numbers of a row of `row_json`. @throws JsonMismatch for another kind of row
inline std::vector<double> row_numbers(const Json& row) {
  return value_from<std::vector<double>>(row);
}

/// Decides when long work writes its rows to a file: every 30 s, so that a killed process loses no
/// more than that, but less often if writing would take more than a tenth of the time.
class KeepingPace {
 public:
  using Clock = std::chrono::steady_clock;

  explicit KeepingPace(Clock::duration most_lost = std::chrono::seconds(30))
      : most_lost_(most_lost), next_(Clock::now() + most_lost) {}

  bool is_due() const { return Clock::now() >= next_; }

  /// Calls `write`, and counts the time to the next call from its end. An error of writing does not
  /// stop the work; one line on standard error reports it.
  void keep(const std::function<void()>& write);

 private:
  static constexpr int longer_than_writing = 10;

  Clock::duration most_lost_;
  Clock::time_point next_;
  bool reported_ = false;
};

/// The rows of the finished pieces of long work. With a file, a run that was stopped or killed
/// continues from it. Every member may be called from any thread.
class KeptRows {
 public:
  /// Reads the rows of `file` if it is complete and has the same `key`, a hash of everything that a
  /// digit of a row depends on. Without a file the rows stay in memory.
  explicit KeptRows(std::filesystem::path file = {}, std::string key = {},
                    KeepingPace pace = KeepingPace());

  /// The row of `piece`; nullopt if that piece is not finished.
  std::optional<Json> find(std::uint64_t piece) const;
  bool has(std::uint64_t piece) const;

  /// Adds a row, and writes the file if `KeepingPace` says so.
  /// @throws CalledOff if the work was called off, because its result may then be incomplete
  void put(std::uint64_t piece, const Json& row);

  /// Adds the rows of another `file`, except for pieces that have a row already.
  void add(Rows rows, const std::filesystem::path& file);

  /// Writes the file now. @throws InputError if it cannot be written
  void keep();

  /// Removes the file. Call it once the results are written.
  void forget() const;

  std::size_t size() const;
  /// The numbers of the finished pieces, ascending.
  std::vector<std::uint64_t> pieces() const;
  /// All rows. Call it only after the last `put`.
  const Rows& rows() const { return rows_; }
  const std::filesystem::path& file() const { return file_; }
  /// The error for rows of another kind than expected.
  InputError mistake(const std::string& why) const;

 private:
  void write() const;

  std::filesystem::path file_;
  std::filesystem::path folder_;  ///< of added files
  std::string key_;
  mutable std::mutex mutex_;
  Rows rows_;
  KeepingPace pace_;
};

/// The result of `count`, which reads rows of `kept`.
/// @throws InputError if they are JSON of another type, shape or length
template <class Count>
auto counted_rows(const KeptRows& kept, const Count& count) {
  try {
    return count();
  } catch (const JsonMismatch& mismatch) {
    throw kept.mistake(mismatch.what());
  } catch (const std::out_of_range&) {
    throw kept.mistake("one of them is too short");
  }
}

/// The result of `piece`: `read(row)` if `kept` has its row, and otherwise `made = make()`, after
/// adding the row `write(made)`. If `read` throws, the result is made again.
/// @param kept may be null
template <class Make, class Write, class Read>
auto kept_or_made(KeptRows* kept, std::uint64_t piece, const Make& make, const Write& write,
                  const Read& read) {
  if (kept != nullptr) {
    if (const std::optional<Json> row = kept->find(piece)) {
      try {
        return read(*row);
      } catch (const std::exception&) {
      }
    }
  }
  auto made = make();
  if (kept != nullptr) kept->put(piece, write(made));
  return made;
}

}  // namespace recoil
