#include "estimate/noise_reader.hpp"

#include <fmt/format.h>

#include "data/text.hpp"

namespace recoil {
namespace {

// Larger than this an error is no error of the quantity but another quantity.
constexpr double largest_relative_sd = 0.5;
// Beyond it Student's t is the normal distribution for every practical purpose.
constexpr double largest_student_dof = 1000.0;

void read_variance(const TomlReader& reader, const toml::node& node, NoiseSpec& spec) {
  const std::string word = reader.string(node, "variance", "variance = \"auto\"");
  spec.variance_place = reader.at(node.source());
  if (word == "auto") return;
  std::vector<std::string> names = {"auto"};
  for (const VarianceFunction function :
       {VarianceFunction::stated, VarianceFunction::constant, VarianceFunction::proportional,
        VarianceFunction::capture, VarianceFunction::steep}) {
    names.push_back(to_string(function));
    if (word == names.back()) spec.variance = function;
  }
  if (spec.variance) return;
  reader.fail(node, fmt::format("unknown variance function {}", quote(word)),
              fmt::format("known are {}", join(names)), did_you_mean(word, names));
}

void read_residuals(const TomlReader& reader, const toml::table& table, NoiseSpec& spec) {
  if (const toml::node* node = table.get("residuals")) {
    const std::string word = reader.string(*node, "residuals", "residuals = \"normal\"");
    if (word != "normal" && word != "student") {
      reader.fail(*node, fmt::format("unknown distribution {}", quote(word)),
                  "residuals are taken as normal or, against outliers, as Student's t",
                  did_you_mean(word, {"normal", "student"}));
    }
    spec.student = word == "student";
  }
  const toml::node* const node = table.get("student_dof");
  if (node == nullptr) return;
  spec.student_dof = reader.number(*node, "student_dof");
  if (!spec.student) {
    reader.fail(*node, "'student_dof' without Student's t",
                "normal residuals have no degrees of freedom of their own",
                "add residuals = \"student\", or remove it");
  }
  if (spec.student_dof < 1.0 || spec.student_dof > largest_student_dof) {
    reader.fail(*node, fmt::format("student_dof = {:g}", spec.student_dof),
                fmt::format("it has to lie between 1 and {:g}", largest_student_dof),
                "4 is usual; residuals = \"normal\" is its limit");
  }
}

/// `quantity_errors` (on or off) and `quantity_relative_sd` (where the dataset states none).
void read_input_errors(const TomlReader& reader, const toml::table& table,
                       const std::string& quantity, bool& used, double& relative_sd) {
  const std::string switch_name = quantity + "_errors";
  const std::string size_name = quantity + "_relative_sd";
  if (const toml::node* node = table.get(switch_name)) used = reader.boolean(*node, switch_name);
  const toml::node* const node = table.get(size_name);
  if (node == nullptr) return;
  relative_sd = reader.number(*node, size_name);
  if (relative_sd < 0.0 || relative_sd > largest_relative_sd) {
    reader.fail(*node, fmt::format("{} = {:g}", size_name, relative_sd),
                fmt::format("it has to lie between 0 and {:g}", largest_relative_sd),
                "two per cent is written 0.02");
  }
  if (!used) {
    reader.fail(*node, fmt::format("'{}' though {} = false", size_name, switch_name),
                "it would be ignored silently", "remove one of the two");
  }
}

}  // namespace

NoiseSpec read_noise_spec(const TomlReader& reader, const toml::table& table) {
  reader.allow_only(table, "[noise]",
                    {"variance", "residuals", "student_dof", "velocity_errors",
                     "velocity_relative_sd", "diameter_errors", "diameter_relative_sd"});
  NoiseSpec spec;
  if (const toml::node* node = table.get("variance")) read_variance(reader, *node, spec);
  read_residuals(reader, table, spec);
  read_input_errors(reader, table, "velocity", spec.velocity_errors, spec.velocity_relative_sd);
  read_input_errors(reader, table, "diameter", spec.diameter_errors, spec.diameter_relative_sd);
  return spec;
}

}  // namespace recoil
