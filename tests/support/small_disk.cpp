#include "support/small_disk.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace support {
namespace {

namespace fs = std::filesystem;

bool says(const fs::path& file, const std::string& text) {
  const int opened = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (opened < 0) return false;
  const bool written = write(opened, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(opened);
  return written;
}

/// Mounts of this process and its children alone; as an ordinary user by a namespace of users, too.
bool own_mounts() {
  const std::string user = std::to_string(geteuid());
  const std::string group = std::to_string(getegid());
  if (geteuid() != 0) {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    if (!says("/proc/self/setgroups", "deny") || !says("/proc/self/uid_map", "0 " + user + " 1") ||
        !says("/proc/self/gid_map", "0 " + group + " 1")) {
      return false;
    }
  } else if (unshare(CLONE_NEWNS) != 0) {
    return false;
  }
  return mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

bool mount_memory(const fs::path& at, const char* size) {
  fs::create_directories(at);
  return mount("tmpfs", at.c_str(), "tmpfs", 0, size) == 0;
}

}  // namespace

SmallDisk::SmallDisk() {
  mounted_ = own_mounts() && mount_memory(path() / "place", "size=64k");
  if (mounted_) {
    fs::create_directory(disk());
    mounted_ = mount("tmpfs", (path() / "place").c_str(), nullptr, MS_REMOUNT | MS_RDONLY,
                     "size=64k") == 0 &&
               mount_memory(disk(), "size=4m");
  }
  fs::create_directory(spare());
  EXPECT_TRUE(mounted_) << "a small file system cannot be mounted (" << std::strerror(errno)
                        << "): this test needs root, or namespaces for users";
}

SmallDisk::~SmallDisk() {
  for (const fs::path& at : {disk(), spare(), path() / "place"}) umount2(at.c_str(), MNT_DETACH);
}

void SmallDisk::fill() const {
  const int file = open((disk() / "filler").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const std::string page(4096, 'x');
  while (::write(file, page.data(), page.size()) > 0) continue;
  close(file);
}

void SmallDisk::empty() const { fs::remove(disk() / "filler"); }

void SmallDisk::be_writable(bool writable) const {
  const unsigned long how = writable ? MS_REMOUNT : MS_REMOUNT | MS_RDONLY;
  EXPECT_EQ(mount("tmpfs", disk().c_str(), nullptr, how, "size=4m"), 0) << std::strerror(errno);
}

void SmallDisk::go_away() {
  EXPECT_EQ(mount(disk().c_str(), spare().c_str(), nullptr, MS_BIND, nullptr), 0);
  EXPECT_EQ(umount2(disk().c_str(), MNT_DETACH), 0);
}

void SmallDisk::come_back() {
  EXPECT_EQ(mount(spare().c_str(), disk().c_str(), nullptr, MS_BIND, nullptr), 0);
}

}  // namespace support
