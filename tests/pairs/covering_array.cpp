#include "covering_array.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <stdexcept>

namespace pairs {
namespace {

/// How many of `pairs` a further form makes with those chosen already.
std::size_t made_by(const Form& form, const Choice& chosen, const std::set<Pair>& pairs) {
  std::size_t count = 0;
  for (const auto& [feature, other] : chosen) count += pairs.count(pair_of(form, {feature, other}));
  return count;
}

/// A choice that begins with `first` and makes many pairs of `wanted` and none of `refused`.
Choice greedy_choice(const std::vector<Feature>& features, const Pair& first,
                     const std::set<Pair>& wanted, const std::set<Pair>& refused,
                     std::mt19937& random) {
  Choice choice = {{first.first.feature, first.first.form},
                   {first.second.feature, first.second.form}};
  std::vector<Feature> others;
  for (const Feature& feature : features) {
    if (!choice.contains(feature.name)) others.push_back(feature);
  }
  std::shuffle(others.begin(), others.end(), random);
  for (Feature& feature : others) {
    std::shuffle(feature.forms.begin(), feature.forms.end(), random);
    std::string best;
    std::size_t most = 0;
    for (const std::string& form : feature.forms) {
      if (made_by({feature.name, form}, choice, refused) > 0) continue;
      const std::size_t made = made_by({feature.name, form}, choice, wanted);
      if (!best.empty() && made <= most) continue;
      best = form;
      most = made;
    }
    if (best.empty()) throw std::logic_error("no form of " + feature.name + " is left");
    choice[feature.name] = best;
  }
  return choice;
}

}  // namespace

Pair pair_of(const Form& a, const Form& b) { return a < b ? Pair{a, b} : Pair{b, a}; }

std::string words_of(const Choice& choice) {
  std::string words;
  for (const auto& [feature, form] : choice) {
    words += (words.empty() ? "" : ", ") + feature + " " + form;
  }
  return words;
}

std::vector<Pair> all_pairs(const std::vector<Feature>& features) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (const std::string& a : features[i].forms) {
        for (const std::string& b : features[j].forms) {
          pairs.push_back(pair_of({features[i].name, a}, {features[j].name, b}));
        }
      }
    }
  }
  return pairs;
}

bool has(const Choice& choice, const Pair& pair) {
  return choice.at(pair.first.feature) == pair.first.form &&
         choice.at(pair.second.feature) == pair.second.form;
}

std::vector<Choice> covering_array(const std::vector<Feature>& features,
                                   const std::vector<Pair>& refused, unsigned seed) {
  constexpr int tried = 40;
  const std::set<Pair> never(refused.begin(), refused.end());
  std::set<Pair> wanted;
  for (const Pair& pair : all_pairs(features)) {
    if (!never.contains(pair)) wanted.insert(pair);
  }
  std::mt19937 random(seed);
  std::vector<Choice> choices;
  while (!wanted.empty()) {
    Choice best;
    std::size_t most = 0;
    for (int k = 0; k < tried; ++k) {
      const auto first = std::next(wanted.begin(), static_cast<long>(random() % wanted.size()));
      Choice choice = greedy_choice(features, *first, wanted, never, random);
      const auto made = static_cast<std::size_t>(std::count_if(
          wanted.begin(), wanted.end(), [&](const Pair& pair) { return has(choice, pair); }));
      if (made <= most) continue;
      most = made;
      best = std::move(choice);
    }
    std::erase_if(wanted, [&](const Pair& pair) { return has(best, pair); });
    choices.push_back(std::move(best));
  }
  return choices;
}

}  // namespace pairs
