#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "document/markdown.hpp"
#include "studies/hidden_counts.hpp"

namespace hidden {
namespace {

std::string per_effect(const std::vector<Answered>& all, Arm arm) {
  std::string out = "| hidden | designs | " +
                    std::string("snr | named | one of several | listed | wrong | ") +
                    "not listed | unexplained | adequate | no answer | n "
                    "|\n|---|---|---|---|---|---|---|---|---|---|"
                    "---|---|\n";
  struct Row {
    std::map<std::string, int> designs;
    std::map<Mark, int> marks;
    int n = 0;
  };
  std::map<std::pair<std::string, double>, Row> rows;
  for (const Answered& a : all) {
    if (!a.reached || arm_of(a.order) != arm) continue;
    std::string name;
    for (const std::string& effect : a.order.effects) name += (name.empty() ? "" : " + ") + effect;
    Row& row = rows[{name.empty() ? "nothing" : name, a.order.signal_to_noise}];
    ++row.designs[a.order.design];
    ++row.marks[mark_of(a)];
    ++row.n;
  }
  for (auto& [key, row] : rows) {
    std::string designs;
    for (const auto& [design, n] : row.designs) {
      designs += fmt::format("{}{} {}", designs.empty() ? "" : ", ", design, n);
    }
    out += fmt::format("| {} | {} | {:g} ", key.first, designs, key.second);
    for (const Mark mark : {Mark::named, Mark::part, Mark::inside, Mark::wrong, Mark::outside,
                            Mark::unexplained, Mark::nothing, Mark::failed}) {
      const int k = row.marks[mark];
      out += k == 0 ? std::string("| ") : fmt::format("| {} ", k);
    }
    out += fmt::format("| {} |\n", row.n);
  }
  return out + "\n";
}

std::string neighbours(const std::vector<Answered>& all) {
  struct Row {
    std::map<std::string, int> ids;
    std::vector<double> misfits;
  };
  std::map<std::pair<std::string, double>, Row> rows;
  for (const Answered& a : all) {
    if (!a.reached || arm_of(a.order) != Arm::effect || a.nearest_rival.id.empty()) continue;
    Row& row = rows[{a.order.effects.front(), a.order.signal_to_noise}];
    ++row.ids[a.nearest_rival.id];
    row.misfits.push_back(a.nearest_rival.misfit);
  }
  std::string out =
      "| hidden | snr | closest other cause | misfit it leaves: least, median |\n"
      "|---|---|---|---|\n";
  for (auto& [key, row] : rows) {
    std::string ids;
    for (const auto& [id, n] : row.ids)
      ids += fmt::format("{}{} {}", ids.empty() ? "" : ", ", id, n);
    std::sort(row.misfits.begin(), row.misfits.end());
    out += fmt::format("| {} | {:g} | {} | {:.1f}, {:.1f} |\n", key.first, key.second, ids,
                       row.misfits.front(), row.misfits[row.misfits.size() / 2]);
  }
  return out + "\n";
}

std::string confusion_table(const std::vector<Answered>& all) {
  const Confusion c = confusion_of(all);
  std::string out = "| hidden \\ answered |";
  for (const std::string& column : c.columns) out += " " + column + " |";
  out += "\n|---|";
  for (std::size_t k = 0; k < c.columns.size(); ++k) out += "---|";
  out += "\n";
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    out += "| " + c.rows[r] + " |";
    for (const int n : c.counts[r]) out += n == 0 ? " |" : fmt::format(" {} |", n);
    out += "\n";
  }
  return out + "\n";
}

std::string not_reached(const std::vector<Answered>& all) {
  std::map<std::pair<std::string, std::string>, std::map<double, std::pair<int, double>>> cells;
  for (const Answered& a : all) {
    if (a.reached || a.order.effects.size() != 1) continue;
    auto& cell = cells[{a.order.effects.front(), a.order.design}][a.order.signal_to_noise];
    ++cell.first;
    cell.second = std::max(cell.second, a.signal_to_noise);
  }
  std::string out =
      "| effect | design | data sets not made, by wanted snr | largest snr met "
      "|\n|---|---|---|---|\n";
  for (const auto& [key, by_strength] : cells) {
    std::string list;
    double largest = 0.0;
    for (const auto& [strength, cell] : by_strength) {
      list += fmt::format("{}{:g}: {}", list.empty() ? "" : ", ", strength, cell.first);
      largest = std::max(largest, cell.second);
    }
    out += fmt::format("| {} | {} | {} | {:.1f} |\n", key.first, key.second, list, largest);
  }
  return out + "\n";
}

std::string false_alarms(const std::vector<Answered>& all) {
  std::string out = "| design | verdict other than adequate | p below 5 % |\n|---|---|---|\n";
  for (const std::string_view design : design_ids()) {
    const Answers of = those(all, [&](const Answered& a) {
      return a.order.design == design && a.order.effects.empty();
    });
    const int n = static_cast<int>(of.size());
    const auto alarm = [](const Answered& a) { return mark_of(a) != Mark::nothing; };
    const auto low = [](const Answered& a) { return a.p_value < 0.05; };
    out += fmt::format("| {} | {} | {} |\n", design, share(count(of, alarm), n),
                       share(count(of, low), n));
  }
  return out + "\n";
}

std::string times(const std::vector<Answered>& all) {
  std::vector<double> seconds;
  for (const Answered& a : all) {
    if (a.reached) seconds.push_back(a.seconds);
  }
  if (seconds.empty()) return "No diagnosis was made.\n\n";
  std::sort(seconds.begin(), seconds.end());
  const auto quantile = [&](double q) {
    return seconds[static_cast<std::size_t>(q * static_cast<double>(seconds.size() - 1))];
  };
  return fmt::format(
      "One diagnosis on one thread, others at work beside it: median {:.1f} s, nine of ten below "
      "{:.1f} s, longest {:.1f} s; {} diagnoses.\n\n",
      quantile(0.5), quantile(0.9), seconds.back(), seconds.size());
}

std::string complaints(const std::vector<Answered>& all) {
  std::string out;
  for (const Answered& a : all) {
    if (a.reached && a.status != 0) {
      out += fmt::format("- `{}`: exit status {}: {}\n", a.order.key(), a.status, a.complaint);
    }
  }
  return out.empty() ? "Every diagnosis gave an answer.\n\n" : out + "\n";
}

std::string careless_words(const std::vector<Answered>& all) {
  const Test told = [](const Answered& a) { return a.errors_told; };
  const Answers seen = those(all, [](const Answered& a) {
    return arm_of(a.order) == Arm::careless && a.verdict != "adequate";
  });
  const Answers effects =
      those(all, [](const Answered& a) { return arm_of(a.order) == Arm::effect && is_visible(a); });
  return fmt::format(
      "Nothing hidden, but the printed velocities are 3 % off, each by itself (`velocities`), or "
      "the stated standard deviations are two thirds of the true ones (`deviations`). To name a "
      "cause would be wrong; `unexplained` with a word on such errors is right. That word was "
      "there in {} of those in which structure was seen; of the visible effects of the catalogue, "
      "where it leads astray, in {}.\n\n",
      share(count(seen, told), static_cast<int>(seen.size())),
      share(count(effects, told), static_cast<int>(effects.size())));
}

}  // namespace

std::string study_report(const std::vector<Answered>& all, std::size_t planned,
                         const StudySize& size, const recoil::StudyStamp& stamp) {
  std::string out = "# Hidden effects: what the diagnosis finds\n\n";
  out +=
      "Data in which an effect is hidden, made by physics of their own (`src/studies/synthetic`: "
      "the "
      "contact "
      "in time with explicit forces, 40 or 100 noisy events per point, values printed as in a "
      "table's columns), and diagnosed by the built command, which sees the dataset folder and a "
      "fit "
      "file. Strength is the signal-to-noise of the misfit that is left when the base model has "
      "been refitted, sqrt(sum ((e - e_base) / sd)^2) on data without noise; from 10 on it counts "
      "as visible. Designs: `wall` 4 diameters x 15 velocities, `wall-batches` 4 x 2 batches x 8, "
      "`li` 4 x 15 steel spheres, and with one diameter `wall-one` 1 x 15 and `dahneke` 1 x 20. "
      "Every strength lies within what nature or a careful experimenter has; what would need more "
      "is "
      "not made, and listed at the end.\n\n";
  out += fmt::format("Seed {}; {} data sets, {} of them made.", size.seed, all.size(),
                     those(all, [](const Answered&) { return true; }).size());
  if (all.size() < planned) {
    out += fmt::format(
        " **{} were planned**: the study was ended before the others were tried. They stood in "
        "shuffled order, so that those that were tried are a fair sample of all.",
        planned);
  }
  out += "\n\n" + recoil::markdown_of(recoil::stamp_blocks(stamp));
  out +=
      "## The bars\n\nDesigns with several diameters, snr 10 and more, unless said "
      "otherwise.\n\n" +
      bars(all);
  out += why_not_named(all) + "![Power and confusion](hidden-effects.svg)\n\n";
  out +=
      "Whether an effect can be named at all depends on its neighbours in the catalogue: "
      "`probe_plane` and `electrostatic_image` (a charge that grows as d²) take the same from v² "
      "at "
      "every velocity and size, and no data on one target tell them apart. So the other mechanisms "
      "were fitted to each visible case without noise; the closest one leaves the misfit stated "
      "here, and where that is small an honest answer lists both. (The spreads of size and of "
      "adhesion, slow to fit, were tried on one another and on what else happens near "
      "capture.)\n\n" +
      neighbours(all);
  out +=
      "## The threshold\n\nCauses whose criteria (AICc) differ by less than 4 are called rivals. "
      "The same answers under other rules, visible effects in designs of several diameters; at 0 "
      "the best explanation is always named. Here the limits of what is possible are taken as "
      "sharp; "
      "the bars above are those of the diagnosis, where what lies just beyond them blocks a "
      "name:\n\n" +
      other_thresholds(all);
  out += "## Power against strength, effect by effect\n\n" + per_effect(all, Arm::effect);
  out +=
      "## Confusion\n\nWhat was answered (several causes named count once each; "
      "`not_separable` by whether the truth is listed).\n\n" +
      confusion_table(all);
  out += "## Nothing hidden\n\n" + false_alarms(all);
  out += "## Two at once\n\nEach as strong as it would be alone.\n\n" + per_effect(all, Arm::pair);
  out += "## Effects that are not in the catalogue\n\n" + per_effect(all, Arm::outside);
  out += "## Errors that nobody stated\n\n" + careless_words(all) + per_effect(all, Arm::careless);
  out += "## One diameter\n\n" + per_effect(all, Arm::single);
  out += "## Time\n\n" + times(all);
  out += "## Without an answer\n\n" + complaints(all);
  out += "## Too weak in nature to be made\n\n" + not_reached(all);
  return out;
}

}  // namespace hidden
