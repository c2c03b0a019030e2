#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/statistics.hpp"
#include "studies/hidden_counts.hpp"
#include "uncertainty/intervals.hpp"

namespace hidden {

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

std::string share(int k, int n) {
  if (n == 0) return "none";
  const recoil::ShareLimits limits = recoil::share_limits(k, n);
  return fmt::format("{:.0f} % ({:.0f} to {:.0f}), {} of {}", 100.0 * k / n, 100.0 * limits.lower,
                     100.0 * limits.upper, k, n);
}

namespace {

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
bool can_be_named(const Answered& a) { return a.nearest_rival.misfit >= separable; }

}  // namespace

std::string bars(const std::vector<Answered>& all) {
  const auto in = [](Arm arm) {
    return [arm](const Answered& a) { return arm_of(a.order) == arm; };
  };
  const auto seen = [&](Arm arm) {
    return those(all, [&](const Answered& a) { return in(arm)(a) && is_visible(a); });
  };
  const Answers effects = seen(Arm::effect);
  Answers nameable;
  for (const Answered* a : effects) {
    if (can_be_named(*a)) nameable.push_back(a);
  }
  const Answers careless = those(all, in(Arm::careless));
  const Answers careless_seen = those(
      all, [&](const Answered& a) { return in(Arm::careless)(a) && a.verdict != "adequate"; });
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
      {"false alarms, nothing hidden", -0.05, those(all, in(Arm::correct)), not_adequate},
      {"outside effect called unexplained", 0.80, seen(Arm::outside), marked({Mark::unexplained})},
      {"errors that nobody stated: a cause named", -0.05, careless,
       [](const Answered& a) { return a.verdict == "cause_named"; }},
      {"the same, where structure is seen: told that such errors would do", 0.80, careless_seen,
       [](const Answered& a) { return a.errors_told; }},
      {"one diameter: answered by not_separable", 0.80,
       those(all,
             [](const Answered& a) {
               return arm_of(a.order) == Arm::single && !a.order.effects.empty();
             }),
       marked({Mark::inside, Mark::outside})},
  });
}

std::string why_not_named(const std::vector<Answered>& all) {
  int missed = 0, alike = 0, shared = 0;
  for (const Answered& a : all) {
    if (!a.reached || arm_of(a.order) != Arm::effect || !is_visible(a)) continue;
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

std::string other_thresholds(const std::vector<Answered>& all) {
  const Answers effects =
      those(all, [](const Answered& a) { return arm_of(a.order) == Arm::effect && is_visible(a); });
  std::string out =
      "| rivals within | named outright | wrong cause named | among named and rivals "
      "|\n|---|---|---|---|\n";
  const int n = static_cast<int>(effects.size());
  std::string both;
  for (const double margin : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 9.0}) {
    const auto marked_so = [&](std::vector<Mark> marks) {
      return count(effects, [&](const Answered& a) {
        return std::find(marks.begin(), marks.end(), mark_with_margin(a, margin)) != marks.end();
      });
    };
    const int named = marked_so({Mark::named});
    const int wrong = marked_so({Mark::wrong});
    out += fmt::format("| {:g} | {} | {} | {} |\n", margin, share(named, n), share(wrong, n),
                       share(marked_so({Mark::named, Mark::inside}), n));
    if (named >= 0.8 * n && wrong <= 0.05 * n) both += fmt::format(" {:g}", margin);
  }
  return out + (both.empty()
                    ? "\nNo threshold names 80 % outright with at most 5 % wrong.\n\n"
                    : fmt::format("\n80 % named outright with at most 5 % wrong: at{}.\n\n", both));
}

}  // namespace hidden
