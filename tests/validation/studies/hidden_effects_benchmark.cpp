#include "validation/studies/hidden_effects_benchmark.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <string>
#include <utility>

#include "core/files.hpp"
#include "core/parallel.hpp"
#include "validation/studies/hidden_effects_tally.hpp"

namespace recoil::hidden {
namespace {

using Ids = std::vector<std::string>;

std::string ids_text(const Ids& ids) { return fmt::format("{}", fmt::join(ids, " ")); }

/// Visible, and in a design in which it counts: the data sets of the bar "named".
bool is_counted(const Answered& a) {
  return arm_of(a.order) == Arm::effect && a.order.signal_to_noise >= visible;
}

std::string truth_row(const Answered& a) {
  const bool known = is_counted(a) && a.ideal;
  return fmt::format("{},{},{},{},{:g},{},{}\n", neutral_name(a.order), ids_text(a.order.effects),
                     name_of(arm_of(a.order)), a.order.design, a.order.signal_to_noise,
                     is_counted(a) ? 1 : 0,
                     known ? fmt::format("{:.4f}", a.ideal->rival.nameable()) : "");
}

/// What one method answers: the causes that it names, and those that it lists.
using Method = std::function<std::pair<Ids, Ids>(const Answered&)>;

void write_answers(const std::vector<const Answered*>& cases, const std::filesystem::path& file,
                   const Method& method) {
  std::string text = "case,named,listed\n";
  for (const Answered* a : cases) {
    const auto [named, listed] = method(*a);
    text += fmt::format("{},{},{}\n", neutral_name(a->order), ids_text(named), ids_text(listed));
  }
  write_whole_file(file, text, Replacing::data);
}

}  // namespace

void write_benchmark(const std::vector<Answered>& answers, const std::filesystem::path& folder,
                     int threads) {
  std::vector<const Answered*> cases;
  std::vector<const Answered*> asked;
  for (const Answered& a : answers) {
    if (!a.reached || a.order.rounds > 0) continue;
    cases.push_back(&a);
    if (a.baseline.has_value()) asked.push_back(&a);
  }
  std::string truth = "case,hidden,arm,design,signal_to_noise,counted,nameable\n";
  for (const Answered* a : cases) truth += truth_row(*a);
  write_whole_file(folder / "truth" / "truth.csv", truth, Replacing::data);
  write_answers(cases, folder / "answers" / "recoil.csv",
                [](const Answered& a) { return std::pair(a.named, a.rivals); });
  if (!asked.empty()) {
    write_answers(asked, folder / "answers" / "stepwise.csv",
                  [](const Answered& a) { return std::pair(a.baseline->stepwise, Ids()); });
    write_answers(asked, folder / "answers" / "gaussian-process.csv", [](const Answered& a) {
      const std::string& id = a.baseline->correlated;
      return std::pair(id.empty() ? Ids() : Ids{id}, Ids());
    });
  }
  parallel_over(cases.size(), threads,
                [&](std::size_t i) { write_case(make_case(cases[i]->order), folder / "cases"); });
}

}  // namespace recoil::hidden
