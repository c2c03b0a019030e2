#include "validation/studies/diagnosis_answer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <set>
#include <utility>

#include "core/files.hpp"
#include "core/json.hpp"
#include "validation/studies/child.hpp"
#include "validation/studies/hidden_effects_plan.hpp"
#include "validation/synthetic/case.hpp"

namespace recoil::hidden {
namespace {

namespace fs = std::filesystem;

fs::path kept_file(const CaseOrder& order, const fs::path& keep) {
  return keep / (neutral_name(order) + ".json");
}

/// The first of what the answer advises to do next; of no events where it advises nothing.
FurtherImpacts advice_of(const Json& answer) {
  FurtherImpacts further;
  const Json& all = answer.at("next_experiment");
  const auto here = std::find_if(all.begin(), all.end(),
                                 [](const Json& next) { return next.at("kind") != "target"; });
  if (here == all.end()) return further;
  const Json& first = *here;
  further.diameter = 1e-6 * first.at("diameter_um").get<double>();
  further.velocity = first.at("incident_velocity");
  further.events = first.at("events");
  if (first.at("kind") == "condition") {
    further.changed = {first.at("condition"), first.at("value")};
  }
  return further;
}

void count_odd_points(const Case& made, const Json& answer, Answered& a) {
  std::set<std::size_t> aside;
  for (const Json& point : answer.at("outlying_points")) {
    aside.insert(point.at("row").get<std::size_t>() -
                 2);  // lines count from 1, the first is a header
  }
  a.odd = a.odd_found = a.right = a.accused = 0;
  for (std::size_t i = 0; i < made.odd.size(); ++i) {
    const int listed = aside.contains(i) ? 1 : 0;
    (made.odd[i] ? a.odd : a.right) += 1;
    (made.odd[i] ? a.odd_found : a.accused) += listed;
  }
}

/// @return what the answer advises to do next
FurtherImpacts diagnose(const Case& made, const fs::path& binary, Answered& a) {
  const ScratchFolder scratch;
  const fs::path fit = write_case(made, scratch.path());
  const fs::path out = scratch.path() / "answer";
  const auto start = std::chrono::steady_clock::now();
  const ChildOutcome run = run_child({binary.string(), "diagnose", fit.string(), "--out",
                                      out.string(), "--threads", "1", "--seed", "20260101"},
                                     "", std::chrono::hours(24));
  a.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  a.status = run.failed == 0 ? run.status : -1;
  if (a.status != 0) {
    a.complaint = run.failed == 0 ? run.err.substr(0, 400) : "cannot be started";
    return {};
  }
  std::ifstream in(out / "diagnosis.json");
  const Json answer = Json::parse(in);
  a.verdict = answer.at("verdict");
  a.p_value = answer.at("misfit").at("p_value");
  a.named = answer.at("named").get<std::vector<std::string>>();
  a.rivals = answer.at("rivals").get<std::vector<std::string>>();
  a.resembles = answer.at("resembles").get<std::vector<std::string>>();
  a.certain = answer.at("in_every_explanation").get<std::vector<std::string>>();
  a.shared_cause = answer.at("shared_cause").is_string() ? answer["shared_cause"] : "";
  const Json& exact = answer.at("if_exact");
  a.hint = !exact.is_null() && exact.at("p_value") <= answer.at("settings").at("level");
  a.hinted =
      a.hint ? exact.at("listed").get<std::vector<std::string>>() : std::vector<std::string>();
  a.exact_named =
      a.hint ? exact.at("named").get<std::vector<std::string>>() : std::vector<std::string>();
  a.errors_told = false;
  for (const auto& errors : answer.at("unstated_errors")) {
    a.errors_told = a.errors_told || errors.at("rival").get<bool>();
  }
  count_odd_points(made, answer, a);
  return advice_of(answer);
}

/// Asks, and does what is advised, until a cause is certain or nothing is advised.
void diagnose_in_rounds(Case made, const fs::path& binary, Answered& a) {
  FurtherImpacts further = diagnose(made, binary, a);
  while (a.rounds < a.order.rounds && a.verdict != "cause_named" && a.shared_cause.empty() &&
         further.events > 0) {
    take_further(made, further, static_cast<std::uint64_t>(a.rounds));
    ++a.rounds;
    a.events += further.events;
    a.taken.push_back(further);
    further = diagnose(made, binary, a);
  }
}

}  // namespace

Mark mark_of(const Answered& a) {
  if (a.status != 0) return Mark::failed;
  if (a.verdict == "adequate") return Mark::nothing;
  const std::set<std::string> truth(a.order.effects.begin(), a.order.effects.end());
  if (a.verdict == "unexplained") {
    const bool recognised = std::any_of(a.resembles.begin(), a.resembles.end(),
                                        [&](const auto& id) { return truth.contains(id); });
    return recognised ? Mark::resembled : Mark::unexplained;
  }
  const std::set<std::string> named(a.named.begin(), a.named.end());
  std::set<std::string> listed = named;
  listed.insert(a.rivals.begin(), a.rivals.end());
  const auto within = [](const std::set<std::string>& part, const std::set<std::string>& whole) {
    return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
  };
  if (a.verdict == "not_separable") {
    return !truth.empty() && within(truth, listed) ? Mark::inside : Mark::outside;
  }
  if (named == truth) return Mark::named;
  return within(named, truth) ? Mark::part : Mark::wrong;
}

std::optional<Answered> kept_answer(const CaseOrder& order, const fs::path& keep) {
  if (keep.empty()) return {};
  std::ifstream in(kept_file(order, keep));
  const Json kept = in ? Json::parse(in, nullptr, false) : Json();
  if (!kept.is_object() || kept.value("order", Json()) != as_json(order)) return {};
  return value_from<Answered>(kept);
}

namespace {

/// The case as it was when the last answer was given, the further points without noise, too.
Case with_what_was_taken(Case made, const Answered& a) {
  for (std::size_t k = 0; k < a.taken.size(); ++k) {
    const std::size_t before = made.points.size();
    take_further(made, a.taken[k], k);
    if (made.points.size() == before) continue;
    Point& last = made.points.back();
    const Effects effects = under(last.changed, made.effects);
    const Expected e = expected_point(made.design.base, effects, made.design.scatter, last.velocity,
                                      last.diameter, last.row);
    if (last.restitution > 0.0 && e.restitution > 0.0) last.restitution = e.restitution;
  }
  return made;
}

/// Of these an ideal judge is asked what can be seen, and of the last ones what can be named, too.
bool is_judged(Arm arm) {
  return arm == Arm::single || arm == Arm::bent || arm == Arm::other_law || arm == Arm::effect ||
         arm == Arm::loop;
}
bool is_judged_with_rivals(Arm arm) { return arm == Arm::effect || arm == Arm::loop; }

}  // namespace

Answered ask(const CaseOrder& order, const fs::path& binary, const fs::path& keep, bool baseline) {
  std::optional<Answered> kept = kept_answer(order, keep);
  const Arm arm = arm_of(order);
  const bool seen = order.signal_to_noise >= visible && is_judged(arm);
  if (kept && (!seen || !kept->reached || kept->ideal)) return *std::move(kept);
  const Case made = make_case(order);
  Answered a;
  if (kept) {
    a = *std::move(kept);
  } else {
    a.order = order;
    a.reached = made.reached;
    a.signal_to_noise = made.refit.signal_to_noise;
    if (made.reached) diagnose_in_rounds(made, binary, a);
    const bool compared =
        (seen && arm == Arm::effect) || (arm == Arm::correct && order.index % 4 == 0);
    if (made.reached && baseline && compared) a.baseline = baseline_answers(made);
  }
  if (made.reached && seen) {
    a.ideal.emplace(ideal_judge(with_what_was_taken(made, a), is_judged_with_rivals(arm)));
  }
  // A diagnosis that a signal ended (Ctrl-C reaches it too) has answered nothing.
  const bool answered = a.status >= 0 && a.status < 128;
  if (!keep.empty() && answered) {
    write_whole_file(kept_file(order, keep), json_text(as_json(a, NonFinite::word)),
                     Replacing::data);
  }
  return a;
}

}  // namespace recoil::hidden
