#include "core/shared_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/row_file.hpp"

namespace recoil {
namespace {

using SharedClock = std::chrono::steady_clock;

// A killed process loses this at most. Ten thousand of them write thirty files a second then, which
// a shared file system bears.
constexpr auto between_keeps = std::chrono::minutes(5);

/// Hands on the rows of a file that is whole, and nothing of another.
void take_rows(const std::filesystem::path& file, std::size_t pieces,
               const std::function<void(std::size_t piece, Json row)>& take) {
  std::vector<std::pair<std::size_t, Json>> found;
  const bool whole = read_rows(file, [&](const Json& row) {
    const std::size_t piece = row[0].get<std::size_t>();
    if (piece >= pieces || row.size() != 2) return false;
    found.emplace_back(piece, row[1]);
    return true;
  });
  if (!whole) return;
  for (auto& [piece, row] : found) take(piece, std::move(row));
}

void write_done(const std::filesystem::path& file, const Origin& origin, const Shard& shard,
                const std::vector<Json>& rows) {
  std::vector<Json> done;
  for (std::size_t i = shard.number - 1; i < rows.size(); i += shard.of) {
    if (!rows[i].is_null()) done.push_back(Json::array({i, rows[i]}));
  }
  write_rows(file, part_head(origin, shard), done);
}

}  // namespace

std::filesystem::path unfinished_path(const std::filesystem::path& folder, const Origin& origin,
                                      const Shard& shard) {
  return folder / ("unfinished-" + part_path("", origin, shard).string());
}

void write_part(const SharedWork& work, const Origin& origin, const Shard& shard,
                const std::filesystem::path& folder) {
  const std::filesystem::path unfinished = unfinished_path(folder, origin, shard);
  std::vector<Json> rows(work.pieces);
  take_rows(unfinished, work.pieces,
            [&rows](std::size_t piece, Json row) { rows[piece] = std::move(row); });
  std::vector<std::size_t> left;
  for (std::size_t i = shard.number - 1; i < work.pieces; i += shard.of) {
    if (rows[i].is_null()) left.push_back(i);
  }
  {
    const InterruptGuard guard;
    Progress progress(work.label, left.size());
    std::mutex keeping;
    SharedClock::time_point kept = SharedClock::now();
    parallel_over(left.size(), work.threads, [&](std::size_t k) {
      if (stop_requested()) return;
      Json row = work.run(left[k]);
      progress.advance();
      const std::lock_guard lock(keeping);
      rows[left[k]] = std::move(row);
      if (SharedClock::now() - kept < between_keeps) return;
      write_done(unfinished, origin, shard, rows);
      kept = SharedClock::now();
    });
    if (stop_requested()) {
      write_done(unfinished, origin, shard, rows);
      const auto done = std::count_if(left.begin(), left.end(),
                                      [&](std::size_t i) { return !rows[i].is_null(); });
      throw Interrupted(fmt::format(
          "stopped: {} of {} pieces are kept in {}; the same command goes on from there",
          shard.share(work.pieces) - left.size() + static_cast<std::size_t>(done),
          shard.share(work.pieces), unfinished.string()));
    }
  }
  write_done(part_path(folder, origin, shard), origin, shard, rows);
  std::error_code ignored;
  std::filesystem::remove(unfinished, ignored);
}

std::vector<bool> read_parts(const std::vector<std::filesystem::path>& parts, std::size_t pieces,
                             const std::function<void(std::size_t piece, const Json& row)>& take) {
  std::vector<bool> there(pieces);
  for (const std::filesystem::path& part : parts) {
    take_rows(part, pieces, [&](std::size_t piece, const Json& row) {
      take(piece, row);
      there[piece] = true;
    });
  }
  return there;
}

}  // namespace recoil
