#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace pairs {

/// Something that a fit may have, and the forms that it takes. Every form of every feature goes
/// with the first forms of all others.
struct Feature {
  std::string name;
  std::vector<std::string> forms;
};

/// One form of a feature.
struct Form {
  std::string feature;
  std::string form;
  auto operator<=>(const Form&) const = default;
};

/// Two forms, the lesser first.
using Pair = std::pair<Form, Form>;
Pair pair_of(const Form& a, const Form& b);

/// The form of every feature.
using Choice = std::map<std::string, std::string>;

std::string words_of(const Choice& choice);

/// All pairs of forms of different features.
std::vector<Pair> all_pairs(const std::vector<Feature>& features);

bool has(const Choice& choice, const Pair& pair);

/// Choices in which every pair of forms occurs, except the refused ones, which never occur: a
/// covering array of strength 2, made greedily (Cohen, Dalal, Fredman & Patton 1997, IEEE Trans.
/// Softw. Eng. 23, 437-444). Equal seeds give equal arrays.
std::vector<Choice> covering_array(const std::vector<Feature>& features,
                                   const std::vector<Pair>& refused, unsigned seed);

}  // namespace pairs
