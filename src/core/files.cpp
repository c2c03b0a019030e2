#include "core/files.hpp"

#include <fmt/format.h>
#include <sha256.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <system_error>

#include "core/error.hpp"

namespace recoil {

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
  const std::filesystem::path beside =
      path.string() + fmt::format(".part-{}", static_cast<long>(getpid()));
  {
    std::ofstream out(beside, std::ios::binary | std::ios::trunc);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) {
      std::filesystem::remove(beside, failed);
      throw InputError(where, "the file cannot be written", "",
                       "check its folder's permissions and the disk");
    }
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

}  // namespace recoil
