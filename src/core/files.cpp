#include "core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sha256.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "core/error.hpp"

namespace recoil {
namespace {

/// ".part-HOST-PROCESS": on a folder that machines share, two of them may have the same process.
std::string unique_ending() {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  return fmt::format(".part-{}-{}", host, static_cast<long>(getpid()));
}

/// Writes `text` and waits until it is on the disk. @return whether it is
bool write_to_disk(const std::filesystem::path& path, std::string_view text) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return false;
  bool written = true;
  while (written && !text.empty()) {
    const ssize_t some = write(file, text.data(), text.size());
    if (some < 0 && errno == EINTR) continue;
    written = some > 0;
    if (written) text.remove_prefix(static_cast<std::size_t>(some));
  }
  // What cannot be synchronised, such as a pipe, is written all the same.
  if (written && fsync(file) != 0) written = errno == EINVAL || errno == EROFS;
  return close(file) == 0 && written;
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

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  const Location where{path.string()};
  std::error_code failed;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
  const std::filesystem::path beside = path.string() + unique_ending();
  if (!write_to_disk(beside, text)) {
    std::filesystem::remove(beside, failed);
    throw InputError(where, "the file cannot be written", "",
                     "check its folder's permissions and the disk");
  }
  std::filesystem::rename(beside, path, failed);
  if (failed) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw InputError(where, "the finished file cannot be put in its place", failed.message(),
                     "choose another place");
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
    throw InputError(where, fmt::format("no permission to write into {}", nearest.string()), "",
                     "choose another folder for the results");
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
