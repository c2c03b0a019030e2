// The study of hidden effects: makes data sets, lets the built command diagnose them, and reports.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "studies/hidden_effects_study.hpp"

namespace {

namespace fs = std::filesystem;

int run(int argc, char** argv) {
  CLI::App app(
      "Hides effects in simulated data, has `recoil diagnose` look for them, and prints how well "
      "it "
      "did (Markdown).");
  hidden::StudySize size;
  std::string keep;
  std::string picture;
  std::string only;
  int threads = 0;
  double minutes = std::numeric_limits<double>::infinity();
  // The command that was built together with this program.
  std::string binary = (fs::read_symlink("/proc/self/exe").parent_path() / "recoil").string();
  app.add_option("--datasets", size.per_cell, "data sets of each effect, design and strength");
  app.add_option("--correct", size.correct, "data sets with nothing hidden");
  app.add_option("--pairs", size.pairs, "data sets of each pair, design and strength");
  app.add_option("--outside", size.outside, "of each outside effect, design and strength");
  app.add_option("--single", size.single, "of each effect and strength with one diameter");
  app.add_option("--careless", size.careless,
                 "of each kind of error that is not stated, and design");
  app.add_option("--only", only, "only orders whose key contains this");
  app.add_option("--keep", keep, "folder for finished answers: a stopped study goes on from there");
  app.add_option("--picture", picture, "write the picture here (SVG)");
  app.add_option("--recoil", binary, "the command to be judged");
  app.add_option("--threads", threads, "diagnoses at the same time (default: all cores)");
  app.add_option("--at-most-minutes", minutes,
                 "begin no further diagnosis after this time and report what is done (0: what is "
                 "kept)");
  app.add_option("--seed", size.seed, "of the data sets");
  CLI11_PARSE(app, argc, argv);

  std::vector<hidden::CaseOrder> orders;
  for (const hidden::CaseOrder& order : hidden::plan_study(size)) {
    if (order.key().find(only) != std::string::npos) orders.push_back(order);
  }
  std::vector<std::optional<hidden::Answered>> asked(orders.size());
  {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const auto late = [&] {
      return std::chrono::duration<double>(Clock::now() - begin).count() >= 60.0 * minutes;
    };
    const recoil::InterruptGuard guard;
    recoil::Progress progress("hidden effects", orders.size());
    std::atomic<std::size_t> next = 0;  // in the order of the plan, whoever is free
    recoil::parallel_over(orders.size(), threads, [&](std::size_t) {
      const std::size_t i = next++;
      if (recoil::stop_requested()) return;
      asked[i] =
          late() ? hidden::kept_answer(orders[i], keep) : hidden::ask(orders[i], binary, keep);
      progress.advance();
    });
  }
  std::vector<hidden::Answered> answers;
  for (const auto& answer : asked) {
    if (answer) answers.push_back(*answer);
  }
  if (recoil::stop_requested()) {
    fmt::print(stderr, "stopped; what is finished is kept{}\n",
               keep.empty() ? " nowhere (--keep FOLDER would)" : " in " + keep);
    return 128 + recoil::stop_signal();
  }
  std::string command = "hidden_effects";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--keep" || word == "--threads" || word == "--recoil") {
      ++i;  // says nothing about the result
    } else {
      command += " " + word;
    }
  }
  fmt::print("{}", hidden::study_report(answers, orders.size(), size, command));
  if (!picture.empty()) recoil::write_whole_file(picture, hidden::study_picture(answers));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "hidden_effects: {}\n", error.what());
    return 3;
  }
}
