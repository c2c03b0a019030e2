#include "plot/plot.hpp"

#include <fmt/format.h>

#include <cctype>
#include <type_traits>

namespace recoil::plot {
namespace {

std::string quantity(const Axis& axis, const char* otherwise) {
  return axis.label.empty() ? otherwise : axis.label;
}

/// The ticks of an axis that are names of things, not numbers.
std::vector<Tick> named_ticks(const Axis& axis) {
  std::vector<Tick> named;
  for (const Tick& tick : axis.ticks) {
    const bool number = tick.label.empty() || tick.label.find_first_of("-0123456789") == 0 ||
                        tick.label.starts_with("\u2212");
    if (!number) named.push_back(tick);
  }
  return named;
}

/// The columns of one layer; none where it shows no data.
std::vector<Column> columns_of(const Layer& layer, const Plot& plot) {
  const std::string x = quantity(plot.x, "x");
  const std::string y = quantity(plot.y, "y");
  const std::string value = plot.colours ? plot.colours->label : std::string("value");
  const auto across = [&](const std::string& what, const std::vector<double>& values) {
    return Column{what.empty() ? x : x + ", " + what, plot.x.unit, values, named_ticks(plot.x)};
  };
  const auto up = [&](const std::string& what, const std::vector<double>& values) {
    return Column{what.empty() ? y : y + ", " + what, plot.y.unit, values, named_ticks(plot.y)};
  };
  return std::visit(
      [&](const auto& shown) -> std::vector<Column> {
        using Kind = std::decay_t<decltype(shown)>;
        if constexpr (std::is_same_v<Kind, Points>) {
          std::vector<Column> columns = {across("", shown.x), up("", shown.y)};
          if (!shown.lower.empty()) {
            columns.push_back(up("lower", shown.lower));
            columns.push_back(up("upper", shown.upper));
          }
          return columns;
        } else if constexpr (std::is_same_v<Kind, Line>) {
          return {across("", shown.x), up("", shown.y)};
        } else if constexpr (std::is_same_v<Kind, Band>) {
          return {across("", shown.x), up("lower", shown.lower), up("upper", shown.upper)};
        } else if constexpr (std::is_same_v<Kind, Boxes>) {
          std::vector<Column> columns = {across("lower", shown.left), across("upper", shown.right),
                                         up("lower", shown.bottom), up("upper", shown.top)};
          if (!shown.values.empty()) columns.push_back({value, "", shown.values});
          return columns;
        } else if constexpr (std::is_same_v<Kind, Spans>) {
          return {up("", shown.y), across("lower", shown.lower), across("upper", shown.upper)};
        } else if constexpr (std::is_same_v<Kind, Discs>) {
          return {across("", shown.x), up("", shown.y), {value, "", shown.values}};
        } else {
          return {};
        }
      },
      layer);
}

}  // namespace

Points& Points::with_sd(const std::vector<double>& sd) {
  lower.clear();
  upper.clear();
  for (std::size_t i = 0; i < y.size(); ++i) {
    lower.push_back(y[i] - sd.at(i));
    upper.push_back(y[i] + sd.at(i));
  }
  return *this;
}

void Boxes::add(double from_x, double to_x, double from_y, double to_y) {
  left.push_back(from_x);
  right.push_back(to_x);
  bottom.push_back(from_y);
  top.push_back(to_y);
}

const std::string& name_of(const Layer& layer) {
  static const std::string none;
  return std::visit(
      [](const auto& shown) -> const std::string& {
        if constexpr (requires { shown.name; }) {
          return shown.name;
        } else {
          return none;
        }
      },
      layer);
}

std::string Axis::title() const {
  return unit.empty() || label.empty() ? label : fmt::format("{}  [{}]", label, unit);
}

std::vector<DataTable> data_of(const Picture& picture) {
  std::vector<DataTable> tables;
  for (std::size_t p = 0; p < picture.plots.size(); ++p) {
    for (const Layer& layer : picture.plots[p].layers) {
      std::vector<Column> columns = columns_of(layer, picture.plots[p]);
      if (!columns.empty()) tables.push_back({name_of(layer), std::move(columns), p});
    }
  }
  return tables;
}

std::string plot_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
    name = "f-" + name;
  }
  return name;
}

}  // namespace recoil::plot
