#include "estimate/fit_spec.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/files.hpp"
#include "support/mistake.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;
using support::changed;
using support::expect_mistake;
using support::Mistake;

const std::string full = R"(dataset = "../datasets/quartz"
[model]
adhesion_damping_phase = "both"
mechanisms = []
[parameters]
C_H = { initial = 2e-3, bounds = [0, 0.5] }
C_A = { initial = 0.1, bounds = [0.01, 5], per = "dataset" }
f0 = { free = true, initial = 6, bounds = [1, 20] }
[uncertainty]
replicates = 499
level = 0.9
seed = 7
[noise]
variance = "capture"
residuals = "student"
student_dof = 5
velocity_relative_sd = 0.02
diameter_errors = false
)";

std::optional<InputError> error_in(const std::string& text) {
  return support::error_of([&] { parse_fit(text, "fit.toml"); });
}

TEST(ParseFit, ReadsEveryKey) {
  const FitSpec spec = parse_fit(full, "fits/quartz.toml");
  EXPECT_EQ(spec.id, "quartz");
  EXPECT_EQ(spec.file, fs::path("fits/quartz.toml"));
  ASSERT_EQ(spec.datasets.size(), 1U);
  EXPECT_EQ(spec.datasets[0], fs::path("datasets/quartz"));
  EXPECT_EQ(spec.phase, AdhesionDampingPhase::both);
  EXPECT_TRUE(spec.mechanisms.empty());
  ASSERT_EQ(spec.parameters.size(), 3U);
  const ParameterSpec& c_a = spec.parameters[1];
  EXPECT_EQ(c_a.parameter->name, "C_A");
  EXPECT_EQ(c_a.initial, 0.1);
  EXPECT_EQ(c_a.lower, 0.01);
  EXPECT_EQ(c_a.upper, 5.0);
  EXPECT_TRUE(c_a.free);
  EXPECT_TRUE(c_a.per_dataset);
  EXPECT_TRUE(c_a.initial_stated);
  const ParameterSpec& f0 = spec.parameters[2];
  EXPECT_TRUE(f0.free);
  EXPECT_TRUE(f0.initial_stated);
  EXPECT_EQ(f0.initial, 6.0);
  EXPECT_EQ(spec.uncertainty.replicates, 499);
  EXPECT_EQ(spec.uncertainty.level, 0.9);
  EXPECT_EQ(spec.uncertainty.seed, 7U);
  EXPECT_EQ(spec.noise.variance, VarianceFunction::capture);
  EXPECT_EQ(spec.variance_place.line, 14);
  EXPECT_TRUE(spec.noise.student);
  EXPECT_EQ(spec.noise.student_dof, 5.0);
  EXPECT_FALSE(spec.noise.setting_sd);
  EXPECT_TRUE(spec.noise.velocity_errors);
  EXPECT_EQ(spec.noise.velocity_relative_sd, 0.02);
  EXPECT_FALSE(spec.noise.diameter_errors);
  EXPECT_EQ(spec.noise.diameter_relative_sd, 0.0);
  EXPECT_EQ(spec.sha256, sha256_hex(full));
}

TEST(ParseFit, EveryKeyButDatasetHasADefault) {
  const FitSpec spec = parse_fit("dataset = \"d\"\n", "fit.toml");
  EXPECT_EQ(spec.datasets[0], fs::path("d"));
  EXPECT_EQ(spec.phase, AdhesionDampingPhase::rebound);
  ASSERT_EQ(spec.parameters.size(), base_parameters().size());
  for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
    const Parameter& entry = base_parameters()[i];
    EXPECT_EQ(spec.parameters[i].parameter, &entry);
    EXPECT_EQ(spec.parameters[i].initial, entry.initial);
    EXPECT_EQ(spec.parameters[i].lower, entry.lower);
    EXPECT_EQ(spec.parameters[i].upper, entry.upper);
    EXPECT_EQ(spec.parameters[i].free, entry.free);
    EXPECT_FALSE(spec.parameters[i].per_dataset);
    EXPECT_FALSE(spec.parameters[i].initial_stated);
  }
  EXPECT_EQ(spec.uncertainty.replicates, 1999);
  EXPECT_EQ(spec.uncertainty.level, 0.95);
  EXPECT_EQ(spec.uncertainty.seed, 20260101U);
  EXPECT_FALSE(spec.noise.variance.has_value());  // "auto"
  EXPECT_FALSE(spec.noise.student);
  EXPECT_TRUE(spec.noise.velocity_errors && spec.noise.diameter_errors);
  EXPECT_EQ(spec.noise.velocity_relative_sd, 0.0);
}

TEST(ParseFit, AutomaticVarianceMayBeWrittenDown) {
  EXPECT_FALSE(parse_fit(changed(full, "\"capture\"", "\"auto\""), "f.toml").noise.variance);
}

TEST(ParseFit, TakesSeveralDatasets) {
  const FitSpec spec = parse_fit("dataset = [\"a\", \"../b/\", \"/c\"]", "fits/all.toml");
  EXPECT_EQ(spec.datasets, (std::vector<fs::path>{"fits/a", "b", "/c"}));
}

TEST(ParseFit, AFixedParameterNeedsNoBounds) {
  const FitSpec spec = parse_fit(
      "dataset = \"d\"\n[parameters]\nf0 = { free = false, initial = 0 }\n"
      "C_H = { free = false, initial = 2 }\n",
      "fit.toml");
  EXPECT_EQ(spec.parameters[0].initial, 2.0);
  EXPECT_EQ(spec.parameters[2].initial, 0.0);
  EXPECT_TRUE(spec.parameters[2].initial_stated);
}

TEST(ParseFit, BootstrapMayBeLeftOut) {
  EXPECT_EQ(parse_fit(changed(full, "499", "0"), "f.toml").uncertainty.replicates, 0);
  EXPECT_EQ(parse_fit(changed(full, "499", "19"), "f.toml").uncertainty.replicates, 19);
}

TEST(ParameterCatalogue, IsConsistent) {
  const auto& catalogue = base_parameters();
  ASSERT_EQ(catalogue.size(), 3U);
  EXPECT_EQ(catalogue[0].name, "C_H");
  EXPECT_EQ(catalogue[1].name, "C_A");
  EXPECT_EQ(catalogue[2].name, "f0");
  for (const Parameter& entry : catalogue) {
    EXPECT_FALSE(entry.unit.empty());
    EXPECT_FALSE(entry.meaning.empty());
    EXPECT_LT(entry.lower, entry.upper);
    EXPECT_GE(entry.initial, entry.lower);
    EXPECT_LE(entry.initial, entry.upper);
    EXPECT_GE(entry.lower, 0.0);
    EXPECT_TRUE(!entry.log_scale || entry.lower > 0.0) << entry.name;
  }
  EXPECT_FALSE(catalogue[2].free) << "f0 follows from eq. 12 unless a fit asks for more";
}

class FitMistake : public testing::TestWithParam<Mistake> {};

TEST_P(FitMistake, IsOneClearLine) {
  const Mistake& mistake = GetParam();
  expect_mistake(error_in(changed(full, mistake.old_text, mistake.new_text)), mistake);
}

const std::string c_h = "C_H = { initial = 2e-3, bounds = [0, 0.5] }";

const Mistake mistakes[] = {
    // TOML itself.
    {"syntax", "[model]", "[model", "fit.toml:2:7: ", "expected ']'", "correct this"},
    {"repeated_key", "seed = 7", "level = 0.8", "fit.toml:12:", "level", "correct this"},
    {"not_utf8", "quartz", "\xFF", "fit.toml:1:24: ", "byte 0xFF is not UTF-8", "save"},
    {"binary", "quartz", std::string(1, '\0'), "fit.toml:1:24: ", "NUL", "UTF-8"},
    // Unknown keys.
    {"unknown_top_key", "dataset =", "datset =", "fit.toml:1:1: ", "unknown key 'datset'",
     "did you mean 'dataset'?"},
    {"unknown_table", "[uncertainty]", "[uncertanty]", "fit.toml:9:2: ", "unknown key 'uncertanty'",
     "did you mean 'uncertainty'?"},
    {"unknown_model_key", "mechanisms", "mechanism", "fit.toml:4:1: ", "unknown key 'mechanism'",
     "did you mean 'mechanisms'?"},
    {"unknown_parameter", "C_H", "C_h", "fit.toml:6:1: ", "unknown key 'C_h'",
     "did you mean 'C_H'?"},
    {"unknown_parameter_key", "bounds", "bound", "fit.toml:6:25: ", "unknown key 'bound'",
     "did you mean 'bounds'?"},
    {"unknown_uncertainty_key", "replicates", "replicats",
     "fit.toml:10:1: ", "unknown key 'replicats'", "did you mean 'replicates'?"},
    // The datasets.
    {"dataset_number", "\"../datasets/quartz\"", "7", "fit.toml:1:11: ", "'dataset' is a number",
     "for example"},
    {"dataset_empty", "\"../datasets/quartz\"", "\"\"", "fit.toml:1:11: ", "names no folder",
     "write the path"},
    {"dataset_empty_list", "\"../datasets/quartz\"", "[]", "fit.toml:1:11: ", "empty list",
     "name at least one"},
    {"dataset_list_of_numbers", "\"../datasets/quartz\"", "[\"a\", 3]",
     "fit.toml:1:17: ", "'dataset' is a number", "for example"},
    {"dataset_twice", "\"../datasets/quartz\"", "[\"a\", \"./b/../a/\"]",
     "fit.toml:1:17: ", "appears twice", "remove one"},
    {"dataset_two_lines", "../datasets", "a\\nb", "fit.toml:1:11: ", "names no folder", "write"},
    // The model.
    {"model_no_table", "[model]\nadhesion_damping_phase = \"both\"\nmechanisms = []", "model = 3",
     "fit.toml:2:9: ", "'model' is a number", "[model]"},
    {"phase_unknown", "\"both\"", "\"rebouns\"", "fit.toml:3:26: ", "unknown phase 'rebouns'",
     "did you mean 'rebound'?"},
    {"phase_number", "\"both\"", "1", "fit.toml:3:26: ", "is a number", "\"rebound\""},
    {"mechanism_unknown", "[]", "[\"jkr_histeresis\"]", "fit.toml:4:15: ", "'jkr_histeresis'",
     "did you mean 'jkr_hysteresis'?"},
    {"mechanisms_string", "[]", "\"none\"", "fit.toml:4:14: ", "is a text", "mechanisms = []"},
    // The parameters.
    {"parameter_number", c_h, "C_H = 2e-3", "fit.toml:6:7: ", "'C_H' is a number", "initial ="},
    {"initial_text", "2e-3", "\"much\"", "fit.toml:6:19: ", "'initial' is a text", "for example"},
    {"initial_nan", "2e-3", "nan", "fit.toml:6:19: ", "'initial' is nan", "write a number"},
    {"initial_infinite", "2e-3", "inf", "fit.toml:6:19: ", "'initial' is inf", "write a number"},
    {"initial_negative", "2e-3", "-2e-3", "fit.toml:6:19: ", "'initial' of 'C_H' is -0.002 s/m",
     "0 is the lowest"},
    {"initial_outside", "2e-3", "0.6", "fit.toml:6:19: ", "0.6 of 'C_H' lies outside", "within"},
    {"default_initial_outside", c_h, "C_H = { bounds = [0.1, 0.5] }",
     "fit.toml:6:18: ", "the default initial value 0.003 of 'C_H' lies outside", "within"},
    {"fixed_outside_its_own_bounds", "2e-3,", "0.6, free = false,",
     "fit.toml:6:19: ", "0.6 of 'C_H' lies outside", "within"},
    {"bounds_reversed", "[0, 0.5]", "[0.5, 0]", "fit.toml:6:34: ", "wrong way round",
     "write bounds = [0, 0.5]"},
    {"bounds_equal", "[0, 0.5]", "[0.5, 0.5]", "fit.toml:6:34: ", "are both 0.5", "free = false"},
    {"bounds_negative", "[0, 0.5]", "[-1, 0.5]", "fit.toml:6:35: ", "'bounds' of 'C_H' is -1",
     "0 is the lowest"},
    {"bounds_nan", "[0, 0.5]", "[0, nan]", "fit.toml:6:38: ", "'bounds' is nan", "write a number"},
    {"bounds_one", "[0, 0.5]", "[0]", "fit.toml:6:34: ", "is not [lower, upper]", "for example"},
    {"bounds_three", "[0, 0.5]", "[0, 1, 2]", "fit.toml:6:34: ", "is not [lower, upper]",
     "for example"},
    {"bounds_beyond_exact_doubles", "[0, 0.5]", "[44444444442603404, 0.5]",
     "fit.toml:6:35: ", "no impact has so much", "at most 1e+09"},
    {"bounds_number", "[0, 0.5]", "1", "fit.toml:6:34: ", "is not [lower, upper]", "for example"},
    {"bounds_text", "[0, 0.5]", "[0, \"1\"]", "fit.toml:6:38: ", "is a text", "for example"},
    {"log_bound_zero", "[1, 20]", "[0, 20]", "fit.toml:8:44: ", "the lower bound of 'f0' is 0",
     "1e-06"},
    {"free_number", "free = true", "free = 1", "fit.toml:8:15: ", "is a number", "free = false"},
    {"per_unknown", "per = \"dataset\"", "per = \"series\"", "fit.toml:7:50: ", "per = 'series'",
     "per = \"dataset\""},
    // The uncertainty.
    {"replicates_few", "499", "18", "fit.toml:10:14: ", "replicates = 18", "0 leaves"},
    {"replicates_negative", "499", "-5", "fit.toml:10:14: ", "replicates = -5", "1999 is usual"},
    {"replicates_huge", "499", "9000000000", "fit.toml:10:14: ", "replicates = 9000000000",
     "1999 is usual"},
    {"replicates_fraction", "499", "499.5", "fit.toml:10:14: ", "is a number, not a whole number",
     "for example"},
    {"level_per_cent", "0.9", "95", "fit.toml:11:9: ", "level = 95", "95 % is written 0.95"},
    {"level_zero", "0.9", "0.0", "fit.toml:11:9: ", "level = 0", "0.95 is usual"},
    {"level_one", "0.9", "1", "fit.toml:11:9: ", "level = 1", "0.95 is usual"},
    {"level_tiny", "0.9", "5e-324", "fit.toml:11:9: ", "level", "0.95 is usual"},
    {"level_low", "0.9", "0.49", "fit.toml:11:9: ", "level", "0.95 is usual"},
    {"level_high", "0.9", "0.99991", "fit.toml:11:9: ", "level", "0.95 is usual"},
    {"bounds_huge", c_h, "C_H = { initial = 2e-3, bounds = [0, 1e300] }", "fit.toml:6:", "C_H",
     "at most"},
    {"level_nan", "0.9", "nan", "fit.toml:11:9: ", "'level' is nan", "write a number"},
    {"materials_word", "seed = 7", "materials = \"adjsut\"",
     "fit.toml:12:13: ", "materials = 'adjsut'", "adjust"},
    {"seed_negative", "seed = 7", "seed = -7", "fit.toml:12:8: ", "seed = -7", "minus"},
    // The noise.
    {"unknown_noise_key", "velocity_relative_sd", "velocity_relativ_sd", "fit.toml:17:1: ",
     "unknown key 'velocity_relativ_sd'", "did you mean 'velocity_relative_sd'?"},
    {"variance_unknown", "\"capture\"", "\"captured\"",
     "fit.toml:14:12: ", "unknown variance function 'captured'", "did you mean 'capture'?"},
    {"variance_number", "\"capture\"", "2", "fit.toml:14:12: ", "is a number", "auto"},
    {"residuals_unknown", "\"student\"", "\"studnt\"", "fit.toml:15:13: ",
     "unknown distribution of the residuals 'studnt'", "did you mean 'student'?"},
    {"student_dof_alone", "residuals = \"student\"\n", "",
     "fit.toml:15:15: ", "'student_dof' without Student's t", "residuals = \"student\""},
    {"student_dof_low", "student_dof = 5", "student_dof = 0.5",
     "fit.toml:16:15: ", "student_dof = 0.5", "4 is usual"},
    {"setting_sd_beside_student", "student_dof = 5", "setting_sd = 0.01",
     "fit.toml:16:14: ", "setting_sd beside residuals = \"student\"", "remove one of the two"},
    {"setting_sd_word", "student_dof = 5", "setting_sd = \"guess\"",
     "fit.toml:16:14: ", "setting_sd = 'guess'", "estimated"},
    {"setting_sd_per_cent", "student_dof = 5", "setting_sd = 1",
     "fit.toml:16:14: ", "setting_sd = 1", "0.01 is usual"},
    {"velocity_sd_per_cent", "= 0.02", "= 2", "fit.toml:17:24: ", "velocity_relative_sd = 2",
     "0.02"},
    {"velocity_sd_negative", "= 0.02", "= -0.02",
     "fit.toml:17:24: ", "velocity_relative_sd = -0.02", "0.02"},
    {"diameter_errors_number", "errors = false", "errors = 0", "fit.toml:18:19: ", "is a number",
     "diameter_errors = false"},
    {"error_size_of_an_ignored_error", "errors = false",
     "errors = false\ndiameter_relative_sd = 0.1",
     "fit.toml:19:24: ", "'diameter_relative_sd' is given though", "remove one"},
    {"seed_fraction", "seed = 7", "seed = 7.5",
     "fit.toml:12:8: ", "is a number, not a whole number", "for example"},
};

INSTANTIATE_TEST_SUITE_P(Each, FitMistake, testing::ValuesIn(mistakes), support::name_of);

TEST(ParseFit, NeedsADataset) {
  expect_mistake(error_in(""),
                 {"", "", "", "fit.toml:1:1: ", "'dataset' is missing", "add dataset"});
}

TEST(ParseFit, SurvivesTheLossOfAnyByte) {
  for (std::size_t i = 0; i < full.size(); ++i) {
    std::string text = full;
    text.erase(i, 1);
    for (const std::string& damaged : {text, full.substr(0, i)}) {
      const std::string message = support::message_of([&] { parse_fit(damaged, "fit.toml"); });
      EXPECT_TRUE(message == "no error" || message.starts_with("fit.toml:")) << message;
      EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
    }
  }
}

TEST(LoadFit, LooksForTheDatasetsFromTheFilesFolder) {
  const support::TemporaryFolder folder;
  fs::create_directories(folder / "datasets" / "quartz");
  const fs::path file = folder / "fits" / "one.toml";
  folder.write("fits/one.toml", full);
  const FitSpec spec = load_fit(file);
  EXPECT_TRUE(fs::equivalent(spec.datasets[0], folder / "datasets" / "quartz"));
  EXPECT_EQ(spec.sha256, sha256_hex(full));
  folder.write("fits/one.toml", "dataset = [\"../datasets/quartz\",\n  \"../datasets/mica\"]\n");
  expect_mistake(support::error_of([&] { load_fit(file); }),
                 {"", "", "", file.string() + ":2:3: ", "there is no folder", "correct the path"});
  fs::remove(file);
  EXPECT_THROW(load_fit(file), InputError);
}

}  // namespace
}  // namespace recoil
