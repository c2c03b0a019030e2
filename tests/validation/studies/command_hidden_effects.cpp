// The study of hidden effects: makes data sets, lets the built command diagnose them, and counts.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "validation/studies/commands.hpp"
#include "validation/studies/hidden_effects_page.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

struct HiddenEffectsRun {
  hidden::StudySize size;
  std::string only;
  double minutes = std::numeric_limits<double>::infinity();
  std::string binary;
  bool baseline = false;
  StudyRun run;
};

std::vector<hidden::Answered> answers_to(const std::vector<hidden::CaseOrder>& orders,
                                         const HiddenEffectsRun& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto late = [&] {
    return std::chrono::duration<double>(Clock::now() - begin).count() >= 60.0 * options.minutes;
  };
  std::vector<std::optional<hidden::Answered>> asked(orders.size());
  {
    const InterruptGuard guard;
    Progress progress("hidden effects", orders.size());
    std::atomic<std::size_t> next = 0;  // in the order of the plan, whoever is free
    try {
      parallel_over(orders.size(), options.run.threads, [&](std::size_t) {
        const std::size_t i = next++;
        asked[i] = late()
                       ? hidden::kept_answer(orders[i], options.run.keep)
                       : hidden::ask(orders[i], options.binary, options.run.keep, options.baseline);
        progress.advance();
      });
    } catch (const CalledOff&) {  // by a signal
    }
  }
  if (stop_requested()) {
    throw ComputationError(options.run.keep.empty()
                               ? "stopped; nothing is kept (--keep FOLDER would)"
                               : "stopped; what is finished is kept in " + options.run.keep);
  }
  std::vector<hidden::Answered> answers;
  for (const auto& answer : asked) {
    if (answer) answers.push_back(*answer);
  }
  return answers;
}

void study(const HiddenEffectsRun& options) {
  std::vector<hidden::CaseOrder> orders;
  std::size_t next = 0;
  for (const hidden::CaseOrder& order : hidden::plan_study(options.size)) {
    if (order.key().find(options.only) == std::string::npos) continue;
    if (options.run.owns(next++)) orders.push_back(order);
  }
  const std::vector<hidden::Answered> answers = answers_to(orders, options);
  if (!options.run.shard.empty() && answers.size() < orders.size()) {
    throw ComputationError(fmt::format("{} of {} cases of this shard are left: run it again",
                                       orders.size() - answers.size(), orders.size()));
  }
  if (wrote_part(options.run)) return;
  hidden::StudyTally tally = hidden::tally_of(answers, orders.size(), options.size);
  tally.stamp = options.run.stamp();
  publish(options.run, study_json(tally), hidden::hidden_effects_page(tally));
}

}  // namespace

void add_hidden_effects(CLI::App& program, const std::string& words) {
  CLI::App* command = program.add_subcommand(
      "hidden-effects",
      "hides effects in simulated data, has recoil diagnose look for them, and counts its answers");
  const auto options = std::make_shared<HiddenEffectsRun>();
  options->run.command = words;
  // The command that was built together with this program.
  options->binary = (fs::read_symlink("/proc/self/exe").parent_path() / "recoil").string();
  hidden::StudySize& size = options->size;
  command->add_option("--datasets", size.per_cell, "of each effect, design and strength");
  command->add_option("--correct", size.correct, "with nothing hidden");
  command->add_option("--pairs", size.pairs, "of each pair, design and strength");
  command->add_option("--outside", size.outside, "of each outside effect, design and strength");
  command->add_option("--single", size.single, "of each effect and strength with one diameter");
  command->add_option("--careless", size.careless,
                      "of each kind of error that is not stated, and design");
  command->add_option("--bent", size.bent,
                      "of each effect, design and visible strength, by a law bent by 10 % (half as "
                      "many by 20 %)");
  command->add_option("--other-law", size.other_law,
                      "of each effect with a second published law, design and visible strength");
  command->add_option("--base-bent", size.base_bent,
                      "with nothing hidden and the losses of the base model bent by 3 %");
  command->add_option("--impossible", size.impossible,
                      "of each effect and design, at three times what nature has");
  command->add_option("--conditions", size.conditions,
                      "of each effect that a condition takes away, design and visible strength, "
                      "with its condition stated and again varied");
  command->add_option("--loop", size.loop,
                      "of each effect, design and visible strength, asked again after doing what "
                      "the answer advises, three times at most");
  command->add_option("--dropped", size.dropped,
                      "of each effect of drops of spheres of millimetres and visible strength; six "
                      "times as many with heights set wrong, and with nothing hidden");
  command->add_option("--rounded", size.rounded,
                      "of each step of reading, design of drops and effect: heights or times of "
                      "flight that are read to a finite step");
  command->add_option("--odd", size.odd, "of each design, with a few points misread");
  command->add_option("--only", options->only, "only orders whose key contains this");
  command->add_flag("--baseline", options->baseline,
                    "also ask stepwise AICc and the correlation with a Gaussian process, 40 fits "
                    "each");
  command->add_option("--recoil", options->binary, "the command to be judged");
  command->add_option("--at-most-minutes", options->minutes,
                      "begin no further diagnosis after this time and report what is done (0: what "
                      "is kept)");
  command->add_option("--seed", size.seed, "of the data sets");
  add_run_options(*command, options->run);
  add_shard_option(*command, options->run);
  command->callback([options] { study(*options); });
}

}  // namespace recoil
