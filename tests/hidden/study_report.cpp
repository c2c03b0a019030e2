#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <functional>
#include <map>

#include "study.hpp"

namespace hidden {
namespace {

using Answers = std::vector<const Answered*>;
using Test = std::function<bool(const Answered&)>;

Answers those(const std::vector<Answered>& all, const Test& test) {
  Answers some;
  for (const Answered& a : all) {
    if (a.reached && test(a)) some.push_back(&a);
  }
  return some;
}

int count(const Answers& answers, const Test& test) {
  return static_cast<int>(
      std::count_if(answers.begin(), answers.end(), [&](const Answered* a) { return test(*a); }));
}

Test marked(std::vector<Mark> marks) {
  return [marks](const Answered& a) {
    return std::find(marks.begin(), marks.end(), mark_of(a)) != marks.end();
  };
}

bool is_visible(const Answered& a) { return a.order.signal_to_noise >= visible; }

/// "83 % (73 to 91), 58 of 70": with the 95 % interval of Clopper and Pearson.
std::string share(int k, int n) {
  if (n == 0) return "none";
  const double low = k == 0 ? 0.0 : gsl_cdf_beta_Pinv(0.025, k, n - k + 1.0);
  const double high = k == n ? 1.0 : gsl_cdf_beta_Pinv(0.975, k + 1.0, n - k);
  return fmt::format("{:.0f} % ({:.0f} to {:.0f}), {} of {}", 100.0 * k / n, 100.0 * low,
                     100.0 * high, k, n);
}

struct Bar {
  std::string what;
  double limit;  ///< at least; below zero: at most
  Answers among;
  Test test;
};

std::string bars_table(const std::vector<Bar>& bars) {
  std::string out = "| bar | wanted | found (95 % interval) | |\n|---|---|---|---|\n";
  for (const Bar& bar : bars) {
    const int n = static_cast<int>(bar.among.size());
    const int k = count(bar.among, bar.test);
    const double part = n == 0 ? 0.0 : static_cast<double>(k) / n;
    const bool held = n > 0 && (bar.limit >= 0.0 ? part >= bar.limit : part <= -bar.limit);
    out += fmt::format("| {} | {} {:.0f} % | {} | {} |\n", bar.what, bar.limit >= 0.0 ? "≥" : "≤",
                       100.0 * std::abs(bar.limit), share(k, n),
                       n == 0 ? "not studied"
                       : held ? "holds"
                              : "**fails**");
  }
  return out + "\n";
}

/// Could anybody name it? No other single cause of the catalogue comes closer to it than this.
constexpr double separable = 4.0;
bool can_be_named(const Answered& a) { return a.closest.misfit >= separable; }

std::string bars(const std::vector<Answered>& all) {
  const auto in = [](Chapter chapter) {
    return [chapter](const Answered& a) { return chapter_of(a.order) == chapter; };
  };
  const auto seen = [&](Chapter chapter) {
    return those(all, [&](const Answered& a) { return in(chapter)(a) && is_visible(a); });
  };
  const Answers effects = seen(Chapter::effect);
  Answers nameable;
  for (const Answered* a : effects) {
    if (can_be_named(*a)) nameable.push_back(a);
  }
  const Test found = marked({Mark::named});
  const Test inside = marked({Mark::named, Mark::inside});
  const Test told = [](const Answered& a) {
    return mark_of(a) == Mark::named || (mark_of(a) == Mark::inside && !a.shared_cause.empty());
  };
  const Test wrong = [](const Answered& a) {
    return mark_of(a) == Mark::wrong || (mark_of(a) == Mark::outside && !a.shared_cause.empty());
  };
  const Test not_adequate = [](const Answered& a) { return mark_of(a) != Mark::nothing; };
  return bars_table({
      {"visible effect named outright", 0.80, effects, found},
      {"the same, where the closest other cause leaves a misfit of 4 or more", 0.80, nameable,
       found},
      {"visible effect named, or the cause of which it and all its rivals are laws", 0.80, effects,
       told},
      {"visible effect among named and rivals", 0.95, effects, inside},
      {"wrong cause named, or one shared by laws among which it is not", -0.05, effects, wrong},
      {"false alarms, nothing hidden", -0.05, those(all, in(Chapter::correct)), not_adequate},
      {"outside effect called unexplained", 0.80, seen(Chapter::outside),
       marked({Mark::unexplained})},
      {"one diameter: answered by not_separable", 0.80,
       those(all,
             [](const Answered& a) {
               return chapter_of(a.order) == Chapter::single && !a.order.effects.empty();
             }),
       marked({Mark::inside, Mark::outside})},
  });
}

/// How many of those that were not named nobody could have named.
std::string why_not_named(const std::vector<Answered>& all) {
  int missed = 0, alike = 0, shared = 0;
  for (const Answered& a : all) {
    if (!a.reached || chapter_of(a.order) != Chapter::effect || !is_visible(a)) continue;
    if (mark_of(a) == Mark::named) continue;
    ++missed;
    if (can_be_named(a)) continue;
    ++alike;
    shared += mark_of(a) == Mark::inside && !a.shared_cause.empty() ? 1 : 0;
  }
  return fmt::format(
      "Of the {} visible effects that were not named outright, {} have a neighbour in the "
      "catalogue "
      "that leaves a misfit below {:g} with all its parameters fitted (a table follows); in {} of "
      "these all that is listed are laws of one cause (`shared_cause`: JKR's work, hysteresis per "
      "area and crack rate are adhesion hysteresis; spreads of size and of adhesion are unequal "
      "impacts averaged in one point), which is then told by name.\n\n",
      missed, alike, separable, shared);
}

std::string per_effect(const std::vector<Answered>& all, Chapter chapter) {
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
    if (!a.reached || chapter_of(a.order) != chapter) continue;
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
    if (!a.reached || chapter_of(a.order) != Chapter::effect || a.closest.id.empty()) continue;
    Row& row = rows[{a.order.effects.front(), a.order.signal_to_noise}];
    ++row.ids[a.closest.id];
    row.misfits.push_back(a.closest.misfit);
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

}  // namespace

std::string study_report(const std::vector<Answered>& all, std::size_t planned,
                         const StudySize& size, const std::string& command) {
  std::string out = "# Hidden effects: what the diagnosis finds\n\n";
  out +=
      "Data in which an effect is hidden, made by physics of their own (`tests/hidden`: the "
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
  out += fmt::format("\n\nMade by `{}`.\n\n", command);
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
  out += "## Power against strength, effect by effect\n\n" + per_effect(all, Chapter::effect);
  out +=
      "## Confusion\n\nWhat was answered (several causes named count once each; "
      "`not_separable` by whether the truth is listed).\n\n" +
      confusion_table(all);
  out += "## Nothing hidden\n\n" + false_alarms(all);
  out +=
      "## Two at once\n\nEach as strong as it would be alone.\n\n" + per_effect(all, Chapter::pair);
  out += "## Effects that are not in the catalogue\n\n" + per_effect(all, Chapter::outside);
  out += "## One diameter\n\n" + per_effect(all, Chapter::single);
  out += "## Time\n\n" + times(all);
  out += "## Without an answer\n\n" + complaints(all);
  out += "## Too weak in nature to be made\n\n" + not_reached(all);
  return out;
}

}  // namespace hidden
