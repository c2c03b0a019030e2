#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/json.hpp"

namespace recoil {

/// When long work puts what is finished on disk: every half minute, so that a process that is
/// killed loses no more, but never for more than a tenth of the time.
class KeepingPace {
 public:
  using Clock = std::chrono::steady_clock;

  explicit KeepingPace(Clock::duration most_lost = std::chrono::seconds(30))
      : most_lost_(most_lost), next_(Clock::now() + most_lost) {}

  bool is_due() const { return Clock::now() >= next_; }

  /// Runs `write`, and counts from its end. Where the place cannot be written the work goes on: a
  /// line on standard error says so, once.
  /// @return whether it was written
  bool keep(const std::function<void()>& write);

 private:
  static constexpr int longer_than_writing = 10;

  Clock::duration most_lost_;
  Clock::time_point next_;
  bool told_ = false;
};

/// What came of numbered pieces of long work, kept in a file of rows (row_file.hpp), so that the
/// next run goes on from there. May be used from any thread.
class KeptRows {
 public:
  /// Takes over what `file` holds, if it is whole and was written under `key`, a hash of everything
  /// that decides a digit of the pieces. Without a file rows are kept in memory alone.
  KeptRows(std::filesystem::path file, std::string key, KeepingPace pace = KeepingPace());

  /// What came of a piece; none where it is not there.
  std::optional<Json> find(std::size_t piece) const;

  /// Takes what came of a piece, and writes the file when it is time and the place can be written.
  /// @throws CalledOff, before it takes anything, where the work was called off meanwhile
  void put(std::size_t piece, Json row);

  /// Writes the file now. @throws InputError when the place cannot be written
  void keep();

  /// Removes the file, once the results are written.
  void forget() const;

  std::size_t size() const;
  /// All that is there; of use when nobody puts any more.
  const std::map<std::size_t, Json>& rows() const { return rows_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  void write() const;

  std::filesystem::path file_;
  std::string key_;
  mutable std::mutex using_;
  std::map<std::size_t, Json> rows_;
  KeepingPace pace_;
};

/// Where work that is to become `result` keeps what is finished: "unfinished-NAME.jsonl" beside it.
std::filesystem::path unfinished_beside(const std::filesystem::path& result);

}  // namespace recoil
