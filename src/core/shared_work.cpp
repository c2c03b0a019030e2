#include "core/shared_work.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/row_file.hpp"

namespace recoil {
namespace {

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

}  // namespace

std::filesystem::path unfinished_path(const std::filesystem::path& folder, const Origin& origin,
                                      const Shard& shard) {
  return folder / ("unfinished-" + part_path("", origin, shard).string());
}

void run_pieces(const SharedWork& work, const Shard& shard, KeptRows& kept) {
  std::vector<std::size_t> left;
  for (std::size_t i = shard.number - 1; i < work.pieces; i += shard.of) {
    if (!kept.find(i)) left.push_back(i);
  }
  const InterruptGuard guard;
  Progress progress(work.label, left.size());
  parallel_over(left.size(), work.threads, [&](std::size_t k) {
    if (stop_requested()) return;
    kept.put(left[k], work.run(left[k]));
    progress.advance();
  });
  if (!stop_requested()) return;
  kept.keep();
  throw Interrupted(
      fmt::format("stopped: {} of {} pieces are kept in {}; the same command goes on from there",
                  kept.size(), shard.share(work.pieces), kept.file().string()));
}

void write_part(const SharedWork& work, const Origin& origin, const Shard& shard,
                const std::filesystem::path& folder) {
  KeptRows kept(unfinished_path(folder, origin, shard), key_of(origin));
  run_pieces(work, shard, kept);
  std::vector<Json> rows;
  for (std::size_t i = shard.number - 1; i < work.pieces; i += shard.of) {
    rows.push_back(Json::array({i, *kept.find(i)}));
  }
  write_rows(part_path(folder, origin, shard), part_head(origin, shard), rows);
  kept.forget();
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
