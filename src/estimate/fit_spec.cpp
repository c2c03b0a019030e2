#include "estimate/fit_spec.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "core/files.hpp"
#include "data/text.hpp"
#include "data/toml_reader.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

namespace {

std::string quoted(std::string_view word) { return fmt::format("\"{}\"", word); }

std::string truth_value(bool value) { return value ? "true" : "false"; }

std::vector<FitKey> all_keys() {
  const FitSpec fit;
  const NoiseSpec noise;
  const UncertaintySpec uncertainty;
  return {
      {"", "dataset", "", "dataset folder, or a list of folders that are fitted together"},
      {"", "model", "", "the table [model]"},
      {"", "parameters", "", "the table [parameters]"},
      {"", "noise", "", "the table [noise]"},
      {"", "uncertainty", "", "the table [uncertainty]"},
      {"", "diagnosis", "", "the table [diagnosis]"},

      {"model", "adhesion", quoted(name_of(fit.adhesion)),
       "law of adhesion: ring (eq. 5, with f0), jkr, dmt or maugis (between jkr and dmt); the last "
       "three have W instead of f0"},
      {"model", "separation", fmt::format("{:g}", fit.separation),
       "z0 [m], distance of the surfaces in equilibrium, which sets the range of adhesion under "
       "maugis"},
      {"model", "adhesion_damping_phase", quoted(name_of(fit.phase)),
       "when adhesion damping acts: during rebound, or in both phases"},
      {"model", "loss", "",
       "loss law of the dry contact: hunt_crossley (C_H), viscoelastic (bulk_relaxation), constant "
       "(hysteretic_share) or yield (yield_pressure); the last three replace C_H. auto fits all of "
       "them and chooses by AICc. Default: auto without adhesion, else hunt_crossley"},
      {"model", "mechanisms", "[]", "ids of the mechanisms that are added to the base model"},
      {"model", "mixed_sizes", truth_value(fit.mixed_sizes),
       "true: average over the size distribution that a dataset states; false: every sphere has "
       "the diameter of its point"},

      {"parameter", "initial", "", "initial value, or the value of a fixed parameter"},
      {"parameter", "bounds", "", "[lower, upper]"},
      {"parameter", "free", "", "whether it is fitted"},
      {"parameter", "per", "",
       "\"dataset\": one value for each dataset of a joint fit instead of one for all"},

      {"noise", "variance", quoted("auto"), "how the scatter depends on e and V"},
      {"noise", "residuals", quoted(noise.student ? "student" : "normal"),
       "normal, or student, which gives outliers less weight"},
      {"noise", "student_dof", fmt::format("{:g}", noise.student_dof),
       "degrees of freedom of Student's t"},
      {"noise", "setting_sd", "",
       "standard deviation of an error of e that the points of one setting share [1]; 0: none; "
       "\"estimated\": from the points, even if no column names the settings. Default: estimated "
       "if a column does"},
      {"noise", "velocity_errors", truth_value(noise.velocity_errors),
       "use the column velocity_sd"},
      {"noise", "velocity_relative_sd", fmt::format("{:g}", noise.velocity_relative_sd),
       "relative standard deviation for points that state no velocity_sd"},
      {"noise", "diameter_errors", truth_value(noise.diameter_errors),
       "use the column diameter_sd"},
      {"noise", "diameter_relative_sd", fmt::format("{:g}", noise.diameter_relative_sd),
       "relative standard deviation for points that state no diameter_sd"},

      {"uncertainty", "replicates", fmt::format("{}", uncertainty.replicates),
       "number of bootstrap replicates; 0: none; \"auto\": until the intervals are precise enough"},
      {"uncertainty", "scheme", quoted(name_of(uncertainty.scheme)),
       "resampling scheme of the bootstrap"},
      {"uncertainty", "level", fmt::format("{:g}", uncertainty.level), "level of every interval"},
      {"uncertainty", "materials", quoted("auto"),
       "\"auto\": the fit moves uncertain material constants within their stated errors, and every "
       "result is averaged over how wrong the laws are; \"adjust\": the same with exact laws; "
       "true: "
       "the constants stay where they are stated, and their errors widen every interval; false: "
       "the constants are exact"},
      {"uncertainty", "posterior", truth_value(uncertainty.posterior),
       "sample the posterior; this adds its intervals and writes joint draws to posterior.csv and "
       "their likelihoods to log_likelihood.csv"},
      {"uncertainty", "own_design", "",
       "measure the coverage of the quoted intervals with simulated data sets of this design "
       "(`own_design.coverage`): true (200 data sets), false, or a number. Default: 200 if that "
       "takes less than about 10 s on one core"},
      {"uncertainty", "seed", fmt::format("{}", uncertainty.seed),
       "seed of the random numbers; fixes every digit of every output"},

      {"diagnosis", "law_error", "",
       "relative error, smooth in V and d, that a diagnosis allows in the law of a mechanism; "
       "three tenths of it in the losses of the base model; 0: the laws are exact. Default: every "
       "explanation is averaged over the errors that a fit averages over"},
  };
}

}  // namespace

const std::vector<FitKey>& fit_keys() {
  static const std::vector<FitKey> keys = all_keys();
  return keys;
}

std::vector<std::string> fit_keys_of(std::string_view table) {
  std::vector<std::string> names;
  for (const FitKey& key : fit_keys()) {
    if (key.table == table) names.emplace_back(key.name);
  }
  return names;
}

namespace {

constexpr std::uintmax_t largest_file = 1024 * 1024;  // [bytes]
constexpr int fewest_replicates = 19;
constexpr int most_replicates = 1000000;
constexpr int fewest_own_designs = 20;

// A larger relative error is refused: it would leave the quantity unknown.
constexpr double largest_relative_sd = 0.5;
// Beyond it Student's t equals the normal distribution in practice.
constexpr double largest_student_dof = 1000.0;
constexpr double lowest_level = 0.5;
constexpr double highest_level = 0.9999;  // one of 10,000 replicates is outside
constexpr double largest_value = 1e9;     // of C_H, C_A [s/m], f0 [N/m] and W [J/m2]
// A larger shared error of e is refused [1].
constexpr double largest_setting_sd = 0.3;
constexpr double largest_law_error = 0.5;
// From less than an atom to more than the range of any force between dry surfaces [m].
constexpr double least_separation = 5e-11;
constexpr double largest_separation = 1e-7;

void read_variance(const TomlReader& reader, const toml::node& node, NoiseSpec& spec) {
  std::vector<std::string> names = all_names<VarianceFunction>();
  names.insert(names.begin(), "auto");
  spec.variance =
      value_named<VarianceFunction>(reader.one_of(node, "variance", "variance function", names));
}

void read_residuals(const TomlReader& reader, const toml::table& table, NoiseSpec& spec) {
  if (const toml::node* node = table.get("residuals")) {
    spec.student = reader.one_of(*node, "residuals", "distribution of the residuals",
                                 {"normal", "student"}) == "student";
  }
  const toml::node* const node = table.get("student_dof");
  if (node == nullptr) return;
  if (!spec.student) {
    reader.fail(*node, "'student_dof' without Student's t",
                "normal residuals have no degrees of freedom",
                "add residuals = \"student\", or remove it");
  }
  spec.student_dof = reader.number_in(*node, "student_dof", 1.0, largest_student_dof,
                                      "4 is usual; residuals = \"normal\" is its limit");
}

/// `setting_sd`: a number, or "estimated".
void read_setting_sd(const TomlReader& reader, const toml::table& table, NoiseSpec& spec) {
  const toml::node* const node = table.get("setting_sd");
  if (node == nullptr) return;
  if (node->is_string()) {
    const std::string word = reader.string(*node, "setting_sd", "setting_sd = \"estimated\"");
    if (word != "estimated") {
      reader.fail(*node, fmt::format("setting_sd = {}", quote(word)), "",
                  "write a number or \"estimated\"");
    }
    spec.every_setting = true;
  } else {
    spec.setting_sd = reader.number_in(*node, "setting_sd", 0.0, largest_setting_sd,
                                       "it is an error of e: 0.01 is usual, 0 leaves it out");
  }
  if (spec.student && (spec.every_setting || *spec.setting_sd > 0.0)) {
    reader.fail(*node, "setting_sd beside residuals = \"student\"",
                "shared and single errors can be separated only if both are normal",
                "remove one of the two");
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
  relative_sd = reader.number_in(*node, size_name, 0.0, largest_relative_sd, "2 % is written 0.02");
  if (!used) {
    reader.fail(*node, fmt::format("'{}' is given though {} = false", size_name, switch_name),
                "it would have no effect", "remove one of the two");
  }
}

/// The `[noise]` table.
NoiseSpec read_noise_spec(const TomlReader& reader, const toml::table& table) {
  reader.allow_only(table, "[noise]", fit_keys_of("noise"));
  NoiseSpec spec;
  if (const toml::node* node = table.get("variance")) read_variance(reader, *node, spec);
  read_residuals(reader, table, spec);
  read_setting_sd(reader, table, spec);
  read_input_errors(reader, table, "velocity", spec.velocity_errors, spec.velocity_relative_sd);
  read_input_errors(reader, table, "diameter", spec.diameter_errors, spec.diameter_relative_sd);
  return spec;
}

/// A fit and the places of its dataset paths in the file.
struct LocatedFit {
  FitSpec spec;
  std::vector<Location> dataset_places;
};

class FitReader : private TomlReader {
 public:
  FitReader(const std::string& text, const std::filesystem::path& file)
      : TomlReader(file.string()), text_(text), folder_(file.parent_path()) {
    fit_.spec.id = descriptor_named(file) ? "fit" : file.stem().string();
    fit_.spec.file = file;
    fit_.spec.text = text;
    fit_.spec.sha256 = sha256_hex(text);
  }

  LocatedFit read() {
    const toml::table root = parse(text_);
    allow_only(root, "the fit", fit_keys_of(""));
    read_datasets(root);
    if (const toml::table* model = table(root, "model")) read_model(*model);
    read_parameters(table(root, "parameters"));
    if (const toml::table* noise = table(root, "noise")) {
      fit_.spec.noise = read_noise_spec(*this, *noise);
      if (const toml::node* variance = noise->get("variance")) {
        fit_.spec.variance_place = at(variance->source());
      }
    }
    if (const toml::table* uncertainty = table(root, "uncertainty")) read_uncertainty(*uncertainty);
    if (const toml::table* diagnosis = table(root, "diagnosis")) read_diagnosis(*diagnosis);
    return std::move(fit_);
  }

 private:
  void add_dataset(const toml::node& node) {
    const std::string text =
        string(node, "dataset", "dataset = \"../datasets/dahneke1975-quartz\"");
    if (text.empty() || printable(text) != text) {
      fail(node, "'dataset' names no folder", "",
           "write the path of a dataset folder, relative to this file");
    }
    std::filesystem::path path = (folder_ / text).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();  // "../datasets/mica/"
    auto& datasets = fit_.spec.datasets;
    if (std::find(datasets.begin(), datasets.end(), path) != datasets.end()) {
      fail(node, fmt::format("the dataset {} appears twice", quote(text)),
           "its points would count twice", "remove one");
    }
    datasets.push_back(path);
    fit_.dataset_places.push_back(at(node.source()));
  }

  void read_datasets(const toml::table& root) {
    const toml::node* const node = root.get("dataset");
    if (node == nullptr) {
      throw InputError({file(), 1, 1}, "the key 'dataset' is missing", "",
                       "add dataset = \"../datasets/...\" above the first table");
    }
    const toml::array* const list = node->as_array();
    if (list == nullptr) {
      add_dataset(*node);
      return;
    }
    if (list->empty()) {
      fail(*node, "'dataset' is an empty list", "", "name at least one dataset folder");
    }
    for (const toml::node& item : *list) add_dataset(item);
  }

  void read_model(const toml::table& model) {
    allow_only(model, "[model]", fit_keys_of("model"));
    if (const toml::node* node = model.get("adhesion")) {
      fit_.spec.adhesion = one_of<AdhesionLaw>(*node, "adhesion", "law of adhesion");
    }
    if (const toml::node* node = model.get("separation")) read_separation(*node);
    if (const toml::node* node = model.get("adhesion_damping_phase")) {
      fit_.spec.phase = one_of<AdhesionDampingPhase>(*node, "adhesion_damping_phase", "phase");
    }
    if (const toml::node* node = model.get("mixed_sizes")) {
      fit_.spec.mixed_sizes = boolean(*node, "mixed_sizes");
    }
    if (const toml::node* mechanisms = model.get("mechanisms")) {
      if (!mechanisms->is_array()) {
        wrong_type(*mechanisms, "mechanisms", "a list", "mechanisms = []");
      }
      for (const toml::node& item : *mechanisms->as_array()) add_mechanism(item);
    }
    if (const toml::node* node = model.get("loss")) read_loss(*node);
  }

  void read_loss(const toml::node& node) {
    std::vector<std::string> known = dry_losses();
    known.emplace_back("auto");
    fit_.spec.loss = one_of(node, "loss", "loss of the dry contact", known);
    if (const Mechanism* mechanism = dry_loss_mechanism(fit_.spec.loss)) {
      add_mechanism(node, std::string(mechanism->info.id));
    }
  }

  void read_separation(const toml::node& node) {
    if (!traits(fit_.spec.adhesion).has_range) {
      fail(
          node,
          fmt::format("'separation' is stated with adhesion = \"{}\"", name_of(fit_.spec.adhesion)),
          "only maugis has a range of adhesion", "leave it out, or set adhesion = \"maugis\"");
    }
    fit_.spec.separation =
        number_in(node, "separation", least_separation, largest_separation,
                  "the distance of two surfaces at rest is 0.2 to 0.5 nm: 4e-10 is usual");
  }

  void add_mechanism(const toml::node& item) {
    std::vector<std::string> known;
    for (const Mechanism& mechanism : mechanism_catalogue()) known.emplace_back(mechanism.info.id);
    string(item, "mechanisms", fmt::format("mechanisms = [\"{}\"]", known.front()));
    add_mechanism(item, one_of(item, "mechanisms", "mechanism", known));
  }

  void add_mechanism(const toml::node& item, const std::string& id) {
    if (const std::string_view why = find_mechanism(id)->refusal(fit_.spec.adhesion);
        !why.empty()) {
      fail(item,
           fmt::format("the mechanism {} cannot be used with adhesion = \"{}\"", quote(id),
                       name_of(fit_.spec.adhesion)),
           std::string(why), "leave the mechanism out, or choose adhesion = \"ring\"");
    }
    std::vector<std::string>& mechanisms = fit_.spec.mechanisms;
    if (const Mechanism* const rival = rival_among(mechanisms, id)) {
      fail(item, fmt::format("the mechanisms {} and {} together", rival->info.id, id),
           "both describe the same loss, and each would ignore what the other takes",
           "keep one of them");
    }
    if (std::find(mechanisms.begin(), mechanisms.end(), id) != mechanisms.end()) {
      fail(item, fmt::format("the mechanism {} appears twice", quote(id)), "", "remove one");
    }
    mechanisms.push_back(id);
  }

  /// Refuses parameters of mechanisms that [model] does not name: a likely mistake.
  void refuse_parameters_of_others(const toml::table& parameters) const {
    for (const Mechanism& mechanism : mechanism_catalogue()) {
      const std::string id(mechanism.info.id);
      const auto& chosen = fit_.spec.mechanisms;
      if (std::find(chosen.begin(), chosen.end(), id) != chosen.end()) continue;
      for (const Parameter& parameter : mechanism.info.parameters) {
        const toml::node* const node = parameters.get(parameter.name);
        if (node == nullptr) continue;
        fail(*node,
             fmt::format("'{}' belongs to the mechanism '{}', which [model] does not name",
                         parameter.name, id),
             "",
             mechanism.info.dry_loss.empty()
                 ? fmt::format("add \"{}\" to its mechanisms", id)
                 : fmt::format("write loss = \"{}\", or add \"{}\" to its mechanisms",
                               mechanism.info.dry_loss, id));
      }
    }
  }

  /// Refuses W under the ring law and f0 under the others.
  void refuse_the_adhesion_of_other_laws(const toml::table& parameters) const {
    const AdhesionLaw law = fit_.spec.adhesion;
    const Parameter& right = base_parameters(law)[2];
    const Parameter& wrong =
        base_parameters(traits(law).by_force ? AdhesionLaw::jkr : AdhesionLaw::ring)[2];
    const toml::node* const node = parameters.get(wrong.name);
    if (node == nullptr) return;
    fail(*node,
         fmt::format("'{}' is not a parameter of adhesion = \"{}\"", wrong.name, name_of(law)), "",
         fmt::format("state {} [{}], the {}", right.name, right.unit, right.meaning));
  }

  void read_parameters(const toml::table* parameters) {
    const std::vector<const Parameter*> known =
        parameters_with(fit_.spec.mechanisms, fit_.spec.adhesion);
    std::vector<std::string> names;
    for (const Parameter* parameter : known) names.emplace_back(parameter->name);
    if (parameters != nullptr) {
      refuse_parameters_of_others(*parameters);
      refuse_the_adhesion_of_other_laws(*parameters);
      allow_only(*parameters, "[parameters]", names);
    }
    for (const Parameter* parameter : known) {
      ParameterSpec spec = default_of(*parameter);
      const toml::node* const node =
          parameters == nullptr ? nullptr : parameters->get(parameter->name);
      spec.mentioned = node != nullptr;
      if (node != nullptr) read_parameter(*node, spec);
      fit_.spec.parameters.push_back(spec);
    }
    if (dry_loss_mechanism(fit_.spec.loss) == nullptr) return;
    const ParameterSpec& damping = fit_.spec.parameters.front();
    if (damping.mentioned && (damping.free || damping.initial != 0.0)) {
      fail(*parameters->get(damping.parameter->name),
           fmt::format("C_H beside loss = \"{}\"", fit_.spec.loss), "that law takes its place",
           "remove one of the two; mechanisms add a loss to C_H");
    }
    const std::string loss = fit_.spec.loss;
    fit_.spec = with_loss(std::move(fit_.spec), loss);
  }

  void read_parameter(const toml::node& node, ParameterSpec& spec) {
    const Parameter& entry = *spec.parameter;
    const std::string name(entry.name);
    const std::string example = fmt::format("{} = {{ initial = {:g}, bounds = [{:g}, {:g}] }}",
                                            entry.name, entry.initial, entry.lower, entry.upper);
    if (!node.is_table()) wrong_type(node, name, "a table", example);
    const toml::table& table = *node.as_table();
    allow_only(table, fmt::format("'{}'", entry.name), fit_keys_of("parameter"));
    if (const toml::node* free = table.get("free")) {
      spec.free = boolean(*free, "free");
    }
    if (const toml::node* per = table.get("per")) {
      const std::string word = string(*per, "per", "per = \"dataset\"");
      if (word != "dataset") {
        fail(*per, fmt::format("per = {}", quote(word)),
             "a parameter is either shared or fitted for each dataset",
             "write per = \"dataset\", or leave it out");
      }
      spec.per_dataset = true;
    }
    const toml::node* const bounds = table.get("bounds");
    if (bounds != nullptr) read_bounds(*bounds, spec);
    const toml::node* const initial = table.get("initial");
    if (initial != nullptr) {
      spec.initial = admissible(*initial, "initial", entry);
      spec.initial_stated = true;
    }
    const bool outside = spec.initial < spec.lower || spec.initial > spec.upper;
    if (!spec.is_derived() && outside && (spec.free || bounds != nullptr)) {
      fail(initial != nullptr ? *initial : *bounds,
           fmt::format("the {}initial value {:g} of '{}' lies outside its bounds",
                       spec.initial_stated ? "" : "default ", spec.initial, entry.name),
           fmt::format("the bounds are [{:g}, {:g}]", spec.lower, spec.upper),
           "choose an initial value within them");
    }
  }

  double admissible(const toml::node& node, const std::string& name, const Parameter& entry) const {
    const double value = number(node, name);
    if (entry.mechanism != nullptr) {
      if (value >= entry.lower && value <= entry.upper) return value;
      fail(node,
           fmt::format("'{}' of '{}' is {:g}{}", name, entry.name, value, unit_suffix(entry.unit)),
           fmt::format("the formula of '{}' holds from {:g} to {:g}", entry.mechanism->info.id,
                       entry.lower, entry.upper),
           "choose a value within");
    }
    if (value >= 0.0 && value <= largest_value) return value;
    if (value > 0.0) {
      fail(node,
           fmt::format("'{}' of '{}' is {:g}{}", name, entry.name, value, unit_suffix(entry.unit)),
           "no impact has so much", fmt::format("choose at most {:g}", largest_value));
    }
    fail(node,
         fmt::format("'{}' of '{}' is {:g}{}", name, entry.name, value, unit_suffix(entry.unit)),
         fmt::format("the {} cannot be negative", entry.meaning), "0 is the lowest value");
  }

  void read_bounds(const toml::node& node, ParameterSpec& spec) const {
    const Parameter& entry = *spec.parameter;
    const toml::array* const pair = node.as_array();
    if (pair == nullptr || pair->size() != 2) {
      fail(node, fmt::format("'bounds' of '{}' is not [lower, upper]", entry.name), "",
           fmt::format("write for example bounds = [{:g}, {:g}]", entry.lower, entry.upper));
    }
    spec.bounds_stated = true;
    spec.lower = admissible(*pair->get(0), "bounds", entry);
    spec.upper = admissible(*pair->get(1), "bounds", entry);
    if (spec.lower > spec.upper) {
      fail(node, fmt::format("the bounds of '{}' are the wrong way round", entry.name),
           fmt::format("{:g} is above {:g}", spec.lower, spec.upper),
           fmt::format("write bounds = [{:g}, {:g}]", spec.upper, spec.lower));
    }
    if (spec.lower == spec.upper) {
      fail(node, fmt::format("the bounds of '{}' are both {:g}", entry.name, spec.lower), "",
           fmt::format("to fix it, write free = false, initial = {:g}", spec.lower));
    }
    if (entry.log_scale && spec.lower <= 0.0) {
      fail(*pair->get(0), fmt::format("the lower bound of '{}' is 0", entry.name),
           "its logarithm is fitted", fmt::format("{:g} is low enough", entry.lower));
    }
  }

  void read_uncertainty(const toml::table& table) {
    allow_only(table, "[uncertainty]", fit_keys_of("uncertainty"));
    UncertaintySpec& spec = fit_.spec.uncertainty;
    if (const toml::node* node = table.get("scheme")) {
      spec.scheme = one_of<Scheme>(*node, "scheme", "bootstrap scheme");
    }
    if (const toml::node* node = table.get("replicates"); node != nullptr && node->is_string()) {
      spec.replicates_auto = node->as_string()->get() == "auto";
      if (!spec.replicates_auto) {
        fail(*node, fmt::format("replicates = {}", quote(node->as_string()->get())),
             "it has to be a whole number or \"auto\"", "1999 is usual");
      }
    } else if (node != nullptr) {
      const std::int64_t count = integer(*node, "replicates");
      if (count != 0 && (count < fewest_replicates || count > most_replicates)) {
        fail(*node, fmt::format("replicates = {}", count),
             fmt::format("an interval needs {} to {} of them", fewest_replicates, most_replicates),
             "1999 is usual; 0 leaves the bootstrap out");
      }
      spec.replicates = static_cast<int>(count);
    }
    if (const toml::node* node = table.get("level")) {
      spec.level = number(*node, "level");
      if (spec.level < lowest_level || spec.level > highest_level) {
        fail(*node, fmt::format("level = {:g}", spec.level),
             fmt::format("it has to lie between {:g} and {:g}", lowest_level, highest_level),
             spec.level > 1.0 && spec.level < 100.0
                 ? fmt::format("{:g} % is written {:g}", spec.level, spec.level / 100.0)
                 : std::string("0.95 is usual"));
      }
    }
    if (const toml::node* node = table.get("posterior")) {
      spec.posterior = boolean(*node, "posterior");
    }
    if (const toml::node* node = table.get("own_design")) {
      if (!node->is_boolean() && !node->is_integer()) {
        wrong_type(*node, "own_design", "true, false or a whole number", "own_design = false");
      }
      const std::int64_t count = node->is_boolean() ? (boolean(*node, "own_design") ? 200 : 0)
                                                    : integer(*node, "own_design");
      if (count != 0 && (count < fewest_own_designs || count > most_replicates)) {
        fail(*node, fmt::format("own_design = {}", count),
             fmt::format("a share needs {} to {} data sets", fewest_own_designs, most_replicates),
             "true simulates 200, false none");
      }
      spec.own_design = static_cast<int>(count);
    }
    if (const toml::node* node = table.get("materials")) {
      const std::string word = node->is_string() ? node->as_string()->get() : "";
      if (node->is_string() && word != "auto" && word != "adjust") {
        fail(*node, fmt::format("materials = {}", quote(word)),
             "it must be \"auto\", \"adjust\", true or false",
             "\"auto\" and \"adjust\" let the points move the constants, true widens the "
             "intervals by them");
      }
      spec.materials = word == "auto"                ? Materials::averaged
                       : word == "adjust"            ? Materials::adjusted
                       : boolean(*node, "materials") ? Materials::propagated
                                                     : Materials::exact;
    }
    if (const toml::node* node = table.get("seed")) {
      const std::int64_t seed = integer(*node, "seed");
      if (seed < 0) {
        fail(*node, fmt::format("seed = {}", seed), "a seed cannot be negative",
             "leave out the minus sign");
      }
      spec.seed = static_cast<std::uint64_t>(seed);
    }
  }

  void read_diagnosis(const toml::table& table) {
    allow_only(table, "[diagnosis]", fit_keys_of("diagnosis"));
    if (const toml::node* node = table.get("law_error")) {
      fit_.spec.law_error = number_in(*node, "law_error", 0.0, largest_law_error,
                                      "10 % is written 0.1; 0 means exact laws");
    }
  }

  const std::string& text_;
  std::filesystem::path folder_;
  LocatedFit fit_;
};

}  // namespace

ParameterSpec default_of(const Parameter& parameter) {
  return {&parameter, parameter.initial, parameter.lower, parameter.upper, parameter.free};
}

std::vector<std::string> dry_losses() {
  std::vector<std::string> names = {std::string(hunt_crossley)};
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    if (!mechanism.info.dry_loss.empty()) names.emplace_back(mechanism.info.dry_loss);
  }
  return names;
}

const Mechanism* dry_loss_mechanism(std::string_view loss) {
  if (loss.empty()) return nullptr;
  const auto& all = mechanism_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Mechanism& mechanism) {
    return mechanism.info.dry_loss == loss;
  });
  return found == all.end() ? nullptr : &*found;
}

FitSpec with_loss(FitSpec spec, const std::string& loss) {
  spec.loss = loss;
  const Mechanism* const mechanism = dry_loss_mechanism(loss);
  if (mechanism == nullptr) return spec;
  const std::string id(mechanism->info.id);
  if (std::find(spec.mechanisms.begin(), spec.mechanisms.end(), id) == spec.mechanisms.end()) {
    spec.mechanisms.push_back(id);
  }
  std::vector<ParameterSpec> parameters;
  for (const Parameter* parameter : parameters_with(spec.mechanisms, spec.adhesion)) {
    ParameterSpec& next = parameters.emplace_back(spec.statement_of(*parameter));
    if (parameter->role != ParameterRole::hertz_damping) continue;
    next.free = false;
    next.initial = 0.0;
    next.lower = 0.0;
  }
  spec.parameters = std::move(parameters);
  return spec;
}

ParameterSpec FitSpec::statement_of(const Parameter& parameter) const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(),
                   [&](const ParameterSpec& spec) { return spec.parameter == &parameter; });
  return found != parameters.end() ? *found : default_of(parameter);
}

FitSpec parse_fit(const std::string& text, const std::filesystem::path& file) {
  return FitReader(text, file).read().spec;
}

FitSpec load_fit(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, largest_file);
  LocatedFit fit = FitReader(text, file).read();
  for (std::size_t i = 0; i < fit.spec.datasets.size(); ++i) {
    std::error_code failed;
    if (std::filesystem::is_directory(fit.spec.datasets[i], failed)) continue;
    throw InputError(fit.dataset_places[i],
                     fmt::format("there is no folder '{}'", fit.spec.datasets[i].string()),
                     "paths are relative to the folder of this file", "correct the path");
  }
  return std::move(fit.spec);
}

}  // namespace recoil
