#include "core/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <md5.h>
#include <poll.h>
#include <sha1.h>
#include <sha2.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/interrupt.hpp"

namespace recoil {
namespace {

/// 16 unpredictable hexadecimal digits.
std::string unpredictable_name() {
  std::uint64_t number = 0;
  if (getentropy(&number, sizeof number) != 0) {
    throw ComputationError("the system gives no random numbers for the names of files");
  }
  return fmt::format("{:016x}", number);
}

/// Identifies a file independently of its name: device, inode and time of modification. The time
/// distinguishes a new file from a deleted one with the same inode.
using FileIdentity = std::tuple<dev_t, ino_t, std::int64_t, std::int64_t>;

FileIdentity identity_of(const struct stat& file) {
  return {file.st_dev, file.st_ino, file.st_mtim.tv_sec, file.st_mtim.tv_nsec};
}

/// The files that this process has read.
struct ReadFiles {
  std::mutex mutex;
  std::set<FileIdentity> files;
};
ReadFiles& read_files() {
  static ReadFiles files;
  return files;
}

bool was_read(const struct stat& file) {
  const std::lock_guard lock(read_files().mutex);
  return read_files().files.contains(identity_of(file));
}

/// Owns a file descriptor.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int get() const { return descriptor_; }
  int close() { return ::close(std::exchange(descriptor_, -1)); }

 private:
  int descriptor_;
};

/// Writes `text` and waits until it is on the disk. @return 0, or the errno of the failure
int write_to_disk(OpenFile&& file, std::string_view text, std::optional<mode_t> mode) {
  if (file.get() < 0) return errno;
  int failed = mode && fchmod(file.get(), *mode) != 0 ? errno : 0;
  while (failed == 0 && !text.empty()) {
    const ssize_t some = write(file.get(), text.data(), text.size());
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) {
      failed = some < 0 ? errno : EIO;
    } else {
      text.remove_prefix(static_cast<std::size_t>(some));
    }
  }
  // A pipe, for example, is written but cannot be synchronised.
  if (failed == 0 && fsync(file.get()) != 0 && errno != EINVAL && errno != EROFS) failed = errno;
  if (file.close() != 0 && failed == 0) failed = errno;
  return failed;
}

/// Creates the file `path`, which must not exist, with the permissions of `target` if that exists.
int write_new_file(const std::filesystem::path& path, std::string_view text,
                   const std::filesystem::path& target) {
  struct stat before {};
  std::optional<mode_t> mode;
  if (stat(target.c_str(), &before) == 0) mode = before.st_mode & 0777;
  return write_to_disk(
      OpenFile(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                    mode.value_or(0666))),
      text, mode);
}

/// Follows symbolic links: writing then replaces the target and keeps the link.
std::filesystem::path behind_links(std::filesystem::path path) {
  constexpr int most_links = 40;  // as Linux follows
  std::error_code failed;
  for (int i = 0; i < most_links && std::filesystem::is_symlink(path, failed); ++i) {
    path = path.parent_path() / std::filesystem::read_symlink(path, failed);
  }
  return path;
}

/// True for a device or a pipe, to which data are written instead of replacing it.
bool is_special(const std::filesystem::path& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// Gives the file `path` a second name, or where the file system has no such names, a copy.
/// @return 0, or the errno of the failure
int keep_as(const std::filesystem::path& path, const std::filesystem::path& kept) {
  if (link(path.c_str(), kept.c_str()) == 0) return 0;
  std::error_code failed;
  std::filesystem::copy_file(path, kept, failed);
  return failed.value();
}

/// Files that belong together on their way to their places.
class Replacement {
 public:
  /// @param ending of the names of temporary files
  Replacement(std::vector<WholeFile> files, const std::string& ending) {
    for (WholeFile& file : files) {
      const std::string name = file.path.string();
      steps_.push_back({std::move(file), name + ending, name + ".kept" + ending});
    }
  }
  /// Goes back unless all files are in their places, and removes the temporary ones.
  ~Replacement() {
    std::error_code failed;
    for (const Step& step : steps_) {
      if (!done_ && step.placed) {
        if (step.kept) {
          std::filesystem::rename(step.earlier, step.file.path, failed);
        } else {
          std::filesystem::remove(step.file.path, failed);
        }
      }
      if (step.made && !step.placed) std::filesystem::remove(step.part, failed);
      if (step.kept && (done_ || !step.placed)) std::filesystem::remove(step.earlier, failed);
    }
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// @throws InputError for a file that cannot be written; the destructor then goes back
  void run() {
    for (Step& step : steps_) write(step);
    for (Step& step : steps_) {
      if (&step == &steps_.back() || !is_there(step.file.path)) continue;
      step.kept = true;
      if (const int error = keep_as(step.file.path, step.earlier)) {
        throw cannot_be_written(step.file.path, error);
      }
    }
    std::error_code failed;
    for (Step& step : steps_) {
      std::filesystem::rename(step.part, step.file.path, failed);
      if (failed) {
        throw InputError({step.file.path.string()}, "the finished file cannot be put in its place",
                         failed.message(), "choose another place");
      }
      step.placed = true;
    }
    done_ = true;
  }

 private:
  struct Step {
    WholeFile file;
    std::filesystem::path part;     ///< the new file until it is in its place
    std::filesystem::path earlier;  ///< the replaced one until all are
    bool made = false;
    bool kept = false;
    bool placed = false;
  };

  static bool is_there(const std::filesystem::path& path) {
    std::error_code failed;
    return std::filesystem::exists(path, failed);
  }

  static void write(Step& step) {
    const std::filesystem::path& path = step.file.path;
    std::error_code failed;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
    const int error = failed ? failed.value() : write_new_file(step.part, step.file.text, path);
    step.made = !failed && error != EEXIST;
    if (error != 0) throw cannot_be_written(path, error);
  }

  std::vector<Step> steps_;
  bool done_ = false;
};

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

/// Opens a file for reading. A path that names an open descriptor gives a copy of it, because a
/// socket cannot be opened by its name.
int open_to_read(const std::filesystem::path& path) {
  if (const auto descriptor = descriptor_named(path)) return fcntl(*descriptor, F_DUPFD_CLOEXEC, 0);
  // O_NONBLOCK: a pipe without a writer is opened all the same.
  return open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

}  // namespace

std::optional<int> descriptor_named(const std::filesystem::path& path) {
  if (path == "-" || path == "/dev/stdin") return STDIN_FILENO;
  if (path.parent_path() != "/dev/fd" && path.parent_path() != "/proc/self/fd") return std::nullopt;
  const std::string digits = path.filename();
  int number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [rest, failed] = std::from_chars(digits.data(), end, number);
  return failed == std::errc() && rest == end ? std::optional<int>(number) : std::nullopt;
}

std::string read_bytes(const std::filesystem::path& path, std::uintmax_t max_bytes,
                       std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  const auto fail = [&](const std::string& problem, const std::string& why,
                        const std::string& suggestion) {
    throw InputError({path.string()}, problem, why, suggestion);
  };
  const auto fail_to_read = [&] {
    fail("the file cannot be read", std::strerror(errno), "check its permissions and the disk");
  };
  const OpenFile file(open_to_read(path));
  if (file.get() < 0 && (errno == ENOENT || errno == ENOTDIR)) {
    fail("no such file", "", "check the path");
  }
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0) fail_to_read();
  if (S_ISDIR(status.st_mode)) fail("this is a folder, not a file", "", "name a file inside it");
  if (S_ISREG(status.st_mode) && static_cast<std::uintmax_t>(status.st_size) > max_bytes) {
    fail(fmt::format("the file has {} MB", status.st_size / 1000000),
         fmt::format("at most {} MB are read", max_bytes / 1000000), "split it");
  }
  constexpr auto longest_wait = std::chrono::milliseconds(100);
  const auto wait = static_cast<int>(std::min(patience, longest_wait).count());
  std::string bytes;
  std::array<char, 1 << 16> piece{};
  for (Clock::time_point last = Clock::now();;) {
    pollfd data{file.get(), POLLIN, 0};
    const bool ready = poll(&data, 1, wait) > 0;
    const ssize_t size = ready ? read(file.get(), piece.data(), piece.size()) : -1;
    if (size == 0) break;
    if (size > 0) {
      bytes.append(piece.data(), static_cast<std::size_t>(size));
      if (bytes.size() > max_bytes) {
        fail(fmt::format("the file has more than {} MB", max_bytes / 1000000), "no more is read",
             "split it");
      }
      last = Clock::now();
      continue;
    }
    if (ready && errno != EAGAIN && errno != EINTR) fail_to_read();
    end_if_called_off();
    if (Clock::now() - last > patience) {
      fail(fmt::format("no data have arrived for {:.3g} s",
                       std::chrono::duration<double>(patience).count()),
           "it is a pipe or a device", "name a file");
    }
  }
  const std::lock_guard lock(read_files().mutex);
  read_files().files.insert(identity_of(status));
  return bytes;
}

std::string as_text(std::string bytes, const std::filesystem::path& path) {
  if (const auto nul = bytes.find('\0'); nul != std::string::npos) {
    throw InputError({path.string()}, "this is not a text file",
                     fmt::format("byte {} is NUL", nul + 1), "save it as UTF-8 text");
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);  // a byte-order mark says nothing
  return bytes;
}

std::string read_text_file(const std::filesystem::path& path, std::uintmax_t max_bytes,
                           std::chrono::milliseconds patience) {
  return as_text(read_bytes(path, max_bytes, patience), path);
}

InputError cannot_be_written(const std::filesystem::path& path, int failed) {
  return InputError({path.string()}, "the file cannot be written", std::strerror(failed),
                    advice_on(failed));
}

void write_whole_file(const std::filesystem::path& path, std::string_view text,
                      Replacing replacing) {
  write_whole_files({{path, std::string(text)}}, replacing);
}

void write_whole_files(const std::vector<WholeFile>& all, Replacing replacing) {
  std::vector<std::filesystem::path> outputs;
  for (const WholeFile& file : all) outputs.push_back(file.path);
  require_free(outputs, replacing);
  const std::string ending = ".part-" + unpredictable_name();
  std::vector<WholeFile> files, special;
  for (const WholeFile& file : all) {
    (is_special(file.path) ? special : files).push_back({behind_links(file.path), file.text});
  }
  Replacement(std::move(files), ending).run();
  for (const WholeFile& file : special) {
    const int descriptor = open(file.path.c_str(), O_WRONLY | O_CLOEXEC);
    if (const int error = write_to_disk(OpenFile(descriptor), file.text, std::nullopt)) {
      throw cannot_be_written(file.path, error);
    }
  }
}

void require_free(const std::vector<std::filesystem::path>& outputs, Replacing replacing) {
  std::set<std::filesystem::path> places;
  std::set<FileIdentity> files;
  for (const std::filesystem::path& output : outputs) {
    const auto refuse = [&](const std::string& problem, const std::string& suggestion) {
      throw InputError({output.string()}, problem, "", suggestion);
    };
    std::error_code failed;
    const std::filesystem::path place =
        std::filesystem::absolute(output, failed).lexically_normal();
    struct stat file {};
    const bool found = stat(output.c_str(), &file) == 0;
    if (found && S_ISDIR(file.st_mode)) {
      refuse("a folder has the name of this result", "choose another place for the result");
    }
    const bool exists = found && S_ISREG(file.st_mode);
    if (!places.insert(place).second || (exists && !files.insert(identity_of(file)).second)) {
      refuse("two results would have this name", "give one of them another name");
    }
    if (!exists || replacing == Replacing::data) continue;
    if (was_read(file)) {
      refuse("this input file would be overwritten", "choose another place for the result");
    }
    const std::string name = output.filename().string();
    if (name == "points.csv" || name == "datapackage.json") {
      refuse("existing data would be overwritten",
             "choose another place for the result; import, pair and plan have --replace, Python "
             "replace=True");
    }
  }
}

void require_writable_folder(const std::filesystem::path& folder) {
  const Location where{folder.string()};
  std::error_code failed;
  std::filesystem::path nearest = std::filesystem::absolute(folder, failed);
  if (failed) throw cannot_be_written(folder, failed.value());
  while (!std::filesystem::exists(nearest, failed) && nearest.has_relative_path()) {
    nearest = nearest.parent_path();
  }
  if (!std::filesystem::is_directory(nearest, failed)) {
    if (failed) throw cannot_be_written(folder, failed.value());
    throw InputError(where, fmt::format("{} is a file, not a folder", nearest.string()), "",
                     "choose another folder for the results");
  }
  if (access(nearest.c_str(), W_OK) != 0) {
    throw InputError(where, fmt::format("nothing can be written into {}", nearest.string()),
                     std::strerror(errno), "choose another folder for the results");
  }
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                            const std::string& extension) {
  std::vector<std::filesystem::path> files;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string hash_hex(std::string_view algorithm, std::string_view bytes) {
  constexpr std::array<std::pair<std::string_view, char* (*)(const uint8_t*, size_t, char*)>, 4>
      known = {
          {{"md5", MD5Data}, {"sha1", SHA1Data}, {"sha256", SHA256Data}, {"sha512", SHA512Data}}};
  char digest[SHA512_DIGEST_STRING_LENGTH] = "";  // the longest
  for (const auto& [name, compute] : known) {
    if (name != algorithm) continue;
    compute(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), digest);
  }
  return digest;
}

std::string sha256_hex(std::string_view bytes) { return hash_hex("sha256", bytes); }

std::string sha256_of_file(const std::filesystem::path& path) {
  char digest[SHA256_DIGEST_STRING_LENGTH];
  return SHA256File(path.c_str(), digest) == nullptr ? "" : digest;
}

}  // namespace recoil
