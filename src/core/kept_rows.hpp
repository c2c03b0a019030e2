#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"

namespace recoil {

/// The rows of a file by the number of their piece; each is JSON on one line.
using Rows = std::map<std::size_t, std::string>;

/// Writes a file of rows, whole or not at all. Its first line is `head`, an object, to which "rows"
/// (how many follow), their "bytes" and their "sha256" are added; every further line is one row,
/// [piece, row].
/// @throws InputError when the place cannot be written
void write_rows(const std::filesystem::path& file, Json head, const Rows& rows);

/// The first line alone; nullopt for a file that is missing, cut short or of another kind.
std::optional<Json> read_row_head(const std::filesystem::path& file);

/// All rows; nullopt for a file that is missing, or whose rows are not those that were written.
std::optional<Rows> read_rows(const std::filesystem::path& file);

/// Numbers as a row that round-trips every double.
inline Json row_json(const std::vector<double>& numbers) {
  return as_json(numbers, NonFinite::word);
}
/// The numbers of such a row. @throws JsonMismatch for another kind of row
inline std::vector<double> row_numbers(const Json& row) {
  return value_from<std::vector<double>>(row);
}

/// How often long work writes a file of its rows: every half minute, so that a process that is
/// killed loses no more than that, but for at most a tenth of the time.
class KeepingPace {
 public:
  using Clock = std::chrono::steady_clock;

  explicit KeepingPace(Clock::duration most_lost = std::chrono::seconds(30))
      : most_lost_(most_lost), next_(Clock::now() + most_lost) {}

  bool is_due() const { return Clock::now() >= next_; }

  /// Calls `write` and counts from its end. A place that cannot be written does not stop the work:
  /// one line on standard error reports it.
  void keep(const std::function<void()>& write);

 private:
  static constexpr int longer_than_writing = 10;

  Clock::duration most_lost_;
  Clock::time_point next_;
  bool reported_ = false;
};

/// The rows of the finished pieces of some long work. With a file, a run that was stopped or killed
/// goes on from there. Every member may be called from any thread.
class KeptRows {
 public:
  /// Takes over the rows of `file` if it is whole and has the same `key`, a hash of everything that
  /// decides a digit of a row. Without a file the rows stay in memory.
  explicit KeptRows(std::filesystem::path file = {}, std::string key = {},
                    KeepingPace pace = KeepingPace());

  /// The row of `piece`; nullopt if that piece is not finished.
  std::optional<Json> find(std::size_t piece) const;
  bool has(std::size_t piece) const;

  /// Adds a row, and writes the file when it is due.
  /// @throws CalledOff if the work was called off meanwhile: its result may be incomplete
  void put(std::size_t piece, const Json& row);

  /// Adds the rows of another file; those that are there already stay.
  void add(Rows rows);

  /// Writes the file now. @throws InputError when the place cannot be written
  void keep();

  /// Removes the file. Call it once the results are written.
  void forget() const;

  std::size_t size() const;
  /// The numbers of the finished pieces, ascending.
  std::vector<std::size_t> pieces() const;
  /// All rows. Call it only after the last `put`.
  const Rows& rows() const { return rows_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  void write() const;

  std::filesystem::path file_;
  std::string key_;
  mutable std::mutex mutex_;
  Rows rows_;
  KeepingPace pace_;
};

/// The result of `piece`: `read` of its row in `kept`, or else `make()`, whose row is `write` of
/// it. A row that `read` refuses by an exception is made again.
/// @param kept null: nothing is kept
template <class Make, class Write, class Read>
auto kept_or_made(KeptRows* kept, std::size_t piece, const Make& make, const Write& write,
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
