#include "validation/studies/event_chain.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "report/corrections_document.hpp"
#include "validation/recipe/paired_points.hpp"
#include "validation/studies/corrections.hpp"

namespace recoil {
namespace {

struct Reconstruction {
  Reconstruction(const std::filesystem::path& root, const std::string& id)
      : recipe(load_recipe(root / "datasets" / id)),
        dataset(load_dataset(recipe.folder)),
        spec(load_fit(root / "fits" / (id + ".toml"))) {}

  CorrectionStudy study(int times, std::size_t classes,
                        std::span<const Correction> ways = all_ways) const {
    AverageOptions averaging = recipe_averaging(recipe);
    averaging.per_bin = averaging.per_bin * static_cast<std::size_t>(times) / classes;
    averaging.size_classes = classes;
    averaging.mean_diameter = classes == 1;
    return study_corrections(spec, dataset, known_passages(recipe, times), recipe_pairing(recipe),
                             averaging, ways);
  }

  Recipe recipe;
  Dataset dataset;
  FitSpec spec;
};

class Mean {
 public:
  void add(double value) {
    sum_ += value;
    squares_ += value * value;
    ++count_;
  }
  StreamMean result() const {
    const double mean = sum_ / count_;
    const double variance = std::max(squares_ / count_ - mean * mean, 0.0);
    return {mean, std::sqrt(variance / (count_ - 1))};
  }

 private:
  double sum_ = 0.0;
  double squares_ = 0.0;
  int count_ = 0;
};

constexpr int other_streams = 10;

OtherStreams with_other_numbers(Reconstruction of, std::size_t classes) {
  constexpr std::array base = {Correction::none_left_out};
  OtherStreams others;
  others.dataset = of.recipe.id;
  others.size_classes = classes;
  Mean slow, fast, C_H, C_A, capture;
  for (int k = 0; k < other_streams; ++k) {
    ++of.recipe.seed;
    const CorrectionRow row = of.study(20, classes, base).rows.front();
    if (!row.usable) return others;
    slow.add(row.error_slow.value_or(0.0));
    fast.add(row.error_fast.value_or(0.0));
    C_H.add(row.C_H);
    C_A.add(row.C_A);
    capture.add(row.capture_velocity);
  }
  others.usable = true;
  others.error_slow = slow.result();
  others.error_fast = fast.result();
  others.C_H = C_H.result();
  others.C_A = C_A.result();
  others.capture_velocity = capture.result();
  return others;
}

Json json_of(const StreamMean& mean) { return {{"mean", mean.mean}, {"error", mean.error}}; }
StreamMean mean_at(const Json& json, const char* key) {
  return {json.at(key).at("mean"), json.at(key).at("error")};
}

// ---- words -----------------------------------------------------------------------------------

Cell signed_cell(const std::optional<double>& value) {
  return value ? Cell(Sentence(fmt::format("{:+.4f}", *value))) : Cell();
}

Cell with_error(double value, double error) {
  return error > 0.0 ? say("{:.4f} {+/-} {:.4f}", value, error) : say("{:.4f} (bound)", value);
}

Sentence heading_e_slow() { return say("e - truth below {:g} m/s", slow_impacts); }

Section section_of(const EventChain::Chain& chain) {
  const CorrectionStudy& study = chain.study;
  Table table;
  table.columns = {{"from the passages", {}, true},
                   {"points"},
                   {"captured"},
                   {heading_e_slow()},
                   {"and above"},
                   {symbol("C_H"), "s/m"},
                   {symbol("C_A"), "s/m"},
                   {symbol("V*") + Sentence(" at d10"), "m/s"},
                   {"rms of e"}};
  table.rows.push_back({Sentence("the truth of the recipe"), Sentence(), Sentence(), Sentence(),
                        Sentence(), Sentence(fmt::format("{:g}", study.C_H)),
                        Sentence(fmt::format("{:g}", study.C_A)),
                        Sentence(fmt::format("{:.3f}", study.capture_velocity)), Sentence()});
  for (const CorrectionRow& row : study.rows) {
    std::vector<Cell> cells = {Sentence(words_of(row.left_out)),
                               Sentence(std::to_string(row.points)),
                               Sentence(std::to_string(row.captured)), signed_cell(row.error_slow),
                               signed_cell(row.error_fast)};
    if (row.usable) {
      cells.insert(cells.end(), {with_error(row.C_H, row.C_H_sd), with_error(row.C_A, row.C_A_sd),
                                 Sentence(fmt::format("{:.3f}", row.capture_velocity)),
                                 Sentence(fmt::format("{:.4f}", row.rmse))});
    } else {
      cells.insert(cells.end(), {Sentence("no usable fit"), Cell(), Cell(), Cell()});
    }
    table.rows.push_back(std::move(cells));
  }
  Section section;
  section.title = code(chain.dataset) + say(", {:g} spheres seen to rebound per drop height, {}",
                                            study.rebounds_per_velocity,
                                            study.size_classes > 1
                                                ? fmt::format("{} size classes", study.size_classes)
                                                : std::string("all sizes in one point"));
  section.blocks = {Paragraph{say("{} passages.", study.passages)}, table};
  return section;
}

Sentence mean_words(const StreamMean& mean, int decimals) {
  return Sentence(fmt::format("{:.{}f}", mean.mean, decimals)) +
         say(" {+/-} {}", fmt::format("{:.{}f}", mean.error, decimals));
}

Section others_section(const std::vector<OtherStreams>& others) {
  Table table;
  table.columns = {{"reconstruction", {}, true},
                   {"size classes"},
                   {heading_e_slow()},
                   {"and above"},
                   {symbol("C_H"), "s/m"},
                   {symbol("C_A"), "s/m"},
                   {symbol("V*") + Sentence(" at d10"), "m/s"}};
  for (const OtherStreams& of : others) {
    std::vector<Cell> cells = {code(of.dataset), Sentence(std::to_string(of.size_classes))};
    if (of.usable) {
      cells.insert(cells.end(), {mean_words(of.error_slow, 5), mean_words(of.error_fast, 5),
                                 mean_words(of.C_H, 5), mean_words(of.C_A, 5),
                                 mean_words(of.capture_velocity, 4)});
    } else {
      cells.insert(cells.end(),
                   {Sentence("a fit without an answer"), Cell(), Cell(), Cell(), Cell()});
    }
    table.rows.push_back(std::move(cells));
  }
  Section section;
  section.title = "Other random numbers";
  section.blocks = {
      Paragraph{
          "All corrections, 800 spheres per drop height, mean over ten other streams of passages "
          "with its standard error. What is left here is not the chance of the tables above: the "
          "part that goes away with finer size classes is due to the mixture of sizes within a "
          "class (their mean e is not the e of their mean size, and the smallest are missing from "
          "it); the part that stays belongs to the chain itself."},
      table};
  return section;
}

}  // namespace

EventChain study_event_chain(const std::filesystem::path& root) {
  const Reconstruction fine(root, "li1999-sst65-silicon");
  const Reconstruction coarse(root, "li1999-sst125-silicon");
  EventChain chain;
  for (const Reconstruction* of : {&fine, &coarse}) {
    for (const std::size_t classes : {1UL, 4UL}) {
      chain.chains.push_back({of->recipe.id, of->study(1, classes)});
    }
    for (const std::size_t classes : {1UL, 4UL, 16UL}) {
      chain.chains.push_back({of->recipe.id, of->study(20, classes)});
    }
  }
  for (const Reconstruction* of : {&fine, &coarse}) {
    for (const std::size_t classes : {4UL, 16UL}) {
      chain.others.push_back(with_other_numbers(*of, classes));
    }
  }
  return chain;
}

std::string event_chain_json(const EventChain& chain) {
  Json json = recoil::json_of(chain.stamp);
  json["chains"] = Json::array();
  for (const EventChain::Chain& of : chain.chains) {
    const Json study = Json::parse(correction_studies_json({"", {of.study}})).at("studies").at(0);
    json["chains"].push_back({{"dataset", of.dataset}, {"study", study}});
  }
  json["others"] = Json::array();
  for (const OtherStreams& of : chain.others) {
    Json own = {{"dataset", of.dataset}, {"size_classes", of.size_classes}, {"usable", of.usable}};
    if (of.usable) {
      own["error_slow"] = json_of(of.error_slow);
      own["error_fast"] = json_of(of.error_fast);
      own["C_H"] = json_of(of.C_H);
      own["C_A"] = json_of(of.C_A);
      own["capture_velocity"] = json_of(of.capture_velocity);
    }
    json["others"].push_back(own);
  }
  return json.dump(1) + "\n";
}

EventChain read_event_chain(const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(read_text_file(file));
    EventChain chain;
    chain.stamp = stamp_of(json);
    for (const Json& from : json.at("chains")) {
      const Json studies = {{"inputs", ""}, {"studies", Json::array({from.at("study")})}};
      chain.chains.push_back(
          {from.at("dataset"),
           parse_correction_studies(studies.dump(), file.string()).studies.front()});
    }
    for (const Json& from : json.at("others")) {
      OtherStreams others;
      others.dataset = from.at("dataset");
      others.size_classes = from.at("size_classes");
      others.usable = from.at("usable");
      if (others.usable) {
        others.error_slow = mean_at(from, "error_slow");
        others.error_fast = mean_at(from, "error_fast");
        others.C_H = mean_at(from, "C_H");
        others.C_A = mean_at(from, "C_A");
        others.capture_velocity = mean_at(from, "capture_velocity");
      }
      chain.others.push_back(others);
    }
    return chain;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& problem) {
    throw InputError({file.string()}, "this is no study of the chain of events", problem.what(),
                     "let ./run study event-chain write it again");
  }
}

Document event_chain_page(const EventChain& chain) {
  Document page;
  page.heading = "From passages to parameters, and what each correction does";
  page.foreword = {
      Paragraph{Sentence("The recipes of the two steel reconstructions say what the instrument "
                         "would have recorded (") +
                code("[passages]") + Sentence("); ") + code("recoil pair") +
                Sentence(" turns that into points, and the shipped fit is run on them. ") +
                strong("Nothing here was measured") +
                Sentence(": the truth is the recipe's, so the tables show what the chain does to "
                         "it. The shipped points.csv are those of 40 spheres per drop height, all "
                         "sizes in one point, all corrections.")},
      List{{say("Errors are one standard error of the fit. Near capture only {C_A} + 2 {C_H} is "
                "determined well (truth: 0.035 s/m)."),
            "e - truth: mean over the rebounds of each point's e less the truth at its mean size "
            "and velocity. One rebound scatters by 10 %, so of 14 x 40 the mean is uncertain by "
            "0.004, of 14 x 800 by 0.001; rows of one table share their passages.",
            say("captured: spheres that the points call captured; {V*}: capture velocity.")}}};
  for (const EventChain::Chain& of : chain.chains) page.sections.push_back(section_of(of));
  page.sections.push_back(others_section(chain.others));
  append(page.sections.back().blocks, stamp_blocks(chain.stamp));
  return page;
}

}  // namespace recoil
