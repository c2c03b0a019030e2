#include "core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sha256.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace recoil {
namespace {

/// ".part-HOST-PROCESS-NUMBER": on a folder that machines share, two of them may have the same
/// process, and a process may write from several threads.
std::string unique_ending() {
  static std::atomic<unsigned> number{0};
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  return fmt::format(".part-{}-{}-{}", host, static_cast<long>(getpid()), ++number);
}

/// Writes `text` and waits until it is on the disk. @return 0, or the errno of the failure
int write_to_disk(const std::filesystem::path& path, std::string_view text) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int failed = 0;
  while (failed == 0 && !text.empty()) {
    const ssize_t some = write(file, text.data(), text.size());
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) {
      failed = some < 0 ? errno : EIO;
    } else {
      text.remove_prefix(static_cast<std::size_t>(some));
    }
  }
  // A pipe, for example, is written but cannot be synchronised.
  if (failed == 0 && fsync(file) != 0 && errno != EINVAL && errno != EROFS) failed = errno;
  if (close(file) != 0 && failed == 0) failed = errno;
  return failed;
}

/// The file that a path leads to through symbolic links. The link stays, and its target is
/// replaced.
std::filesystem::path behind_links(std::filesystem::path path) {
  constexpr int most_links = 40;  // as Linux follows
  std::error_code failed;
  for (int i = 0; i < most_links && std::filesystem::is_symlink(path, failed); ++i) {
    path = path.parent_path() / std::filesystem::read_symlink(path, failed);
  }
  return path;
}

/// Is it a device or a pipe, which is written into and cannot be replaced?
bool is_special(const std::filesystem::path& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// The hint appended to "cannot be written" errors.
std::string advice_on(int failed) {
  switch (failed) {
    case ENOSPC:
    case EDQUOT:
      return "make room there, and run the same command again";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose another place, or make this one writable";
    default:
      return "check its folder and the disk";
  }
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  const Location where{path.string()};
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (failed || !std::filesystem::exists(status)) {
    throw InputError(where, "no such file", "", "check the path");
  }
  if (std::filesystem::is_directory(status)) {
    throw InputError(where, "this is a folder, not a file", "", "name a file inside it");
  }
  const std::uintmax_t size =
      std::filesystem::is_regular_file(status) ? std::filesystem::file_size(path, failed) : 0;
  if (!failed && size > max_bytes) {
    throw InputError(where, fmt::format("the file has {} MB", size / 1000000),
                     fmt::format("at most {} MB are read", max_bytes / 1000000), "split it");
  }
  std::ifstream in(path, std::ios::binary);
  std::string text;
  // Read piece by piece, so that a device that never ends is refused like a file that is too large.
  std::array<char, 1 << 16> piece{};
  while (in && text.size() <= max_bytes) {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (text.size() > max_bytes) {
    throw InputError(where, fmt::format("the file has more than {} MB", max_bytes / 1000000),
                     "no more is read", "split it");
  }
  if (!in.eof())
    throw InputError(where, "the file cannot be read", "", "check its permissions and the disk");
  if (const auto nul = text.find('\0'); nul != std::string::npos) {
    throw InputError(where, "this is not a text file", fmt::format("byte {} is NUL", nul + 1),
                     "save it as UTF-8 text");
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte-order mark carries no meaning
  return text;
}

InputError cannot_be_written(const std::filesystem::path& path, int failed) {
  return InputError({path.string()}, "the file cannot be written", std::strerror(failed),
                    advice_on(failed));
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  write_whole_files({{path, std::string(text)}});
}

void write_whole_files(const std::vector<WholeFile>& all) {
  const std::string ending = unique_ending();
  std::vector<WholeFile> files, special;
  for (const WholeFile& file : all) {
    (is_special(file.path) ? special : files).push_back({behind_links(file.path), file.text});
  }
  const auto beside = [&ending](const WholeFile& file) -> std::filesystem::path {
    return file.path.string() + ending;
  };
  std::error_code failed;
  const auto remove_all_from = [&](std::size_t first) {
    std::error_code ignored;
    for (std::size_t i = first; i < files.size(); ++i) {
      std::filesystem::remove(beside(files[i]), ignored);
    }
  };
  for (const WholeFile& file : files) {
    failed.clear();
    if (file.path.has_parent_path()) {
      std::filesystem::create_directories(file.path.parent_path(), failed);
    }
    if (const int error = failed ? failed.value() : write_to_disk(beside(file), file.text);
        error != 0) {
      remove_all_from(0);
      throw cannot_be_written(file.path, error);
    }
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::filesystem::rename(beside(files[i]), files[i].path, failed);
    if (!failed) continue;
    remove_all_from(i);
    throw InputError({files[i].path.string()}, "the finished file cannot be put in its place",
                     failed.message(), "choose another place");
  }
  for (const WholeFile& file : special) {
    if (const int error = write_to_disk(file.path, file.text)) {
      throw cannot_be_written(file.path, error);
    }
  }
}

void require_other_file(const std::filesystem::path& out,
                        const std::vector<std::filesystem::path>& read) {
  for (const std::filesystem::path& file : read) {
    std::error_code absent;
    if (!std::filesystem::equivalent(out, file, absent)) continue;
    throw InputError({out.string()}, "this file is read, and would be overwritten", "",
                     "choose another place for the result");
  }
}

void require_writable_folder(const std::filesystem::path& folder) {
  const Location where{folder.string()};
  std::error_code failed;
  std::filesystem::path nearest = std::filesystem::absolute(folder, failed);
  while (!std::filesystem::exists(nearest, failed) && nearest.has_relative_path()) {
    nearest = nearest.parent_path();
  }
  if (!std::filesystem::is_directory(nearest, failed)) {
    throw InputError(where, fmt::format("{} is a file, not a folder", nearest.string()), "",
                     "choose another folder for the results");
  }
  if (access(nearest.c_str(), W_OK) != 0) {
    throw InputError(where, fmt::format("nothing can be written into {}", nearest.string()),
                     std::strerror(errno), "choose another folder for the results");
  }
}

std::string sha256_hex(std::string_view bytes) {
  char digest[SHA256_DIGEST_STRING_LENGTH];
  SHA256Data(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), digest);
  return digest;
}

std::string sha256_of_file(const std::filesystem::path& path) {
  char digest[SHA256_DIGEST_STRING_LENGTH];
  return SHA256File(path.c_str(), digest) == nullptr ? "" : digest;
}

}  // namespace recoil
