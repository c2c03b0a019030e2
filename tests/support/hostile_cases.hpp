#pragma once

#include <atomic>
#include <cstddef>
#include <cstdio>

namespace support {

/// How many hostile inputs a program of tests has tried. It says so at its end; docs/testing.md has
/// the command that adds them up.
class HostileCases {
 public:
  HostileCases() = default;
  HostileCases(const HostileCases&) = delete;
  HostileCases& operator=(const HostileCases&) = delete;
  ~HostileCases() { std::printf("hostile cases: %zu\n", number_.load()); }
  void add(std::size_t more) { number_ += more; }

 private:
  std::atomic<std::size_t> number_ = 0;
};

inline void count_hostile_cases(std::size_t more = 1) {
  static HostileCases cases;
  cases.add(more);
}

}  // namespace support
