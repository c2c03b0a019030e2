// recoil._recoil, the compiled part of the package recoil (src/python/recoil). Results are passed
// to Python as the JSON that the commands write, so that names and digits are the same; many
// impacts are passed as arrays.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <future>
#include <limits>
#include <map>
#include <memory>
#include <mutex>

#include "analysis/analysis.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/numerics.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/units.hpp"
#include "coverage/coverage_truth.hpp"
#include "coverage/posterior_check.hpp"
#include "data/material_table.hpp"
#include "diagnosis/diagnose.hpp"
#include "document/html.hpp"
#include "document/terminal.hpp"
#include "estimate/predictor.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing_files.hpp"
#include "json/fit_file.hpp"
#include "options/option_requests.hpp"
#include "plot/draw.hpp"
#include "predict/polydisperse.hpp"
#include "predict/simulated_impact.hpp"
#include "report/comparison_report.hpp"
#include "report/diagnosis_report.hpp"
#include "report/fit_report.hpp"
#include "report/pairing_report.hpp"
#include "report/prediction_report.hpp"
#include "report/result_json.hpp"

namespace py = pybind11;

namespace recoil {
namespace {

/// Marks work in C++ that runs without the interpreter's lock. Its thread must reacquire the lock
/// at the end, which is impossible while the interpreter shuts down, so the exit waits for all
/// work.
class Busy {
 public:
  Busy() {
    const std::lock_guard lock(mutex());
    ++count();
  }
  ~Busy() {
    const std::lock_guard lock(mutex());
    --count();
    ended().notify_all();
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

  /// Cancels the work of all other threads and waits for its end.
  static void at_exit() {
    exiting() = true;
    const py::gil_scoped_release release;
    const CallingOff calling_off;
    std::unique_lock lock(mutex());
    ended().wait(lock, [] { return count() == 0; });
  }
  static std::atomic<bool>& exiting() {
    static std::atomic<bool> flag{false};
    return flag;
  }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static int& count() {
    static int number = 0;
    return number;
  }
  static std::condition_variable& ended() {
    static std::condition_variable one;
    return one;
  }
};

/// Releases the interpreter's lock during its lifetime, so that other Python threads run.
struct Released {
  Busy busy;
  py::gil_scoped_release release;
};

/// Runs `work` while other Python threads run, and returns its result. Ctrl-C cancels it, and all
/// other work of the process, with KeyboardInterrupt. `progress`: it is shown.
/// @pre the caller holds the interpreter's lock
template <class Work>
auto interruptible(const Work& work, bool progress = true) {
  constexpr auto poll_interval = std::chrono::milliseconds(50);
  const Busy busy;
  auto running = std::async(std::launch::async, [&] {
    const Progress::Silence silence(!progress);
    return work();
  });
  for (;;) {
    {
      const py::gil_scoped_release release;
      if (running.wait_for(poll_interval) == std::future_status::ready) break;
    }
    // Python delivers signals to its main thread only.
    if (PyErr_CheckSignals() == 0) continue;
    const py::error_already_set interrupt;
    {
      const py::gil_scoped_release release;
      const CallingOff calling_off;
      running.wait();
    }
    throw interrupt;
  }
  return running.get();
}

/// `function` as one that is `interruptible`.
template <class Result, class... Arguments>
auto cancellable(Result (*function)(Arguments...)) {
  return [function](Arguments... arguments, bool progress) {
    return interruptible([&] { return function(arguments...); }, progress);
  };
}

FitInputs inputs_from_text(const std::string& text, const std::string& file,
                           std::vector<Dataset> datasets) {
  return {parse_fit(text, file), std::move(datasets)};
}

/// The keyword arguments of a function that are options: name, meaning, and whether it takes
/// several values.
std::vector<std::tuple<std::string, std::string, bool>> option_meanings(
    const std::string& function) {
  std::vector<std::tuple<std::string, std::string, bool>> meanings;
  for (const OptionRow* row : arguments_of(function)) {
    const bool words = !row->type.words.empty() && !row->type.is_number();
    const bool bare = row->type.is_flag() || row->type.unit.empty();
    const std::string unit =
        bare || row->type.unit == "1" ? "" : fmt::format(" [{}]", row->type.unit);
    const std::string known = words ? fmt::format(": {}", fmt::join(row->type.words, ", ")) : "";
    meanings.emplace_back(row->python, fmt::format("{}{}{}", row->meaning, unit, known),
                          row->type.most > 1);
  }
  return meanings;
}

// ---- models ------------------------------------------------------------------------------------

/// Many impacts of one model, in columns.
struct ManyImpacts {
  /// [impacts], see ImpactResult; NaN if an impact cannot be solved.
  std::vector<double> restitution_squared;
  std::vector<std::uint8_t> captured;  ///< [impacts] 1: the sphere is captured
  /// [column][impacts]: d e^2 / d (each slot of the model, the velocity [s/m], the diameter [1/m]).
  std::vector<std::vector<double>> slopes;
};

void require_within(const std::vector<double>& values, double unit, const char* what,
                    const char* unit_name, std::pair<double, double> limits) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i] / unit;
    if (value >= limits.first && value <= limits.second) continue;
    throw InputError({}, fmt::format("the {} of impact {} is {:g} {}", what, i, value, unit_name),
                     "",
                     fmt::format("give a {} between {:g} and {:g} {}", what, limits.first,
                                 limits.second, unit_name));
  }
}

/// Simulates impacts at `velocity` [m/s] and `diameter` [m] in one batch, with the model's initial
/// values. @pre as many diameters as velocities
/// @throws InputError if one of them is not a number or outside `velocity_limits` or
///   `diameter_limits_um`
ManyImpacts simulate_many(const ImpactModel& model, std::size_t dataset,
                          const std::vector<double>& velocity, const std::vector<double>& diameter,
                          bool slopes) {
  require_within(velocity, units::m, "velocity", "m/s", velocity_limits);
  require_within(diameter, units::um, "diameter", "um", diameter_limits_um);
  const std::size_t count = velocity.size();
  const std::vector<double> theta = model.initial();
  const std::size_t slots = theta.size();
  ManyImpacts out;
  out.restitution_squared.assign(count, std::numeric_limits<double>::quiet_NaN());
  out.captured.assign(count, 0);
  if (slopes) {
    out.slopes.assign(slots + 2,
                      std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()));
  }
  std::vector<double> row(slots);
  // In parts, so that a large array can be cancelled between two of them.
  constexpr std::size_t part = 20000;
  for (std::size_t begin = 0; begin < count; begin += part) {
    const std::size_t end = std::min(count, begin + part);
    std::vector<PointConditions> points;
    for (std::size_t i = begin; i < end; ++i) points.push_back({dataset, diameter[i], velocity[i]});
    PointPredictor predictor(model, std::move(points));
    predictor.evaluate(theta, slopes);
    for (std::size_t i = begin; i < end; ++i) {
      const ImpactResult& result = predictor.at(i - begin);
      if (!result.usable()) continue;
      out.restitution_squared[i] = result.restitution_squared;
      out.captured[i] = result.restitution_squared > 0.0 ? 0 : 1;
      if (!slopes) continue;
      predictor.gradient_row(i - begin, 1.0, row);
      for (std::size_t s = 0; s < slots; ++s) out.slopes[s][i] = row[s];
      out.slopes[slots][i] = predictor.velocity_slope(i - begin);
      out.slopes[slots + 1][i] = predictor.diameter_slope(i - begin);
    }
  }
  return out;
}

/// A model with values, ready to be simulated.
struct Valued {
  ImpactModel model;
  std::vector<Dataset> datasets;
  std::string fit;
  std::string values;

  std::vector<std::string> labels() const {
    std::vector<std::string> names;
    for (const ParameterSlot& slot : model.slots) names.push_back(slot.label());
    return names;
  }
};

Valued model_of_fit(const FitInputs& inputs, const GivenOptions& given) {
  const std::string parameters = given.text("--parameters");
  Valued out = {make_model(inputs.spec, inputs.datasets), inputs.datasets, inputs.spec.id,
                "the initial values of the fit file"};
  if (const auto fitted = read_parameters(parameters)) {
    take_fitted_values(out.model, inputs.datasets, *fitted, parameters);
    out.values = parameters;
  }
  return out;
}

Valued fitted_model(const Analysis& analysis) {
  Valued out = {analysis.fitted.model, analysis.datasets, analysis.spec.id, "the fit"};
  for (std::size_t s = 0; s < out.model.slots.size(); ++s) {
    out.model.slots[s].initial = analysis.fitted.theta[s];
  }
  return out;
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<double> values_in(const Numbers& numbers, double unit) {
  std::vector<double> values(numbers.data(), numbers.data() + numbers.size());
  for (double& value : values) value *= unit;
  return values;
}

template <class T>
py::array_t<T> array_of(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::tuple simulate_columns(const Valued& valued, const Numbers& velocity,
                           const Numbers& diameter_um, const std::string& dataset, bool slopes) {
  const std::vector<double> v = values_in(velocity, units::m);
  const std::vector<double> d = values_in(diameter_um, units::um);
  const ManyImpacts many = interruptible([&] {
    return simulate_many(valued.model, choose_dataset(valued.datasets, dataset), v, d, slopes);
  });
  py::list columns;
  for (const std::vector<double>& column : many.slopes) columns.append(array_of(column));
  return py::make_tuple(array_of(many.restitution_squared), array_of(many.captured), columns);
}

/// The band of the curves of e of one diameter [um], from the draws of the bands of fit.json: its
/// lower and upper ends at every velocity [m/s].
std::pair<std::vector<double>, std::vector<double>> band_of(const Analysis& analysis,
                                                            const std::vector<double>& velocity,
                                                            double diameter_um,
                                                            const std::string& dataset) {
  require_within(velocity, units::m, "velocity", "m/s", velocity_limits);
  require_within({diameter_um}, 1.0, "diameter", "um", diameter_limits_um);
  const UncertaintyResult& assessed = analysis.uncertainty;
  RestitutionCurve curve;
  curve.dataset = choose_dataset(analysis.datasets, dataset);
  curve.diameter = diameter_um * units::um;
  curve.velocity = velocity;
  add_restitution(analysis.fitted.model, analysis.fitted.theta,
                  {assessed.bootstrap.theta, assessed.options.level, assessed.options.threads},
                  curve);
  if (curve.lower.size() == velocity.size()) return {curve.lower, curve.upper};
  const std::size_t fewest = fewest_replicates(assessed.options.level);
  throw InputError(
      {}, fmt::format("{} replicates give no band", assessed.bootstrap.theta.size()), "",
      fmt::format("fit with replicates={} or more", std::max<std::size_t>(fewest, 199)));
}

std::string one_impact(const Valued& valued, double velocity, double diameter_um,
                       const std::string& dataset) {
  const std::size_t d = choose_dataset(valued.datasets, dataset);
  const double diameter = diameter_um * units::um;
  simulate_many(valued.model, d, {velocity}, {diameter}, false);  // checks the limits
  return simulation_json(valued.model, valued.datasets,
                         simulate_at(valued.model, valued.datasets, {d, diameter, velocity}),
                         valued.fit, valued.values);
}

// ---- results -----------------------------------------------------------------------------------

Importance least_shown(bool verbose) { return verbose ? Importance::detail : Importance::answer; }

std::shared_ptr<Analysis> fit_of(const FitInputs& inputs, const GivenOptions& given) {
  auto analysis = std::make_shared<Analysis>(analyse(inputs, analysis_options(given)));
  add_predictions(*analysis);
  return analysis;
}

std::string summary_html(const Analysis& analysis) {
  std::vector<Section> shown;
  for (const Section& section : fit_sections(analysis)) {
    const bool answer = section.importance == Importance::answer && section.id != "picture";
    if (answer) shown.push_back(section);
  }
  return html_of(shown);
}

/// The profile likelihood of every free parameter by its label: values, rises and allowed rises.
py::dict profiles_of(const Analysis& analysis) {
  py::dict profiles;
  const std::vector<IntervalSet>& sets = analysis.uncertainty.intervals;
  for (std::size_t j = 0; j < sets.size(); ++j) {
    if (sets[j].profile_curve.empty()) continue;
    std::vector<double> value, rise, allowed;
    for (const ProfilePoint& point : sets[j].profile_curve) {
      value.push_back(point.value);
      rise.push_back(point.rise);
      allowed.push_back(point.allowed);
    }
    profiles[py::str(analysis.fitted.model.slots[j].label())] =
        py::make_tuple(value, rise, allowed);
  }
  return profiles;
}

/// The draws of the posterior as CSV, and ln likelihood of every point [points][draws].
py::tuple posterior_of(const Analysis& analysis) {
  const std::optional<PosteriorResult>& found = analysis.uncertainty.posterior;
  return py::make_tuple(posterior_csv(analysis),
                        found ? found->pointwise : std::vector<std::vector<double>>());
}

/// The pictures of a result, by name.
struct Pictures {
  std::vector<Figure> figures;

  std::map<std::string, std::string> titles() const {
    std::map<std::string, std::string> titles;
    for (const Figure& figure : figures) titles[figure.picture.name] = figure.picture.title;
    return titles;
  }
  std::string svg(const std::string& name) const {
    for (const Figure& figure : figures) {
      if (figure.picture.name == name) return plot::draw_svg(figure.picture);
    }
    throw InputError({}, "no picture " + name, "", "choose one of `pictures`");
  }
};

Pictures pictures_of(const Document& document) {
  Pictures pictures;
  for (const Section& section : document.sections) {
    for (const Figure* figure : figures_of(section)) pictures.figures.push_back(*figure);
  }
  return pictures;
}

struct Predicted {
  std::string json, text;
  Pictures pictures;
};

Predicted predict_for(const Analysis& analysis, const std::string& sizes_file,
                      const GivenOptions& given) {
  const PolydispersePrediction mixture = predict_sizes(
      analysis, load_sizes(sizes_file, given.text("--unit")), given.number_if_any("--height"),
      given.has("--midpoints"), given.text("--dataset"));
  return {json_prediction(analysis, mixture),
          text_prediction(analysis, mixture),
          {{mixture_figure(analysis, mixture)}}};
}

Diagnosis diagnosis_of(const Analysis& analysis, const GivenOptions& given) {
  DiagnosisOptions options;
  options.threads = static_cast<int>(given.whole("--threads"));
  options.seed = seed_of(given, analysis.spec);
  Diagnosis diagnosis = diagnose(analysis.spec, analysis.datasets, options);
  diagnosis.remarks = reconstruction_remarks(diagnosis.datasets);
  return diagnosis;
}

std::string coverage_of(const FitInputs& inputs, const GivenOptions& given) {
  CoverageOptions coverage;
  coverage.datasets = static_cast<int>(given.whole("--datasets"));
  coverage.uncertainty = uncertainty_options(inputs.spec, analysis_options(given));
  require_scheme(inputs.spec, coverage.uncertainty.scheme, gather(inputs.datasets));
  if (given.has("--posterior")) {
    const PosteriorStudy study =
        posterior_study(inputs.spec, inputs.datasets, coverage.uncertainty);
    return posterior_check_json(
        study, check_posterior(study, coverage.datasets, coverage.uncertainty.threads), inputs.spec,
        coverage);
  }
  const CoverageTruth truth =
      coverage_truth(inputs.spec, inputs.datasets, coverage.uncertainty.seed);
  return coverage_json(measure_coverage(inputs.spec, truth, coverage), inputs.spec, coverage,
                       inputs.datasets);
}

std::pair<std::string, std::string> compared(
    const std::vector<std::pair<std::string, std::string>>& named_texts) {
  std::vector<ComparedFit> fits;
  for (const auto& [name, text] : named_texts) fits.push_back(compared_fit(name, text));
  fits = told_apart(std::move(fits));
  return {comparison_json(fits), terminal_text(comparison_sections(fits))};
}

// ---- passages ----------------------------------------------------------------------------------

/// The texts that `recoil pair` prints and writes.
struct PairTexts {
  std::string json, text, points, impacts;
};

PairTexts pair_texts(const std::string& file, const GivenOptions& given) {
  const PairRequest request = pair_request(file, given);
  const PairedPassages paired =
      pair_and_average(read_passages(file, passage_format(given)), request);
  require_impacts(paired, request, "");
  const auto& [table, pairs, averages] = paired;
  return {pairing_json(table, pairs, averages), pairing_text(table, pairs, averages),
          points_csv(averages), impacts_csv(table, pairs)};
}

// ---- errors ------------------------------------------------------------------------------------

/// Raises an exception of a class of the package.
void raise_as(const char* name, const py::tuple& arguments) {
  const py::object type = py::module_::import("recoil._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(*arguments).ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const InputError& error) {
    raise_as("InputError", py::make_tuple(error.what(), error.where().file, error.where().line,
                                          error.where().column, error.problem(), error.why(),
                                          error.suggestion()));
  } catch (const ComputationError& error) {
    raise_as("ComputationError", py::make_tuple(error.what()));
  } catch (
      const CalledOff&) {  // cancelled by Ctrl-C in another thread, or by the end of the program
    PyErr_SetNone(Busy::exiting() ? PyExc_SystemExit : PyExc_KeyboardInterrupt);
  } catch (const std::filesystem::filesystem_error& error) {  // an unusable path
    const std::string problem = error.code().message();
    raise_as("InputError", py::make_tuple(error.path1().string() + ": " + problem,
                                          error.path1().string(), 0, 0, problem));
  }
}

// ---- bindings ----------------------------------------------------------------------------------

void bind_inputs(py::module_& module) {
  module.def(
      "write_whole_files",
      [](const std::vector<std::pair<std::filesystem::path, std::string>>& files, bool replace) {
        std::vector<WholeFile> whole;
        for (const auto& [path, text] : files) whole.push_back({path, text});
        write_whole_files(whole, replace ? Replacing::data : Replacing::results);
      },
      py::arg("files"), py::arg("replace"), py::call_guard<Released>());
  module.def(
      "read_text_file", [](const std::filesystem::path& file) { return read_text_file(file); },
      py::arg("file"), py::call_guard<Released>());
  py::class_<Dataset>(module, "Dataset")
      .def_readonly("id", &Dataset::id)
      .def_readonly("title", &Dataset::title)
      .def_readonly("sha256", &Dataset::sha256)
      .def_readonly("sources", &Dataset::sources)
      .def_property_readonly("folder", [](const Dataset& d) { return d.folder.string(); })
      .def_property_readonly("provenance",
                             [](const Dataset& d) { return std::string(to_string(d.provenance)); })
      .def_property_readonly("points", [](const Dataset& d) { return d.points.size(); });
  module.def("load_dataset", &load_dataset, py::arg("folder"));
  module.def("parse_dataset", &parse_dataset, py::arg("package"), py::arg("csv"),
             py::arg("folder"));
  module.def(
      "material",
      [](const std::string& name, const std::string& body) {
        return tabled_material(name, body).dump();
      },
      py::arg("name"), py::arg("body"));

  py::class_<FitInputs>(module, "Inputs")
      .def_property_readonly("id", [](const FitInputs& inputs) { return inputs.spec.id; })
      .def_property_readonly("datasets", [](const FitInputs& inputs) { return inputs.datasets; });
  module.def("load_fit", &load_inputs, py::arg("file"));
  module.def("parse_fit", &inputs_from_text, py::arg("text"), py::arg("file"), py::arg("datasets"));

  py::class_<GivenOptions>(module, "Options")
      .def(py::init(&GivenOptions::of_python), py::arg("function"), py::arg("arguments"));
  module.def("option_meanings", &option_meanings, py::arg("function"));
}

void bind_models(py::module_& module) {
  py::class_<Valued>(module, "Model")
      .def_property_readonly("labels", &Valued::labels)
      .def_property_readonly("values", [](const Valued& v) { return v.model.initial(); })
      .def("simulate", &simulate_columns, py::arg("velocity"), py::arg("diameter_um"),
           py::arg("dataset"), py::arg("slopes"))
      .def("impact", &one_impact, py::arg("velocity"), py::arg("diameter_um"), py::arg("dataset"),
           py::call_guard<Released>());
  module.def("model_of_fit", &model_of_fit, py::arg("inputs"), py::arg("options"));
}

void bind_results(py::module_& module) {
  py::class_<Pictures>(module, "Pictures")
      .def("titles", &Pictures::titles)
      .def("svg", &Pictures::svg, py::arg("name"), py::call_guard<Released>());

  py::class_<Analysis, std::shared_ptr<Analysis>>(module, "Analysis")
      .def("json", &fit_json, py::call_guard<Released>())
      .def(
          "text", [](const Analysis& a, bool verbose) { return fit_text(a, least_shown(verbose)); },
          py::arg("verbose"), py::call_guard<Released>())
      .def(
          "page", [](const Analysis& a) { return fit_html(a); }, py::call_guard<Released>())
      .def("summary", &summary_html, py::call_guard<Released>())
      .def(
          "pictures", [](const Analysis& a) { return pictures_of(fit_document(a)); },
          py::call_guard<Released>())
      .def("profiles", &profiles_of)
      .def("posterior", &posterior_of)
      .def("model", &fitted_model)
      .def("band", cancellable(&band_of), py::arg("velocity"), py::arg("diameter_um"),
           py::arg("dataset"), py::arg("progress") = false)
      .def("predict", cancellable(&predict_for), py::arg("sizes"), py::arg("options"),
           py::arg("progress"))
      .def("diagnose", cancellable(&diagnosis_of), py::arg("options"), py::arg("progress"));
  module.def("fit", cancellable(&fit_of), py::arg("inputs"), py::arg("options"),
             py::arg("progress"));

  py::class_<Predicted>(module, "Predicted")
      .def_readonly("json", &Predicted::json)
      .def_readonly("text", &Predicted::text)
      .def_readonly("pictures", &Predicted::pictures);

  py::class_<Diagnosis>(module, "Diagnosis")
      .def("json", &diagnosis_json, py::call_guard<Released>())
      .def(
          "text",
          [](const Diagnosis& d, bool verbose) { return diagnosis_text(d, least_shown(verbose)); },
          py::arg("verbose"), py::call_guard<Released>())
      .def("page", &diagnosis_html, py::call_guard<Released>())
      .def(
          "summary", [](const Diagnosis& d) { return html_of(diagnosis_summary(d).blocks, false); },
          py::call_guard<Released>())
      .def(
          "pictures", [](const Diagnosis& d) { return pictures_of(diagnosis_document(d)); },
          py::call_guard<Released>())
      .def("extended_toml",
           [](const Diagnosis& d, const std::string& folder) { return extended_toml(d, folder); });

  module.def("coverage", cancellable(&coverage_of), py::arg("inputs"), py::arg("options"),
             py::arg("progress"));
  module.def("compare", &compared, py::arg("named_texts"), py::call_guard<Released>());
}

void bind_pairs(py::module_& module) {
  py::class_<PairTexts>(module, "PairTexts")
      .def_readonly("json", &PairTexts::json)
      .def_readonly("text", &PairTexts::text)
      .def_readonly("points", &PairTexts::points)
      .def_readonly("impacts", &PairTexts::impacts);
  module.def("pair", cancellable(&pair_texts), py::arg("file"), py::arg("options"),
             py::arg("progress") = false);
}

}  // namespace
}  // namespace recoil

PYBIND11_MODULE(_recoil, module) {
  recoil::gsl_errors_are_values();
  recoil::Progress::show_in_this_process();
  py::register_exception_translator(&recoil::translate);
  module.attr("__version__") = recoil::version();
  py::module_::import("atexit").attr("register")(py::cpp_function(&recoil::Busy::at_exit));
  recoil::bind_inputs(module);
  recoil::bind_models(module);
  recoil::bind_results(module);
  recoil::bind_pairs(module);
}
