#pragma once

#include <filesystem>
#include <string>

#include "support/workplace.hpp"

namespace support {

/// A workplace with a small file system of its own in `disk`, which can be filled, made read-only
/// and taken away. Nobody but this process and those that it starts sees it. Fails the test where
/// the system allows no such thing: that takes root, or namespaces for users.
class SmallDisk : public Workplace {
 public:
  SmallDisk();
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_mounted() const { return mounted_; }
  /// Leaves room for less than a page of the memory that the file system is made of.
  void fill() const;
  /// Makes room again.
  void empty() const;
  void be_writable(bool writable) const;
  /// The folder `disk` is there afterwards, is empty, and nothing can be written into it.
  void go_away();
  /// With everything that was in it.
  void come_back();

 private:
  std::filesystem::path disk() const { return path() / "place/disk"; }
  std::filesystem::path spare() const { return path() / "spare"; }

  bool mounted_ = false;
};

}  // namespace support
