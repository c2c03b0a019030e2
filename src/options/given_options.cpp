#include "options/given_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/numbers.hpp"
#include "data/text.hpp"
#include "options/useless_options.hpp"

namespace recoil {

GivenOptions GivenOptions::of_python(
    const std::string& function, const std::map<std::string, std::vector<std::string>>& arguments) {
  GivenOptions given(function);
  given.python_ = true;
  for (const OptionRow* row : arguments_of(function)) {
    const auto stated = arguments.find(std::string(row->python));
    if (stated == arguments.end()) continue;
    const OptionType& type = row->type;
    std::vector<std::string> values = stated->second;
    if (type.is_flag() && values == std::vector<std::string>{"False"}) continue;
    for (const std::string& value : values) {
      const std::string expected =
          type.is_flag() ? (value == "True" ? "" : "True or False") : expected_instead(type, value);
      if (expected.empty()) continue;
      throw InputError({}, fmt::format("{} is {}", row->python, quote(value)), "",
                       fmt::format("give {}", expected));
    }
    if (values.size() > type.most || (values.size() < type.least && !values.empty())) {
      throw InputError({}, fmt::format("{} has {} values", row->python, values.size()), "",
                       fmt::format("give {} to {}", type.least, type.most));
    }
    if (!values.empty()) given.set(row->name, std::move(values));
  }
  refuse_useless_options(given);
  return given;
}

const OptionRow* GivenOptions::find_row(std::string_view name) const {
  for (const OptionRow* row : python_ ? arguments_of(command_) : options_of(command_)) {
    if (row->name == name) return row;
  }
  return nullptr;
}

const OptionRow& GivenOptions::row(std::string_view name) const {
  if (const OptionRow* found = find_row(name)) return *found;
  throw std::logic_error(fmt::format("{} has no option {}", command_, name));
}

void GivenOptions::set(std::string_view name, std::vector<std::string> values) {
  values_[std::string(row(name).name)] = std::move(values);
}

bool GivenOptions::has(std::string_view name) const { return values_.contains(row(name).name); }

std::vector<std::string> GivenOptions::texts(std::string_view name) const {
  const auto found = values_.find(row(name).name);
  return found == values_.end() ? std::vector<std::string>() : found->second;
}

std::string GivenOptions::text(std::string_view name) const {
  const std::vector<std::string> all = texts(name);
  return all.empty() ? std::string(row(name).default_text()) : all.front();
}

std::map<std::string, std::string> GivenOptions::assignments(std::string_view name) const {
  std::map<std::string, std::string> pairs;
  for (const std::string& word : texts(name)) {
    const std::size_t equals = word.find('=');
    if (pairs.emplace(word.substr(0, equals), word.substr(equals + 1)).second) continue;
    throw InputError({}, fmt::format("{} {} is given twice", name_of(name), word.substr(0, equals)),
                     "", "remove one");
  }
  return pairs;
}

std::optional<double> GivenOptions::number_if_any(std::string_view name) const {
  const std::string stated = text(name);
  return stated.empty() ? std::nullopt : std::optional(number_of(row(name).type, stated));
}

std::optional<std::int64_t> GivenOptions::whole_if_any(std::string_view name) const {
  return parse_whole_number(text(name));
}

double GivenOptions::number(std::string_view name) const { return number_if_any(name).value(); }

std::int64_t GivenOptions::whole(std::string_view name) const { return whole_if_any(name).value(); }

std::vector<double> GivenOptions::numbers(std::string_view name) const {
  std::vector<double> values;
  for (const std::string& text : texts(name)) values.push_back(number_of(row(name).type, text));
  return values;
}

std::string_view GivenOptions::name_of(std::string_view name) const {
  return python_ ? row(name).python : row(name).name;
}

std::vector<std::string> GivenOptions::words(const std::vector<std::string_view>& left_out) const {
  std::vector<std::string> words = {command_};
  for (const OptionRow* row : options_of(command_)) {
    const auto found = values_.find(row->name);
    if (found == values_.end() || row->is_hidden()) continue;
    if (std::ranges::find(left_out, row->name) != left_out.end()) continue;
    std::vector<std::string> values = found->second;
    if (row->type.commas) values = {fmt::format("{}", fmt::join(values, ","))};
    if (row->type.is_flag()) words.emplace_back(row->name);
    for (const std::string& value : values) {
      if (!row->is_argument()) words.emplace_back(row->name);
      words.push_back(value);
    }
  }
  return words;
}

}  // namespace recoil
