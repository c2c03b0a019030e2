#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>

#include "core/error.hpp"
#include "core/files.hpp"

namespace recoil {
namespace {

/// True if `path` still names the open `file`, which its owner may have removed meanwhile.
bool is_still_there(int file, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return fstat(file, &opened) == 0 && lstat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

std::string owner_in(int file) {
  std::array<char, 300> words{};
  const ssize_t size = pread(file, words.data(), words.size(), 0);
  return size > 0 ? std::string(words.data(), static_cast<std::size_t>(size)) : std::string();
}

/// True for a regular file that is empty or names an owner.
bool is_mark(int file) {
  struct stat opened {};
  if (fstat(file, &opened) != 0 || !S_ISREG(opened.st_mode)) return false;
  return opened.st_size == 0 || owner_in(file).starts_with("process ");
}

void name_owner(int file) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string words =
      fmt::format("process {} on {}", static_cast<long>(getpid()), host.data());
  // The text only informs people. A full disk is reported when the results are written.
  if (ftruncate(file, 0) == 0 && pwrite(file, words.data(), words.size(), 0) < 0) return;
}

/// Opens and locks the file `mark` of `result`. @throws InputError as the constructor of Claim
int locked_file(const std::filesystem::path& mark, const std::filesystem::path& result) {
  for (;;) {
    const int file =
        open(mark.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    const int error = file < 0 ? errno : 0;
    if (error == ELOOP || (error == 0 && !is_mark(file))) {
      if (file >= 0) close(file);
      throw InputError({mark.string()}, "this is not a lock file of recoil",
                       "it is a link, or its contents are different", "remove it");
    }
    if (error != 0) throw cannot_be_written(result, error);
    if (flock(file, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return file;
      const std::string owner = owner_in(file);
      close(file);
      throw InputError({result.string()}, "another recoil process is writing this result", owner,
                       "wait until it has ended, or choose another place");
    }
    if (is_still_there(file, mark)) {
      name_owner(file);
      return file;
    }
    close(file);
  }
}

}  // namespace

Claim::Claim(const std::filesystem::path& result) : mark_(result.string() + ".lock") {
  std::error_code failed;
  for (std::filesystem::path folder = result.parent_path();
       !folder.empty() && !std::filesystem::exists(folder, failed); folder = folder.parent_path()) {
    made_.push_back(folder);
  }
  failed.clear();
  if (!made_.empty()) std::filesystem::create_directories(result.parent_path(), failed);
  try {
    if (failed) throw cannot_be_written(result, failed.value());
    file_ = locked_file(mark_, result);
  } catch (const InputError&) {
    remove_empty_folders();
    throw;
  }
}

Claim::~Claim() {
  std::error_code ignored;
  std::filesystem::remove(mark_, ignored);
  close(file_);
  remove_empty_folders();
}

void Claim::remove_empty_folders() {
  std::error_code failed;
  for (const std::filesystem::path& folder : made_) {
    if (!std::filesystem::remove(folder, failed)) return;  // something is in it
  }
}

}  // namespace recoil
