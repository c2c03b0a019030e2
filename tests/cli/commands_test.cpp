// The commands as people script against them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "options/option_table.hpp"
#include "support/workplace.hpp"

namespace {

using support::Outcome;
using support::Words;
using support::Workplace;

/// The number behind `key` at the start of a line.
double number_after(const std::string& text, const std::string& key) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(key);
    if (at != std::string::npos) return std::stod(line.substr(at + key.size()));
  }
  ADD_FAILURE() << "no '" << key << "' in:\n" << text;
  return 0.0;
}

TEST(Simulate, HertzWithHuntCrossleyDampingToNineDigits) {
  // C_H V = 0.1 without adhesion: e = 0.9374755799 by Lambert's W.
  const Workplace place;
  place.write("hertz.toml",
              "dataset = \"data\"\n[parameters]\nC_H = { initial = 0.02 }\nC_A = { initial = 0, "
              "free = false }\nf0 = { initial = 0, free = false }\n");
  const Outcome run = place.run({"simulate", "hertz.toml", "--velocity", "5", "--diameter", "4.9"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("restitution: 0.93747558\n"), std::string::npos) << run.out;
  // The source of the parameters comes first, so that initial values do not pass for fitted ones.
  EXPECT_EQ(run.out.rfind("parameters: initial values of the fit file (--parameters", 0), 0U)
      << run.out;
  EXPECT_NE(run.out.find("outcome: rebound\n"), std::string::npos);
  EXPECT_NEAR(number_after(run.out, "rebound  "), 100.0 * 0.9374755799 * 0.9374755799, 2e-5);
}

/// `recoil` with `words`, the file `text` in a pipe as standard input.
Outcome piped(const Workplace& place, const std::string& text, const std::string& words) {
  return support::run_command({"bash", "-c", "cat " + text + " | \"$0\" " + words, RECOIL_BINARY},
                              place.path());
}

TEST(Pipes, EveryInputMayBeOne) {
  const Workplace place;
  place.write("t.csv", "V,e\n1,0.5\n2,0.7\n4,0.8\n");
  place.write("p.csv", "incident_velocity,restitution\n1,0.5\n2,0.7\n4,0.8\n");
  place.write("sizes.csv", "diameter,count\n4.9,3\n5.0,2\n");
  const std::string import =
      " --format csv --map incident_velocity=V:m/s,restitution=e --like data --diameter 5um "
      "--provenance measured --into ";
  Outcome run = piped(place, "t.csv", "import -" + import + "a");
  EXPECT_EQ(run.status, 0) << run.err;
  run = piped(place, "t.csv", "import /dev/stdin" + import + "b");
  EXPECT_EQ(run.status, 0) << run.err;
  run = piped(place, "t.csv", "import <(cat t.csv)" + import + "c");
  EXPECT_EQ(run.status, 0) << run.err;
  for (const std::string made : {"b", "c"}) {
    EXPECT_EQ(place.read(made + "/points.csv"), place.read("a/points.csv"));
  }
  EXPECT_NE(place.read("a/points.csv").find("points,5,4,0.8\n"), std::string::npos);
  run = piped(place, "p.csv", "init d --points - --provenance measured --like data --diameter 5");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(place.read("d/points.csv"), place.read("a/points.csv"));
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "r"}).status, 0);
  run = piped(place, "r/fit.json", "compare - r/fit.json");
  EXPECT_EQ(run.status, 0) << run.err;
  run = piped(place, "r/fit.json", "simulate fit.toml --parameters - --velocity 8 --diameter 4.9");
  EXPECT_EQ(run.status, 0) << run.err;
  run = piped(place, "sizes.csv", "predict fit.toml --sizes - --replicates 0 --height 1");
  EXPECT_EQ(run.status, 0) << run.err;
  run = piped(place, "fit.toml", "fit - --replicates 0");
  EXPECT_EQ(run.status, 0) << run.err;
  run = piped(place, "/dev/null", "import -" + import + "e");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "-:1:1: the file is empty; export the points again\n");
}

TEST(Fit, SpheresThatStuckAreNoReboundsOfZero) {
  // Spheres stick below 1.27 m/s, the truth of these points; people write e = 0 for those.
  const Workplace place;
  place.write("p.csv",
              "incident_velocity,restitution,restitution_sd\n0.7,0,0.01\n1.0,0,0.01\n"
              "1.6,0.522,0.01\n2.4,0.725,0.01\n4.0,0.829,0.01\n7.0,0.866,0.01\n12,0.868,0.01\n"
              "20,0.852,0.01\n");
  ASSERT_EQ(place
                .run({"init", "z", "--points", "p.csv", "--particle", "polystyrene", "--surface",
                      "silicon", "--diameter", "4.9", "--provenance", "measured"})
                .status,
            0);
  const Outcome json = place.run({"fit", "z/fit.toml", "--replicates", "0", "--json"});
  ASSERT_EQ(json.status, 0) << json.err;
  const auto fitted = nlohmann::json::parse(json.out);
  const double capture = fitted["derived"]["capture_velocity"][0]["value"];
  EXPECT_GT(capture, 1.0);
  EXPECT_LT(capture, 1.6);
  const Outcome screen = place.run({"fit", "z/fit.toml", "--replicates", "0"});
  EXPECT_NE(screen.out.find("2 points with a restitution of 0"), std::string::npos) << screen.out;
}

TEST(Simulate, BudgetAddsUpToTheWhole) {
  const Workplace place;
  const Outcome run = place.run({"simulate", "fit.toml", "--velocity", "8", "--diameter", "4.9"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(number_after(run.out, "rebound  ") + number_after(run.out, "Hertz damping (C_H)") +
                  number_after(run.out, "adhesion damping (C_A)"),
              100.0, 3e-5);
}

TEST(Simulate, SaysWhichSphereABudgetIsOfWhereTheyDiffer) {
  const Workplace place;
  std::string fit = place.read("fit.toml");
  const auto run = [&] {
    return place.run({"simulate", "fit.toml", "--velocity", "8", "--diameter", "4.9"}).out;
  };
  EXPECT_EQ(run().find("the mean of the rebounds"), std::string::npos);
  place.write("fit.toml",
              fit.insert(fit.find("[parameters]"), "mechanisms = [\"polydispersity\"]\n"));
  EXPECT_NE(run().find("the mean of the rebounds over spheres that differ (polydispersity)"),
            std::string::npos)
      << run();
}

TEST(Simulate, SaysWhereTheModelHolds) {
  const Workplace place;
  const auto at = [&](const std::string& velocity) {
    return place.run({"simulate", "fit.toml", "--velocity", velocity, "--diameter", "4.9"}).out;
  };
  EXPECT_NE(at("1").find("contact radius over that of the sphere"), std::string::npos);
  EXPECT_EQ(at("1").find("note: the contact grows"), std::string::npos);
  // (5 pi / 4 rho V^2 / E*)^(1/5) is above 0.3 for any organic solid at 100 m/s.
  EXPECT_NE(at("100").find("note: the contact grows to 0."), std::string::npos);
}

TEST(Simulate, WritesTheForceHistory) {
  const Workplace place;
  const Outcome run = place.run({"simulate", "fit.toml", "--velocity", "5.2", "--diameter", "4.9",
                                 "--history", "forces.csv"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string csv = place.read("forces.csv");
  EXPECT_EQ(csv.rfind("time_ns,penetration_nm,approach_velocity_m_s,hertz_force_uN,", 0), 0U);
  EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 50);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
}

TEST(Simulate, CapturedIsAnOutcome) {
  const Workplace place;
  const Outcome run = place.run({"simulate", "fit.toml", "--velocity", "0.05", "--diameter", "2"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("restitution: 0.00000000\n"), std::string::npos);
  EXPECT_NE(run.out.find("outcome: captured\n"), std::string::npos);
}

TEST(Fit, WritesTheSameBytesAtAnyThreadCount) {
  const Workplace place;
  for (const char* threads : {"1", "3"}) {
    const Outcome run = place.run(
        {"fit", "fit.toml", "--out", threads, "--replicates", "39", "--threads", threads});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(run.err.empty()) << run.err;
  }
  EXPECT_EQ(place.read("1/fit.json"), place.read("3/fit.json"));
}

TEST(Report, WritesTheSameBytesAtAnyThreadCount) {
  const Workplace place;
  const std::vector<std::string> words = {"report", "fit.toml", "--replicates", "9", "--out"};
  const auto report = [&](const std::string& out, const std::vector<std::string>& options) {
    std::vector<std::string> all = words;
    all.push_back(out);
    all.insert(all.end(), options.begin(), options.end());
    return place.run(all);
  };
  const Outcome free = report("free", {});  // pages and laws are worked on at the same time
  const Outcome single = report("single", {"--threads", "1"});
  ASSERT_EQ(free.status, 0) << free.err;
  ASSERT_EQ(single.status, 0) << single.err;
  int compared = 0;
  for (const std::string& name : place.listing()) {
    if (!name.starts_with("free/") || !std::filesystem::is_regular_file(place.path() / name)) {
      continue;
    }
    EXPECT_EQ(place.read(name), place.read("single" + name.substr(4))) << name;
    ++compared;
  }
  EXPECT_GE(compared, 10);
  // A page that travels alone: whole diagnosis, equation, hash, and no link to a file beside it.
  const std::string page = place.read("free/fit.html");
  const auto fit = nlohmann::json::parse(place.read("free/fit/fit.json"));
  EXPECT_NE(page.find(fit["dataset"]["sha256"].get<std::string>()), std::string::npos);
  EXPECT_NE(page.find("<math "), std::string::npos);
  const std::regex reference("href=\"([^\"]*)\"");
  for (std::sregex_iterator one(page.begin(), page.end(), reference), end; one != end; ++one) {
    const std::string target = (*one)[1];
    if (target.starts_with("#")) {
      EXPECT_NE(page.find("id=\"" + target.substr(1) + "\""), std::string::npos) << target;
    } else {
      EXPECT_TRUE(target.starts_with("http") || target.starts_with("data:")) << target;
    }
  }
  const auto diagnosis = nlohmann::json::parse(place.read("free/fit/diagnosis.json"));
  for (const auto& candidate : diagnosis["candidates"]) {
    std::string cause = candidate["id"];
    std::ranges::replace(cause, '_', ' ');
    EXPECT_NE(page.find(cause), std::string::npos) << cause;
  }
}

TEST(AtOnce, DoesAllOfItAndTellsOfWhatFailed) {
  for (const int threads : {0, 1}) {
    int done[3] = {0, 0, 0};
    recoil::at_once(
        threads, [&] { ++done[0]; }, [&] { ++done[1]; }, [&] { ++done[2]; });
    EXPECT_EQ(done[0] + done[1] + done[2], 3);
    bool ended = false;
    const auto end = [&] { ended = true; };
    const auto fail = [] { throw std::runtime_error("of the second"); };
    EXPECT_THROW(recoil::at_once(
                     threads, [] {}, fail, end),
                 std::runtime_error);
    EXPECT_TRUE(ended) << "the third goes on where the second fails";
    try {
      recoil::at_once(
          threads, [] { throw std::logic_error("of the first"); }, fail);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::logic_error&) {
    }
  }
}

TEST(Fit, SeedIsInTheFileAndChangesTheBootstrapOnly) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--out", "a", "--replicates", "39"}).status, 0);
  ASSERT_EQ(
      place.run({"fit", "fit.toml", "--out", "b", "--replicates", "39", "--seed", "5"}).status, 0);
  const auto a = nlohmann::json::parse(place.read("a/fit.json"));
  const auto b = nlohmann::json::parse(place.read("b/fit.json"));
  EXPECT_EQ(b["bootstrap"]["seed"], 5);
  EXPECT_EQ(a["parameters"]["C_A"]["value"], b["parameters"]["C_A"]["value"]);
  EXPECT_NE(a["parameters"]["C_A"]["intervals"]["percentile"],
            b["parameters"]["C_A"]["intervals"]["percentile"]);
}

TEST(Fit, ReferenceSolverAgrees) {
  const Workplace place;
  // Few points and one parameter: the reference solver takes a hundred times as long.
  place.change("fit.toml", "C_H = { initial = 3e-3, bounds = [0, 1] }",
               "C_H = { initial = 3e-3, free = false }");
  place.write("data/points.csv",
              "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n"
              "a,4.9,3,0.76,0.015,20,0\na,4.9,8,0.89,0.015,20,0\n");
  ASSERT_EQ(place.run({"fit", "fit.toml", "--out", "fast", "--replicates", "0"}).status, 0);
  ASSERT_EQ(
      place.run({"fit", "fit.toml", "--out", "slow", "--replicates", "0", "--solver", "reference"})
          .status,
      0);
  const auto fast = nlohmann::json::parse(place.read("fast/fit.json"));
  const auto slow = nlohmann::json::parse(place.read("slow/fit.json"));
  const auto& f = fast["parameters"]["C_A"];
  const auto& s = slow["parameters"]["C_A"];
  EXPECT_NEAR(f["value"].get<double>(), s["value"].get<double>(),
              0.01 * s["std_error"].get<double>());
}

TEST(Fit, FittedValuesCanBeSimulated) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--out", "out", "--replicates", "39"}).status, 0);
  const Outcome run = place.run({"simulate", "fit.toml", "--velocity", "8", "--diameter", "4.9",
                                 "--parameters", "out/fit.json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const Outcome wrong = place.run({"simulate", "fit.toml", "--velocity", "8", "--diameter", "4.9",
                                   "--parameters", "data/datapackage.json"});
  EXPECT_EQ(wrong.status, 2);
}

TEST(Fit, FittedValuesBelongToTheirData) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--out", "out", "--replicates", "0"}).status, 0);
  const std::vector<std::string> simulate = {
      "simulate",   "fit.toml", "--velocity",   "8",
      "--diameter", "4.9",      "--parameters", "out/fit.json"};
  place.write("data/points.csv", place.read("data/points.csv") + "large,4,12,0.935,0.015,20,0\n");
  const Outcome changed = place.run(simulate);
  EXPECT_EQ(changed.status, 2);
  EXPECT_EQ(changed.err,
            "out/fit.json: example has changed since (these values belong to the files as they "
            "were); run recoil fit again\n");
  std::string package = place.read("data/datapackage.json");
  place.write("data/datapackage.json", package.replace(package.find("example"), 7, "another"));
  const Outcome other = place.run(simulate);
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("fitted to example"), std::string::npos) << other.err;
}

TEST(Fit, WithoutAnAnswerEndsWithStatusThree) {
  const Workplace place;
  const std::string points = place.read("data/points.csv");
  const std::size_t header = points.find('\n');
  const std::size_t first = points.find('\n', header + 1);
  place.write("data/points.csv", points.substr(0, first + 1));  // one point, two parameters
  const Outcome run = place.run({"fit", "fit.toml", "--out", "out"});
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find("cannot determine"), std::string::npos) << run.err;
}

TEST(Figure, IsAFileInTheFormatOfItsName) {
  const Workplace place;
  const Words words = {"figure", "fit.toml", "--replicates", "0", "--out"};
  const auto with = [&](Words more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    return place.run(all);
  };
  const Outcome svg = with({"e.svg", "--width", "17cm"});
  EXPECT_EQ(svg.status, 0) << svg.err;
  EXPECT_NE(place.read("e.svg").find("width=\"170mm\""), std::string::npos);
  EXPECT_NE(svg.out.find("C_A = "), std::string::npos) << "a caption";
  EXPECT_EQ(with({"new/e.pdf"}).status, 0);
  EXPECT_TRUE(place.read("new/e.pdf").starts_with("%PDF-"));
  EXPECT_EQ(with({"e.png"}).status, 0);
  EXPECT_TRUE(place.read("e.png").starts_with("\x89PNG"));
  for (const char* wrong : {"e.jpg", "e", ".pdf"}) {
    const Outcome refused = with({wrong});
    EXPECT_EQ(refused.status, 2) << wrong;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_FALSE(place.has(wrong));
  }
}

TEST(Figure, SaysWhichProgramIsMissing) {
  const Workplace place;
  const std::string command = "cd '" + place.path().string() +
                              "' && PATH=/nowhere '" RECOIL_BINARY
                              "' figure fit.toml --replicates 0 --out e.pdf 2> complaint.txt";
  EXPECT_NE(std::system(command.c_str()), 0);
  const std::string complaint = place.read("complaint.txt");
  EXPECT_NE(complaint.find("librsvg2-bin"), std::string::npos) << complaint;
  EXPECT_FALSE(place.has("e.pdf"));
}

TEST(CommandLine, SuggestsTheNearestOption) {
  const Workplace place;
  const Outcome run = place.run({"fit", "fit.toml", "--replicate", "99"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("did you mean --replicates?"), std::string::npos) << run.err;
}

TEST(CommandLine, SuggestsTheNameOfTheFolderInThisCommand) {
  const Workplace place;
  const Outcome made = place.run({"import", "x.csv", "--out", "y"});
  EXPECT_NE(made.err.find("did you mean --into?"), std::string::npos) << made.err;
  const Outcome written = place.run({"bounce", "x.csv", "--into", "y"});
  EXPECT_NE(written.err.find("did you mean --out?"), std::string::npos) << written.err;
}

TEST(CommandLine, SuggestsTheNearestFitFile) {
  const Workplace place;
  const Outcome near = place.run({"diagnose", "fits.toml"});
  EXPECT_EQ(near.status, 2);
  EXPECT_EQ(near.err, "fits.toml: no such file; did you mean 'fit.toml'?\n");
  const Outcome far = place.run({"fit", "elsewhere/fit.toml"});
  EXPECT_EQ(far.status, 2);
  EXPECT_EQ(far.err, "elsewhere/fit.toml: no such file; check the path\n");
}

TEST(CommandLine, OutputThatCannotBeWrittenIsNotSuccess) {
  const Workplace place;
  const std::string command = "cd '" + place.path().string() +
                              "' && '" RECOIL_BINARY "' check data > /dev/full 2> complaint.txt";
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_NE(place.read("complaint.txt").find("could not be written"), std::string::npos);
}

TEST(Help, TeachesEveryCommand) {
  const Workplace place;
  const Outcome help = place.run({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"check", "simulate", "fit", "diagnose", "coverage", "pair", "import",
                              "predict", "report"}) {
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
    const Outcome one = place.run({command, "--help"});
    EXPECT_EQ(one.status, 0);
    EXPECT_NE(one.out.find(std::string("recoil ") + command), std::string::npos) << one.out;
  }
}

TEST(Help, FitsOnATerminalAndIsWholeOnRequest) {
  const Workplace place;
  std::set<std::string> commands;
  for (const recoil::OptionRow& row : recoil::option_rows()) {
    std::istringstream names{std::string(row.commands)};
    for (std::string name; names >> name;) commands.insert(name);
  }
  ASSERT_GE(commands.size(), 17U);
  const auto check_width = [](const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  };
  for (const std::string& command : commands) {
    const std::string brief = place.run({command, "--help"}).out;
    const std::string whole = place.run({"help", command}).out;
    check_width(brief);
    check_width(whole);
    EXPECT_LE(std::ranges::count(brief, '\n'), 55) << brief;
    for (const recoil::OptionRow* row : recoil::options_of(command)) {
      if (row->is_hidden()) continue;
      EXPECT_NE(brief.find(row->name), std::string::npos) << command << " " << row->name;
      const std::string_view end = row->meaning.substr(row->meaning.rfind(' ') + 1);
      EXPECT_NE(whole.find(end), std::string::npos) << command << " " << row->name;
    }
  }
  check_width(place.run({"--help"}).out);
}

const char* const header =
    "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n";

TEST(Degenerate, PointsThatDetermineNothingStillHaveTheirPages) {
  for (const char* rows :
       {"a,2,4,0.8,0.015,20,0\na,2,4,0.8,0.015,20,0\na,2,4,0.8,0.015,20,0\n",   // one velocity
        "a,2,0.5,0,0.015,20,20\na,2,1,0,0.015,20,20\na,2,1.2,0,0.015,20,20\n",  // all captured
        "a,2,4,0.8,0.015,20,0\na,2,4,0.7,0.015,20,0\na,2,4,0.9,0.015,20,0\n"}) {
    const support::Workplace place;
    place.write("data/points.csv", std::string(header) + rows);
    const support::Outcome fitted = place.run({"fit", "fit.toml", "--replicates", "0"});
    EXPECT_EQ(fitted.status, 0) << fitted.err;
    EXPECT_EQ(fitted.out.find("factor of inf"), std::string::npos) << fitted.out;
    EXPECT_EQ(fitted.out.find("to 0 %"), std::string::npos) << fitted.out;
    const support::Outcome page =
        place.run({"report", "fit.toml", "--replicates", "9", "--out", "pages"});
    EXPECT_EQ(page.status, 0) << page.err;
    EXPECT_TRUE(place.has("pages/index.html"));
  }
}

TEST(Degenerate, AResultDoesNotReplaceWhatItIsMadeFrom) {
  const support::Workplace place;
  const std::string before = place.read("fit.toml");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"coverage", "fit.toml", "--datasets", "2", "--replicates", "39", "--out", "fit.toml"},
           {"simulate", "fit.toml", "--velocity", "3", "--diameter", "4", "--history",
            "./fit.toml"}}) {
    const support::Outcome refused = place.run(words);
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("this input file would be overwritten"), std::string::npos)
        << refused.err;
    EXPECT_EQ(place.read("fit.toml"), before);
  }
}

}  // namespace
