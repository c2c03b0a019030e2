#include "validation/studies/hidden_effects_plan.hpp"

#include <algorithm>

#include "validation/synthetic/other_laws.hpp"

namespace hidden {
namespace {

/// Two effects at once that an experiment may well have.
const std::vector<std::vector<std::string>> pairs_of_effects = {
    {"plastic_yield", "probe_plane"},    {"plastic_yield", "jkr_hysteresis"},
    {"gas_film", "size_calibration"},    {"plastic_yield", "survivor_bias"},
    {"jkr_hysteresis", "series_offset"}, {"bulk_viscoelastic", "rebound_truncation"},
};

constexpr double some_bend = 0.1;  // of a law
constexpr double great_bend = 0.2;
constexpr double slight_bend = 0.03;  // of the losses of the base model
constexpr double too_strong = 3.0;    // times what nature has
constexpr int most_rounds = 3;        // of further impacts

/// What drops by hand may have.
const std::vector<std::string> effects_of_drops = {"plastic_yield", "bulk_viscoelastic",
                                                   "plate_flexure", "hysteretic_loss",
                                                   "flight_drag",   "height_origin"};

class Plan {
 public:
  explicit Plan(std::uint64_t seed) : seed_(seed) {}
  void add(const char* design, const std::vector<std::string>& effects, double strength, int count,
           CaseOrder order = {}) {
    order.design = design;
    order.effects = effects;
    order.signal_to_noise = strength;
    order.seed = seed_;
    for (int i = 0; i < count; ++i) {
      order.index = static_cast<std::uint64_t>(i);
      orders.push_back(order);
    }
  }
  std::vector<CaseOrder> orders;

 private:
  std::uint64_t seed_;
};

/// Laws of dry contacts in dry contacts, and beside adhesion.
void add_other_laws(Plan& plan, int count) {
  for (const std::string_view effect : effects_with_other_law()) {
    std::vector<const char*> designs = {"wall", "li"};
    if (is_law_of_dry_contact(effect)) designs.push_back("drops");
    for (const char* design : designs) {
      for (const double strength : {10.0, 20.0}) {
        plan.add(design, {std::string(effect)}, strength, count, {.other_law = true});
      }
    }
  }
}

/// Nothing hidden, or what such readings may have beside it: air, of heights an origin, of times
/// what the contact loses.
void add_rounded(Plan& plan, int count) {
  for (const Readout readout : recoil::values_of<Readout>()) {
    if (readout == Readout::exact) continue;
    const CaseOrder order{.readout = readout};
    for (const char* design : {"drops", "balls"}) plan.add(design, {}, 0.0, count, order);
    plan.add("drops", {"flight_drag"}, 20.0, count, order);
    if (reads_times(readout)) {
      plan.add("drops", {"plastic_yield"}, 20.0, count, order);
      continue;
    }
    for (const char* design : {"drops", "balls"}) {
      plan.add(design, {"height_origin"}, 20.0, count, order);
    }
  }
}

}  // namespace

Arm arm_of(const CaseOrder& order) {
  if (!order.effects.empty() && order.effects.front() == "settings") return Arm::settings;
  if (!order.effects.empty() && order.effects.front() == "odd_points") return Arm::odd;
  if (order.readout != Readout::exact) return Arm::rounded;
  if (!has_several_diameters(order.design)) return Arm::single;
  if (order.effects.empty()) return order.base_bend > 0.0 ? Arm::base_bent : Arm::correct;
  if (order.beyond > 0.0) return Arm::impossible;
  if (order.law_bend > 0.0) return order.law_bend > some_bend ? Arm::bent_more : Arm::bent;
  if (order.other_law) {
    const bool dry = is_law_of_dry_contact(order.effects.front());
    return dry && order.design != "drops" ? Arm::other_adhesive : Arm::other_law;
  }
  if (order.circumstances == Circumstances::stated) return Arm::stated;
  if (order.circumstances == Circumstances::varied) return Arm::varied;
  if (order.rounds > 0) return Arm::loop;
  if (order.design == "drops") return Arm::dropped;
  if (order.effects.size() > 1) return Arm::pair;
  switch (find_hidden_effect(order.effects.front()).kind) {
    case EffectKind::outside:
      return Arm::outside;
    case EffectKind::careless:
      return Arm::careless;
    default:
      return Arm::effect;
  }
}

std::vector<CaseOrder> plan_study(const StudySize& size) {
  Plan plan(size.seed);
  for (const HiddenEffect& known : hidden_effects()) {
    const std::vector<std::string> effect = {std::string(known.id)};
    if (effect.front() == "settings") {
      plan.add("drops", effect, 0.0, 6 * size.dropped);
      continue;
    }
    if (effect.front() == "odd_points") {
      for (const char* design : {"wall", "li", "drops"}) plan.add(design, effect, 0.0, size.odd);
      continue;
    }
    if (known.kind == EffectKind::careless) {
      for (const char* design : {"wall", "li"}) plan.add(design, effect, 0.0, size.careless);
      continue;
    }
    const bool outside = known.kind == EffectKind::outside;
    for (const double strength : study_strengths()) {
      const int count = outside ? size.outside : size.per_cell;
      if (outside && strength < visible) continue;
      for (const char* design : {"wall", "li"}) plan.add(design, effect, strength, count);
      if (!outside) plan.add("wall-batches", effect, strength, (count + 1) / 2);
    }
    for (const char* design : {"wall", "li"}) {
      if (outside) continue;
      for (const double strength : {10.0, 20.0}) {
        plan.add(design, effect, strength, size.bent, {.law_bend = some_bend});
        plan.add(design, effect, strength, size.bent / 2, {.law_bend = great_bend});
      }
      plan.add(design, effect, 0.0, size.impossible, {.beyond = too_strong});
      for (const double strength : {10.0, 20.0}) {
        plan.add(design, effect, strength, size.loop, {.rounds = most_rounds});
        if (change_against(effect.front()).name.empty()) continue;
        for (const Circumstances circumstances : {Circumstances::stated, Circumstances::varied}) {
          plan.add(design, effect, strength, size.conditions, {.circumstances = circumstances});
        }
      }
    }
    for (const double strength : {10.0, 20.0}) {
      for (const char* design : {"wall-one", "dahneke"}) {
        if (!outside) plan.add(design, effect, strength, size.single);
      }
    }
  }
  for (const std::vector<std::string>& pair : pairs_of_effects) {
    for (const double strength : {10.0, 20.0}) {
      for (const char* design : {"wall", "li"}) plan.add(design, pair, strength, size.pairs);
    }
  }
  for (const std::string& effect : effects_of_drops) {
    for (const double strength : {10.0, 20.0}) plan.add("drops", {effect}, strength, size.dropped);
  }
  plan.add("drops", {}, 0.0, 6 * size.dropped);
  add_other_laws(plan, size.other_law);
  add_rounded(plan, size.rounded);
  // Nothing hidden: half as in Wall's design, the rest shared.
  plan.add("wall", {}, 0.0, (size.correct + 1) / 2);
  plan.add("li", {}, 0.0, size.correct / 4);
  for (const char* design : {"wall", "li"}) {
    plan.add(design, {}, 0.0, size.base_bent / 2, {.base_bend = slight_bend});
  }
  plan.add("wall-batches", {}, 0.0, size.correct - (size.correct + 1) / 2 - size.correct / 4);
  for (const char* design : {"wall-one", "dahneke"}) plan.add(design, {}, 0.0, 5 * size.single);
  // By names that say nothing.
  std::sort(plan.orders.begin(), plan.orders.end(), [](const CaseOrder& a, const CaseOrder& b) {
    return std::pair(neutral_name(a), a.key()) < std::pair(neutral_name(b), b.key());
  });
  return plan.orders;
}

}  // namespace hidden
