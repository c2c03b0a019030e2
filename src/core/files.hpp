#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace recoil {

/// The open descriptor that a path names: 0 for "-" and /dev/stdin, N for /dev/fd/N, as a shell
/// writes <(...). Such a file can be read only once.
std::optional<int> descriptor_named(const std::filesystem::path& path);

/// Reads a file, or a pipe or device to its end. "-" is standard input.
/// @throws InputError if the file is missing, unreadable, a folder or larger than `max_bytes`, and
///   if it is a pipe or device that sends no data for `patience`
std::string read_bytes(const std::filesystem::path& path,
                       std::uintmax_t max_bytes = 256ULL * 1024 * 1024,
                       std::chrono::milliseconds patience = std::chrono::seconds(30));

/// The text of a file with this content, without a byte-order mark.
/// @throws InputError if it contains a NUL byte
std::string as_text(std::string bytes, const std::filesystem::path& path);

/// Reads a text file. @throws InputError as `read_bytes` and `as_text`
std::string read_text_file(const std::filesystem::path& path,
                           std::uintmax_t max_bytes = 256ULL * 1024 * 1024,
                           std::chrono::milliseconds patience = std::chrono::seconds(30));

struct WholeFile {
  std::filesystem::path path;
  std::string text;
};

/// Which existing files may be replaced: results only, or also data: a file that this process has
/// read, a points.csv or a datapackage.json.
enum class Replacing { results, data };

/// Writes a file as a whole: writes a new file with an unpredictable name beside the target,
/// synchronises it and renames it. A reader sees the old file or the new one, never a part, even
/// with several writers. The new file gets the permissions of the old one. A missing folder is
/// created, a symbolic link is followed, and data are written into a device or pipe.
/// @throws InputError if the file cannot be written, and as `require_free`
void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      Replacing replacing = Replacing::results);

/// The same for files that belong together: all of them are replaced, or none. No file is renamed
/// before all are on the disk, and the earlier ones stay beside them until all are renamed.
void write_whole_files(const std::vector<WholeFile>& files,
                       Replacing replacing = Replacing::results);

/// Checks the names of results. Commands call it before the computation; `write_whole_files` calls
/// it again.
/// @throws InputError if two outputs are the same file, if one is a folder, or if one is protected
///   (see `Replacing`)
void require_free(const std::vector<std::filesystem::path>& outputs,
                  Replacing replacing = Replacing::results);

/// The error for a file that cannot be written. @param failed errno
InputError cannot_be_written(const std::filesystem::path& path, int failed);

/// Checks before a long computation that results can be written into `folder`; creates nothing.
/// @throws InputError if it is a file, or if the nearest existing folder above it is read-only
void require_writable_folder(const std::filesystem::path& folder);

/// The files with this extension in a folder, sorted; empty if the folder cannot be read.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& extension);

/// A hash of `bytes` as lower-case hexadecimal digits. @param algorithm md5 (RFC 1321), sha1,
/// sha256 or sha512 (FIPS 180-4); the hash by another one is empty
std::string hash_hex(std::string_view algorithm, std::string_view bytes);

std::string sha256_hex(std::string_view bytes);

/// SHA-256 of the content of a file; empty if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// Keeps other processes of recoil from working on the same result during its lifetime: two would
/// mix their files and their finished pieces. It locks a file "RESULT.lock" beside the result; the
/// system releases the lock when the process ends. A file system without locks gives no protection.
class Claim {
 public:
  /// Creates the folder if it is missing.
  /// @throws InputError if another process holds the lock, or if the file cannot be written
  explicit Claim(const std::filesystem::path& result);
  /// Removes the lock file, and the folders that were created for it if they are empty.
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  void remove_empty_folders();

  std::filesystem::path mark_;
  std::vector<std::filesystem::path> made_;  // innermost first
  int file_ = -1;
};

}  // namespace recoil
