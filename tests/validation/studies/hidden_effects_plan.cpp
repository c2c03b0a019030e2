#include "validation/studies/hidden_effects_plan.hpp"

#include <algorithm>

#include "validation/synthetic/sphere.hpp"

namespace recoil::hidden {
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

using Designs = std::vector<const char*>;
using Strengths = std::vector<double>;
const Designs several_sizes = {"wall", "li"};
const Strengths middle = {10.0, 20.0};  // visible, without the strongest
const Strengths none = {0.0};

class Plan {
 public:
  explicit Plan(std::uint64_t seed) : seed_(seed) {}
  /// Adds `count` orders of each design and strength, otherwise like `order`.
  void add(const Designs& designs, const std::vector<std::string>& effects,
           const Strengths& strengths, int count, CaseOrder order = {}) {
    order.effects = effects;
    order.seed = seed_;
    for (const char* design : designs) {
      for (const double strength : strengths) {
        order.design = design;
        order.signal_to_noise = strength;
        for (int i = 0; i < count; ++i) {
          order.index = static_cast<std::uint64_t>(i);
          orders.push_back(order);
        }
      }
    }
  }
  std::vector<CaseOrder> orders;

 private:
  std::uint64_t seed_;
};

/// An effect of the catalogue alone.
void add_effect(Plan& plan, const std::vector<std::string>& effect, const StudySize& size) {
  const Strengths all(study_strengths.begin(), study_strengths.end());
  plan.add(several_sizes, effect, all, size.per_cell);
  plan.add({"wall-batches"}, effect, all, (size.per_cell + 1) / 2);
  plan.add(several_sizes, effect, middle, size.bent, {.law_bend = some_bend});
  plan.add(several_sizes, effect, middle, size.bent / 2, {.law_bend = great_bend});
  plan.add(several_sizes, effect, none, size.impossible, {.beyond = too_strong});
  plan.add(several_sizes, effect, middle, size.loop, {.rounds = most_rounds});
  plan.add({"wall-one", "dahneke"}, effect, middle, size.single);
  if (change_against(effect.front()).name.empty()) return;
  for (const Circumstances circumstances : {Circumstances::stated, Circumstances::varied}) {
    plan.add(several_sizes, effect, middle, size.conditions, {.circumstances = circumstances});
  }
}

/// Laws of dry contacts in dry contacts, and beside adhesion.
void add_other_laws(Plan& plan, int count) {
  for (const std::string_view effect : effects_with_other_law()) {
    Designs designs = several_sizes;
    if (is_law_of_dry_contact(effect)) designs.push_back("drops");
    plan.add(designs, {std::string(effect)}, middle, count, {.other_law = true});
  }
}

/// Nothing hidden, or what such readings may have beside it: air, of heights an origin, of times
/// what the contact loses.
void add_rounded(Plan& plan, int count) {
  for (const Readout readout : values_of<Readout>()) {
    if (readout == Readout::exact) continue;
    const CaseOrder order{.readout = readout};
    plan.add({"drops", "balls"}, {}, none, count, order);
    plan.add({"drops"}, {"flight_drag"}, {20.0}, count, order);
    if (reads_times(readout)) {
      plan.add({"drops"}, {"plastic_yield"}, {20.0}, count, order);
    } else {
      plan.add({"drops", "balls"}, {"height_origin"}, {20.0}, count, order);
    }
  }
}

}  // namespace

const std::vector<StudyPart>& study_parts() {
  using Size = StudySize;
  static const std::vector<StudyPart> parts = {
      {"--datasets", &Size::per_cell, "of each effect, design and strength"},
      {"--correct", &Size::correct, "with nothing hidden"},
      {"--pairs", &Size::pairs, "of each pair, design and strength"},
      {"--outside", &Size::outside, "of each outside effect, design and strength"},
      {"--single", &Size::single, "of each effect and strength with one diameter"},
      {"--careless", &Size::careless, "of each kind of error that is not stated, and design"},
      {"--bent", &Size::bent,
       "of each effect, design and visible strength, by a law bent by 10 % (half as many by 20 %)"},
      {"--other-law", &Size::other_law,
       "of each effect with a second published law, design and visible strength"},
      {"--base-bent", &Size::base_bent,
       "with nothing hidden and the losses of the base model bent by 3 %"},
      {"--impossible", &Size::impossible,
       "of each effect and design, at three times what nature has"},
      {"--conditions", &Size::conditions,
       "of each effect that a condition takes away, design and visible strength, with its "
       "condition "
       "stated and again varied"},
      {"--loop", &Size::loop,
       "of each effect, design and visible strength, asked again after doing what the answer "
       "advises, three times at most"},
      {"--dropped", &Size::dropped,
       "of each effect of drops of spheres of millimetres and visible strength; six times as many "
       "with heights set wrong, and with nothing hidden"},
      {"--rounded", &Size::rounded,
       "of each step of reading, design of drops and effect: heights or times of flight that are "
       "read to a finite step"},
      {"--odd", &Size::odd, "of each design, with a few points misread"}};
  return parts;
}

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
    if (known.id == "settings") {
      plan.add({"drops"}, effect, none, 6 * size.dropped);
    } else if (known.id == "odd_points") {
      plan.add({"wall", "li", "drops"}, effect, none, size.odd);
    } else if (known.kind == EffectKind::careless) {
      plan.add(several_sizes, effect, none, size.careless);
    } else if (known.kind == EffectKind::outside) {
      plan.add(several_sizes, effect, {10.0, 20.0, 40.0}, size.outside);
    } else {
      add_effect(plan, effect, size);
    }
  }
  for (const std::vector<std::string>& pair : pairs_of_effects) {
    plan.add(several_sizes, pair, middle, size.pairs);
  }
  for (const std::string& effect : effects_of_drops) {
    plan.add({"drops"}, {effect}, middle, size.dropped);
  }
  plan.add({"drops"}, {}, none, 6 * size.dropped);
  add_other_laws(plan, size.other_law);
  add_rounded(plan, size.rounded);
  // Nothing hidden: half as in Wall's design, the rest shared.
  const int half = (size.correct + 1) / 2;
  plan.add({"wall"}, {}, none, half);
  plan.add({"li"}, {}, none, size.correct / 4);
  plan.add({"wall-batches"}, {}, none, size.correct - half - size.correct / 4);
  plan.add(several_sizes, {}, none, size.base_bent / 2, {.base_bend = slight_bend});
  plan.add({"wall-one", "dahneke"}, {}, none, 5 * size.single);
  // By names that say nothing.
  std::sort(plan.orders.begin(), plan.orders.end(), [](const CaseOrder& a, const CaseOrder& b) {
    return std::pair(neutral_name(a), a.key()) < std::pair(neutral_name(b), b.key());
  });
  return plan.orders;
}

}  // namespace recoil::hidden
