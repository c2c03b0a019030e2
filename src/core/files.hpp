#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace recoil {

/// The whole text of a file. @throws InputError when the file is missing, unreadable, a folder,
/// larger than `max_bytes`, or holds bytes that no text file has (NUL); when it is a pipe or a
/// device from which nothing comes for `patience`.
std::string read_text_file(const std::filesystem::path& path,
                           std::uintmax_t max_bytes = 256ULL * 1024 * 1024,
                           std::chrono::milliseconds patience = std::chrono::seconds(30));

/// A file to be written.
struct WholeFile {
  std::filesystem::path path;
  std::string text;
};

/// From now on this process replaces no file that it has read, and no points.csv or
/// datapackage.json, unless `Replacing::data` says so. The commands of recoil begin with this.
void protect_inputs();

/// May a file that the program has read, or that holds data, be replaced?
enum class Replacing { results, data };

/// Writes into a new file of an unpredictable name beside the target, waits for the disk and
/// renames: a reader sees the old file or the new one, never a part, even with other writers. The
/// new file has the permissions of the old one. Makes the folder when it is missing. Where `path`
/// is a link, the file behind it is replaced; a device or a pipe is written into.
/// @throws InputError when the place cannot be written; see also require_free
void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      Replacing replacing = Replacing::results);

/// The same for files that belong together: none is put in its place before all are on the disk, so
/// that a disk that is full leaves those that were there.
void write_whole_files(const std::vector<WholeFile>& files,
                       Replacing replacing = Replacing::results);

/// Commands ask before the work, and write_whole_files asks again.
/// @throws InputError where two of the outputs are one file, where one is a folder, and, where
/// inputs are protected and data may not be replaced, where one is a file that this process has
/// read or an existing points.csv or datapackage.json
void require_free(const std::vector<std::filesystem::path>& outputs,
                  Replacing replacing = Replacing::results);

/// The complaint about a file of which the system says `failed`, an errno.
InputError cannot_be_written(const std::filesystem::path& path, int failed);

/// Complains before a long computation, and without making anything, when results could not be
/// written into `folder` at its end: it is a file, or the nearest folder above it is read-only.
void require_writable_folder(const std::filesystem::path& folder);

/// SHA-256 of `bytes` as 64 lower-case hexadecimal digits (FIPS 180-4).
std::string sha256_hex(std::string_view bytes);

/// SHA-256 of the content of a file; empty if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// While one of these lives, no other process of recoil works on the same result: two would mix
/// their files, and take from each other what is finished. The mark is a locked file
/// "RESULT.lock" beside it, which ends with the process, however that ends. Where the file system
/// has no locks, nothing is claimed.
class Claim {
 public:
  /// Makes the folder when it is missing.
  /// @throws InputError when another process has it, or the place cannot be written
  explicit Claim(const std::filesystem::path& result);
  /// Removes the mark, and the folders that were made for it where nothing was put into them.
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  void let_go();

  std::filesystem::path mark_;
  std::vector<std::filesystem::path> made_;  // the innermost first
  int file_ = -1;
};

}  // namespace recoil
