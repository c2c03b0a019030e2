#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <utility>

namespace recoil {

/// Shows progress on standard error: a bar on a terminal, and in a pipe one line after
/// `Pace::first` and then one per `Pace::next`. `advance` may be called from any thread.
class Progress {
 public:
  /// Shows progress in this process. A program calls it; without it, the library is silent.
  static void show_in_this_process();

  /// Shows no progress that this thread starts during the lifetime of a `Silence`.
  class Silence {
   public:
    explicit Silence(bool silent = true);
    ~Silence();
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

   private:
    bool before_;
  };

  struct Pace {
    std::chrono::milliseconds first = std::chrono::seconds(10);
    std::chrono::milliseconds next = std::chrono::minutes(1);
  };

  Progress(std::string label, std::size_t total) : Progress(std::move(label), total, Pace()) {}
  Progress(std::string label, std::size_t total, Pace pace);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::size_t steps = 1);

 private:
  void draw(std::size_t done, double left) const;

  std::string label_;
  std::size_t total_;
  bool silent_;
  bool terminal_;
  Pace pace_;
  std::atomic<std::size_t> done_{0};
  std::mutex drawing_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point due_;  ///< of the next drawing
};

}  // namespace recoil
