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
#include "estimate/noise_reader.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr std::uintmax_t largest_file = 1024 * 1024;  // [bytes]
constexpr int fewest_replicates = 19;
constexpr int most_replicates = 1000000;

/// A fit and where its dataset paths stand.
struct LocatedFit {
  FitSpec spec;
  std::vector<Location> dataset_places;
};

class FitReader : private TomlReader {
 public:
  FitReader(const std::string& text, const std::filesystem::path& file)
      : TomlReader(file.string()), text_(text), folder_(file.parent_path()) {
    fit_.spec.id = file.stem().string();
    fit_.spec.file = file;
    fit_.spec.sha256 = sha256_hex(text);
  }

  LocatedFit read() {
    const toml::table root = parse(text_);
    allow_only(root, "the fit", {"dataset", "model", "parameters", "noise", "uncertainty"});
    read_datasets(root);
    if (const toml::table* model = table(root, "model")) read_model(*model);
    read_parameters(table(root, "parameters"));
    if (const toml::table* noise = table(root, "noise")) {
      fit_.spec.noise = read_noise_spec(*this, *noise);
    }
    if (const toml::table* uncertainty = table(root, "uncertainty")) read_uncertainty(*uncertainty);
    return std::move(fit_);
  }

 private:
  void add_dataset(const toml::node& node) {
    const std::string text =
        string(node, "dataset", "dataset = \"../datasets/dahneke1975-quartz\"");
    if (text.empty() || printable(text) != text) {
      fail(node, "'dataset' names no folder", "the points are read from it",
           "write the path of a dataset folder, seen from this file");
    }
    std::filesystem::path path = (folder_ / text).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();  // "../datasets/mica/"
    auto& datasets = fit_.spec.datasets;
    if (std::find(datasets.begin(), datasets.end(), path) != datasets.end()) {
      fail(node, fmt::format("the dataset {} stands here twice", quote(text)),
           "its points would count twice", "remove one");
    }
    datasets.push_back(path);
    fit_.dataset_places.push_back(at(node.source()));
  }

  void read_datasets(const toml::table& root) {
    const toml::node* const node = root.get("dataset");
    if (node == nullptr) {
      throw InputError({file(), 1, 1}, "the key 'dataset' is missing",
                       "it names the folder with the points",
                       "add dataset = \"../datasets/...\" above all tables");
    }
    const toml::array* const list = node->as_array();
    if (list == nullptr) {
      add_dataset(*node);
      return;
    }
    if (list->empty()) {
      fail(*node, "'dataset' is an empty list", "there would be nothing to fit",
           "name at least one dataset folder");
    }
    for (const toml::node& item : *list) add_dataset(item);
  }

  void read_model(const toml::table& model) {
    allow_only(model, "[model]", {"adhesion_damping_phase", "mechanisms"});
    if (const toml::node* node = model.get("adhesion_damping_phase")) {
      const std::string word = string(*node, "adhesion_damping_phase", "\"rebound\"");
      if (word != "rebound" && word != "both") {
        fail(*node, fmt::format("unknown phase {}", quote(word)),
             "the adhesion damping acts during the rebound or during both phases",
             did_you_mean(word, {"rebound", "both"}));
      }
      fit_.spec.phase = word == "both" ? AdhesionDampingPhase::both : AdhesionDampingPhase::rebound;
    }
    const toml::node* const mechanisms = model.get("mechanisms");
    if (mechanisms == nullptr) return;
    if (!mechanisms->is_array()) wrong_type(*mechanisms, "mechanisms", "a list", "mechanisms = []");
    for (const toml::node& item : *mechanisms->as_array()) add_mechanism(item);
  }

  void add_mechanism(const toml::node& item) {
    const std::string id = string(item, "mechanisms", "mechanisms = [\"plastic_yield\"]");
    std::vector<std::string> known;
    for (const Mechanism& mechanism : mechanism_catalogue()) known.emplace_back(mechanism.info.id);
    if (find_mechanism(id) == nullptr) {
      fail(item, fmt::format("unknown mechanism {}", quote(id)), "the catalogue does not have it",
           did_you_mean(id, known));
    }
    std::vector<std::string>& mechanisms = fit_.spec.mechanisms;
    if (std::find(mechanisms.begin(), mechanisms.end(), id) != mechanisms.end()) {
      fail(item, fmt::format("the mechanism {} stands here twice", quote(id)),
           "it acts once or not at all", "remove one");
    }
    mechanisms.push_back(id);
  }

  /// A parameter of a mechanism that the fit does not name is a likely slip.
  void refuse_parameters_of_others(const toml::table& parameters) const {
    for (const Mechanism& mechanism : mechanism_catalogue()) {
      const std::string id(mechanism.info.id);
      const auto& chosen = fit_.spec.mechanisms;
      if (std::find(chosen.begin(), chosen.end(), id) != chosen.end()) continue;
      for (const MechanismParameter& parameter : mechanism.info.parameters) {
        const toml::node* const node = parameters.get(parameter.name);
        if (node == nullptr) continue;
        fail(*node, fmt::format("'{}' belongs to the mechanism '{}'", parameter.name, id),
             "[model] does not name it", fmt::format("add \"{}\" to its mechanisms", id));
      }
    }
  }

  void read_parameters(const toml::table* parameters) {
    const std::vector<ParameterEntry> entries = parameters_with(fit_.spec.mechanisms);
    std::vector<std::string> names;
    for (const ParameterEntry& entry : entries) names.push_back(entry.name);
    if (parameters != nullptr) {
      refuse_parameters_of_others(*parameters);
      allow_only(*parameters, "[parameters]", names);
    }
    for (const ParameterEntry& entry : entries) {
      ParameterSpec spec{entry.name, entry.initial, entry.lower, entry.upper,
                         entry.free, false,         false};
      const toml::node* const node = parameters == nullptr ? nullptr : parameters->get(entry.name);
      if (node != nullptr) read_parameter(*node, entry, spec);
      fit_.spec.parameters.push_back(spec);
    }
  }

  void read_parameter(const toml::node& node, const ParameterEntry& entry, ParameterSpec& spec) {
    const std::string example = fmt::format("{} = {{ initial = {:g}, bounds = [{:g}, {:g}] }}",
                                            entry.name, entry.initial, entry.lower, entry.upper);
    if (!node.is_table()) wrong_type(node, entry.name, "a table", example);
    const toml::table& table = *node.as_table();
    allow_only(table, fmt::format("'{}'", entry.name), {"initial", "bounds", "free", "per"});
    if (const toml::node* free = table.get("free")) {
      spec.free = boolean(*free, "free");
    }
    if (const toml::node* per = table.get("per")) {
      const std::string word = string(*per, "per", "per = \"dataset\"");
      if (word != "dataset") {
        fail(*per, fmt::format("per = {}", quote(word)),
             "a parameter is shared by all datasets unless it is fitted for each",
             "write per = \"dataset\", or leave it out");
      }
      spec.per_dataset = true;
    }
    const toml::node* const bounds = table.get("bounds");
    if (bounds != nullptr) read_bounds(*bounds, entry, spec);
    const toml::node* const initial = table.get("initial");
    if (initial != nullptr) {
      spec.initial = admissible(*initial, "initial", entry);
      spec.initial_stated = true;
    }
    const bool derived = entry.name == "f0" && !spec.initial_stated;  // eq. 12, not known yet
    const bool outside = spec.initial < spec.lower || spec.initial > spec.upper;
    if (!derived && outside && (spec.free || bounds != nullptr)) {
      fail(initial != nullptr ? *initial : *bounds,
           fmt::format("the {}initial value {:g} of '{}' lies outside of its bounds",
                       spec.initial_stated ? "" : "default ", spec.initial, entry.name),
           fmt::format("the bounds are [{:g}, {:g}]", spec.lower, spec.upper),
           "choose an initial value within them");
    }
  }

  double admissible(const toml::node& node, const std::string& name,
                    const ParameterEntry& entry) const {
    const double value = number(node, name);
    if (!entry.mechanism.empty()) {
      if (value >= entry.lower && value <= entry.upper) return value;
      fail(node,
           fmt::format("'{}' of '{}' is {:g}{}", name, entry.name, value, unit_suffix(entry.unit)),
           fmt::format("the formula of '{}' holds from {:g} to {:g}", entry.mechanism, entry.lower,
                       entry.upper),
           "choose a value within");
    }
    if (value >= 0.0) return value;
    fail(node,
         fmt::format("'{}' of '{}' is {:g}{}", name, entry.name, value, unit_suffix(entry.unit)),
         fmt::format("the {} cannot be negative", entry.meaning), "0 is the lowest value");
  }

  void read_bounds(const toml::node& node, const ParameterEntry& entry, ParameterSpec& spec) const {
    const toml::array* const pair = node.as_array();
    if (pair == nullptr || pair->size() != 2) {
      fail(node, fmt::format("'bounds' of '{}' is not a pair of numbers", entry.name),
           "it has to be [lower, upper]",
           fmt::format("for example bounds = [{:g}, {:g}]", entry.lower, entry.upper));
    }
    spec.lower = admissible(*pair->get(0), "bounds", entry);
    spec.upper = admissible(*pair->get(1), "bounds", entry);
    if (spec.lower > spec.upper) {
      fail(node, fmt::format("the bounds of '{}' are the wrong way round", entry.name),
           fmt::format("{:g} is above {:g}", spec.lower, spec.upper),
           fmt::format("write bounds = [{:g}, {:g}]", spec.upper, spec.lower));
    }
    if (spec.lower == spec.upper) {
      fail(node, fmt::format("the bounds of '{}' leave no room", entry.name),
           fmt::format("both are {:g}", spec.lower),
           fmt::format("to fix it, write free = false, initial = {:g}", spec.lower));
    }
    if (entry.log_scale && spec.lower <= 0.0) {
      fail(*pair->get(0), fmt::format("the lower bound of '{}' is 0", entry.name),
           "its logarithm is fitted", fmt::format("{:g} is low enough", entry.lower));
    }
  }

  void read_uncertainty(const toml::table& table) {
    allow_only(table, "[uncertainty]", {"replicates", "scheme", "level", "seed"});
    UncertaintySpec& spec = fit_.spec.uncertainty;
    if (const toml::node* node = table.get("scheme")) {
      const std::string word = string(*node, "scheme", "scheme = \"auto\"");
      const std::optional<Scheme> scheme = scheme_named(word);
      if (!scheme) {
        fail(*node, fmt::format("unknown scheme {}", quote(word)),
             "the bootstrap would not know how to draw", did_you_mean(word, scheme_names()));
      }
      spec.scheme = *scheme;
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
      if (spec.level <= 0.0 || spec.level >= 1.0) {
        fail(*node, fmt::format("level = {:g}", spec.level), "it has to lie between 0 and 1",
             spec.level > 1.0 && spec.level < 100.0
                 ? fmt::format("{:g} % is written {:g}", spec.level, spec.level / 100.0)
                 : std::string("0.95 is usual"));
      }
    }
    if (const toml::node* node = table.get("seed")) {
      const std::int64_t seed = integer(*node, "seed");
      if (seed < 0) {
        fail(*node, fmt::format("seed = {}", seed), "seeds count from 0", "leave out the minus");
      }
      spec.seed = static_cast<std::uint64_t>(seed);
    }
  }

  const std::string& text_;
  std::filesystem::path folder_;
  LocatedFit fit_;
};

}  // namespace

const std::vector<ParameterEntry>& parameter_catalogue() {
  // Starts: C_H V = 0.03 costs 1 - e = 2/3 C_H V = 0.02 at 10 m/s, and this C_A makes the model
  // capture ammonium fluorescein of 4.9 um below about 1 m/s, both near what Wall et al. (1990)
  // saw. f0 starts at eq. 12 of its dataset unless the fit says otherwise; its number here is only
  // the magnitude of Table 1 of Li, Dunn & Brach (1999).
  static const std::vector<ParameterEntry> catalogue = {
      {"C_H", "s/m", "Hertz damping", 3e-3, 0.0, 1.0, true, false},
      {"C_A", "s/m", "adhesion damping", 3e-2, 0.0, 10.0, true, false},
      {"f0", "N/m", "adhesion force per length of the contact's edge", 10.0, 1e-6, 1e6, false,
       true},
  };
  return catalogue;
}

std::vector<ParameterEntry> parameters_with(const std::vector<std::string>& mechanisms) {
  std::vector<ParameterEntry> entries = parameter_catalogue();
  for (const Mechanism* mechanism : chain_of(mechanisms)) {
    for (const MechanismParameter& p : mechanism->info.parameters) {
      entries.push_back({std::string(p.name), std::string(p.unit), std::string(p.meaning),
                         p.initial, p.lower, p.upper, p.free, p.log_scale,
                         std::string(mechanism->info.id)});
    }
  }
  return entries;
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
                     "'dataset' is seen from the folder of this file", "correct the path");
  }
  return std::move(fit.spec);
}

}  // namespace recoil
