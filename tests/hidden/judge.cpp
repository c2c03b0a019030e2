#include "judge.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/files.hpp"
#include "program_run.hpp"
#include "study.hpp"

namespace hidden {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json to_json(const Answered& a) {
  Json contenders = Json::array();
  for (const Contender& c : a.contenders) contenders.push_back({c.id, c.behind});
  return {{"key", a.order.key()},
          {"seed", a.order.seed},
          {"reached", a.reached},
          {"signal_to_noise", a.signal_to_noise},
          {"status", a.status},
          {"complaint", a.complaint},
          {"seconds", a.seconds},
          {"verdict", a.verdict},
          {"p_value", a.p_value},
          {"named", a.named},
          {"rivals", a.rivals},
          {"certain", a.certain},
          {"shared_cause", a.shared_cause},
          {"errors_told", a.errors_told},
          {"contenders", contenders},
          {"closest", a.closest.id},
          {"closest_misfit", a.closest.misfit}};
}

fs::path kept_file(const CaseOrder& order, const fs::path& keep) {
  return keep / (neutral_name(order) + ".json");
}

/// @return whether there was a kept answer to this order
bool load(const fs::path& file, Answered& a) {
  std::ifstream in(file);
  if (!in) return false;
  const Json kept = Json::parse(in, nullptr, false);
  if (kept.is_discarded() || kept.value("key", "") != a.order.key() ||
      kept.value("seed", std::uint64_t{0}) != a.order.seed) {
    return false;
  }
  a.reached = kept["reached"];
  a.signal_to_noise = kept["signal_to_noise"];
  a.status = kept["status"];
  a.complaint = kept["complaint"];
  a.seconds = kept["seconds"];
  a.verdict = kept["verdict"];
  a.p_value = kept["p_value"];
  a.named = kept["named"].get<std::vector<std::string>>();
  a.rivals = kept["rivals"].get<std::vector<std::string>>();
  a.certain = kept.value("certain", std::vector<std::string>());
  a.shared_cause = kept["shared_cause"];
  a.errors_told = kept.value("errors_told", false);
  for (const Json& c : kept["contenders"]) a.contenders.push_back({c[0], c[1]});
  a.closest = {kept["closest"], kept["closest_misfit"]};
  return true;
}

/// Of `candidates` (the best first), the first that explains the data and those behind it that are
/// possible.
std::vector<Contender> contenders_of(const Json& candidates) {
  constexpr double far_behind = 30.0;
  std::vector<Contender> found;
  double best = 0.0;
  for (const Json& c : candidates) {
    const double criterion = c.at("delta_aicc");
    const bool possible = c.at("plausible") && c.at("kind") != "description" && criterion < 0.0;
    if (found.empty() && c.at("aside").is_null()) best = criterion;
    if (found.empty() ? c.at("aside").is_null() : possible && criterion < best + far_behind) {
      found.push_back({c.at("id"), criterion - best});
    }
  }
  return found;
}

void diagnose(const Case& made, const fs::path& binary, Answered& a) {
  const ScratchFolder scratch;
  const fs::path fit = write_case(made, scratch.path());
  const fs::path out = scratch.path() / "answer";
  const ProgramRun run = run_program({binary.string(), "diagnose", fit.string(), "--out",
                                      out.string(), "--threads", "1", "--seed", "20260101"});
  a.status = run.status;
  a.seconds = run.seconds;
  if (run.status != 0) {
    a.complaint = run.complaint.substr(0, 400);
    return;
  }
  std::ifstream in(out / "diagnosis.json");
  const Json answer = Json::parse(in);
  a.verdict = answer.at("verdict");
  a.p_value = answer.at("misfit").at("p_value");
  a.named = answer.at("named").get<std::vector<std::string>>();
  a.rivals = answer.at("rivals").get<std::vector<std::string>>();
  a.certain = answer.at("in_every_explanation").get<std::vector<std::string>>();
  if (answer.at("shared_cause").is_string()) a.shared_cause = answer["shared_cause"];
  for (const auto& errors : answer.at("unstated_errors")) {
    a.errors_told = a.errors_told || errors.at("rival").get<bool>();
  }
  a.contenders = contenders_of(answer.at("candidates"));
}

}  // namespace

Mark mark_of(const Answered& a) {
  if (a.status != 0) return Mark::failed;
  if (a.verdict == "adequate") return Mark::nothing;
  if (a.verdict == "unexplained") return Mark::unexplained;
  const std::set<std::string> truth(a.order.effects.begin(), a.order.effects.end());
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

Mark mark_if_apart(const Answered& answered, double apart) {
  if (answered.contenders.empty()) return mark_of(answered);
  Answered other = answered;
  other.named.clear();
  other.rivals.clear();
  for (const Contender& c : answered.contenders) {
    if (c.behind <= apart) other.rivals.push_back(c.id);
  }
  other.verdict = other.rivals.size() == 1 ? "cause_named" : "not_separable";
  if (other.rivals.size() == 1) std::swap(other.named, other.rivals);
  return mark_of(other);
}

std::string to_string(Mark mark) {
  switch (mark) {
    case Mark::nothing:
      return "adequate";
    case Mark::unexplained:
      return "unexplained";
    case Mark::named:
      return "named";
    case Mark::part:
      return "one of several named";
    case Mark::wrong:
      return "wrong cause named";
    case Mark::inside:
      return "not separable, listed";
    case Mark::outside:
      return "not separable, not listed";
    case Mark::failed:
      return "no answer";
  }
  return "";
}

std::optional<Answered> kept_answer(const CaseOrder& order, const fs::path& keep) {
  Answered a;
  a.order = order;
  if (keep.empty() || !load(kept_file(order, keep), a)) return {};
  return a;
}

Answered ask(const CaseOrder& order, const fs::path& binary, const fs::path& keep) {
  if (const std::optional<Answered> kept = kept_answer(order, keep)) return *kept;
  Answered a;
  a.order = order;
  const Case made = make_case(order);
  a.reached = made.reached;
  a.signal_to_noise = made.refit.signal_to_noise;
  if (made.reached) diagnose(made, binary, a);
  if (made.reached && chapter_of(order) == Chapter::effect && order.signal_to_noise >= visible) {
    a.closest = closest_cause(made, binary);
  }
  // A diagnosis that a signal ended (Ctrl-C reaches it too) has answered nothing.
  const bool answered = a.status >= 0 && a.status < 128;
  if (!keep.empty() && answered) {
    recoil::write_whole_file(kept_file(order, keep), to_json(a).dump(2) + "\n");
  }
  return a;
}

}  // namespace hidden
