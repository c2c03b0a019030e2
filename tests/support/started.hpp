#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace support {

/// The `recoil` that was built with these tests, started in `folder`, while the test does something
/// else.
class Started {
 public:
  Started(std::vector<std::string> arguments, const std::filesystem::path& folder);
  /// Kills it where it still runs.
  ~Started();
  Started(const Started&) = delete;
  Started& operator=(const Started&) = delete;

  void send(int signal) const;
  bool runs();
  /// Waits until `happened`, a minute at most, as long as it runs. @return whether it happened
  bool wait_until(const std::function<bool()>& happened);
  /// Waits until it has worked for so long: processor time, whatever else the machine does.
  bool wait_until_worked(std::chrono::milliseconds time);
  /// Waits until it handles `signal` itself.
  bool wait_until_it_catches(int signal);
  /// Waits for its end. The status of one that a signal ended is 128 and the signal.
  Outcome end();
  /// The signal that ended it; 0 if it ended by itself. @pre it has ended
  int signal() const;

 private:
  TemporaryFolder outputs_;
  pid_t child_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace support
