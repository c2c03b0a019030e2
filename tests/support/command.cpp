#include "support/command.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/temporary_folder.hpp"

namespace support {

Outcome run_command(std::vector<std::string> words, const std::filesystem::path& folder) {
  const TemporaryFolder kept;
  const std::string out = kept / "out";
  const std::string err = kept / "err";
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_RDONLY), 0);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    if (chdir(folder.c_str()) != 0) _exit(127);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Outcome result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = text_of(out);
  result.err = text_of(err);
  return result;
}

Outcome run_recoil(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  std::vector<std::string> words = {RECOIL_BINARY};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_command(std::move(words), folder);
}

}  // namespace support
