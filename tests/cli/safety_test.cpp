// Unwanted effects: data lost, code run from names, crashes, waits without end.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "support/hostile_names.hpp"
#include "support/started.hpp"
#include "support/workplace.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::run_command;
using support::Started;
using support::with;
using support::Words;
using support::Workplace;

/// Status 2 and one line.
void expect_refusal(const Outcome& run, const std::string& words) {
  support::count_hostile_cases();
  EXPECT_EQ(run.status, 2) << run.out << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("defect"), std::string::npos) << run.err;
}

/// Runs the command behind a line of shell.
Outcome run_after(const Workplace& place, const std::string& line, const Words& command) {
  return run_command(with({"sh", "-c", line + "\nexec \"$@\"", "sh", RECOIL_BINARY}, command),
                     place.path());
}

/// Spheres that rebound with e = 0.8 from a surface 1 mm below the plane.
std::string passages() {
  std::string csv = "time,velocity,diameter\n";
  double time = 0.0;
  for (int i = 0; i < 200; ++i) {
    time += 1.0;
    const double v = 1.0 + 0.3 * (i % 7);
    csv += std::to_string(time) + "," + std::to_string(v) + ",30\n";
    csv += std::to_string(time + 0.001 / v + 0.001 / (0.8 * v)) + "," + std::to_string(-0.8 * v) +
           ",30\n";
  }
  return csv;
}

const Words pair_words = {"pair", "passages.csv", "--unit", "time=s,velocity=m/s,diameter=um"};
const Words into_a_dataset = {"--like", "data", "--provenance", "synthetic", "--into"};

TEST(Safety, NoCommandReplacesDataUnasked) {
  const Workplace place;
  place.write("passages.csv", passages());
  const std::string points = place.read("data/points.csv");
  const std::string package = place.read("data/datapackage.json");
  const Words plan = {"plan", "fit.toml",  "--velocity", "1,20",  "--diameter",
                      "4",    "--impacts", "200",        "--out", "data"};
  const Words coverage = {"coverage", "fit.toml", "--datasets", "1", "--replicates", "19", "--out"};
  for (const Words& words :
       std::vector<Words>{plan,
                          with(pair_words, with(into_a_dataset, {"data"})),
                          with(pair_words, {"--out", "data/points.csv"}),
                          with(pair_words, {"--impacts", "data/points.csv"}),
                          with(coverage, {"data/points.csv"}),
                          with(coverage, {"data/datapackage.json"}),
                          {"simulate", "fit.toml", "--velocity", "5", "--diameter", "4",
                           "--history", "data/points.csv"},
                          {"init", "data", "--like", "data", "--diameter", "5"}}) {
    const Outcome run = place.run(words);
    support::count_hostile_cases();
    EXPECT_EQ(run.status, 2) << words.front() << run.out;
    EXPECT_EQ(place.read("data/points.csv"), points) << words.front();
    EXPECT_EQ(place.read("data/datapackage.json"), package) << words.front();
  }
  EXPECT_EQ(place.run(with(plan, {"--replace"})).status, 0);
  EXPECT_NE(place.read("data/points.csv"), points);
}

TEST(Safety, TwoResultsOfOneNameAreFoundBeforeTheWork) {
  const Workplace place;
  place.write("passages.csv", passages());
  place.write("other/fit.toml",
              support::changed(place.read("fit.toml"), "\"data\"", "\"../data\""));
  for (const char* name : {"index.toml", "fit.html.toml", "...toml"}) {
    place.write(name, place.read("fit.toml"));
  }
  const auto before = place.listing();
  for (const Words& words :
       std::vector<Words>{{"report", "fit.toml", "other/fit.toml"},
                          {"report", "index.toml"},
                          {"report", "fit.toml", "fit.html.toml"},
                          {"report", "...toml"},
                          with(pair_words, {"--out", "same.csv", "--impacts", "./same.csv"})}) {
    expect_refusal(place.run(with(words, words[0] == "report" ? Words{"--out", "pages"} : Words{})),
                   "");
    EXPECT_EQ(place.listing(), before);
  }
}

TEST(Safety, NothingIsWrittenBehindAPlantedLinkOrIntoWhatIsNoLock) {
  const Workplace place;
  place.write("precious", "precious");
  const Words fit = {"fit", "fit.toml", "--replicates", "0", "--out", "out"};
  fs::create_directory(place / "out");
  fs::create_symlink("../precious", place / "out/fit.json.lock");
  expect_refusal(place.run(fit), "this is not a lock file of recoil");
  fs::remove(place / "out/fit.json.lock");
  fs::create_hard_link(place / "precious", place / "out/fit.json.lock");
  expect_refusal(place.run(fit), "this is not a lock file of recoil");
  EXPECT_EQ(place.read("precious"), "precious");
  fs::remove(place / "out/fit.json.lock");
  EXPECT_EQ(place.run(fit).status, 0);
  // no file of a name that can be foreseen, neither there nor in the folder for temporary files
  const Outcome init = run_after(place, "TMPDIR=/nonexistent; export TMPDIR",
                                 {"init", "mine", "--like", "data", "--diameter", "5"});
  EXPECT_EQ(init.status, 0) << init.err;
}

TEST(Safety, TwoCommandsNeverWorkOnOneResult) {
  const Workplace place;
  place.write("passages.csv", passages());
  place.write("sizes.csv", "diameter,count\n2,10\n5,20\n9,5\n");
  place.write("new.csv", "V,e\n1,0.5\n2,0.6\n");
  const Words import = {
      "import", "new.csv", "--format",   "csv", "--into", "out",
      "--like", "data",    "--diameter", "4um", "--map",  "incident_velocity=V:m/s,restitution=e"};
  for (const auto& [mark, words] : std::vector<std::pair<std::string, Words>>{
           {"points.csv", {"init", "out", "--like", "data", "--diameter", "5"}},
           {"points.csv", import},
           {"points.csv", with(pair_words, with(into_a_dataset, {"out"}))},
           {"fit.json", {"fit", "fit.toml", "--replicates", "0", "--out", "out"}},
           {"diagnosis.json", {"diagnose", "fit.toml", "--out", "out"}},
           {"c.md", {"coverage", "fit.toml", "--datasets", "1", "--out", "out/c.md"}},
           {"plan.json", {"plan", "fit.toml", "--impacts", "100", "--out", "out"}},
           {"predict.json", {"predict", "fit.toml", "--sizes", "sizes.csv", "--out", "out"}},
           {"export", {"export", "fit.toml", "--to", "table", "--out", "out"}}}) {
    place.write("out/" + mark + ".lock", "");
    const int other = open((place / "out" / (mark + ".lock")).c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_EQ(flock(other, LOCK_EX), 0);
    expect_refusal(place.run(words), "another recoil process is writing this result");
    close(other);
    fs::remove_all(place / "out");
  }
}

TEST(Safety, ForgedHeadsOfPartsAreRefused) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "19", "--shard", "1/1", "--out", "parts"})
                .status,
            0);
  fs::path part;
  for (const auto& entry : fs::directory_iterator(place / "parts")) part = entry.path();
  const std::string text = support::text_of(part);
  const std::size_t line = text.find('\n');
  using Json = nlohmann::ordered_json;
  const auto forge = [&](const char* key, const Json& value) {
    Json head = Json::parse(text.substr(0, line));
    head["origin"][key] = value;
    head.erase("sha256");
    place.write("bytes", head.dump() + text.substr(line));
    head["sha256"] = run_command({"sha256sum", "bytes"}, place.path()).out.substr(0, 64);
    support::write_text(part, head.dump() + text.substr(line));
    return place.run({"merge", "parts", "--threads", "1"});
  };
  for (const auto& [key, value] :
       std::vector<std::pair<const char*, Json>>{{"command", Json::array()},
                                                 {"command", Json::array({"no-such-command"})},
                                                 {"command", Json::array({""})},
                                                 {"pieces", 18446744073709551615ULL},
                                                 {"pieces", -1},
                                                 {"pieces", 0},
                                                 {"pieces", 1e30},
                                                 {"pieces", 100000000000ULL},
                                                 {"seed", -1},
                                                 {"inputs", "other"},
                                                 {"folder", "/nonexistent"}}) {
    const Outcome run = forge(key, value);
    EXPECT_TRUE(run.status == 2 || run.status == 3 || std::string(key) == "folder")
        << key << value << run.status << run.err;
    EXPECT_LT(run.status, 128) << key << value;
    support::count_hostile_cases();
    EXPECT_EQ(run.err.find("defect"), std::string::npos) << run.err;
  }
  support::write_text(
      part, support::changed(text, "\"seed\":", "\"seed\":1"));  // checksum of another head
  expect_refusal(place.run({"merge", "parts"}), "");
}

/// A part whose rows somebody has replaced, with the right checksum.
TEST(Safety, RowsOfAnotherKindAreAMistakeOfTheUser) {
  const Workplace place;
  ASSERT_EQ(place
                .run({"coverage", "fit.toml", "--datasets", "1", "--replicates", "19", "--shard",
                      "1/1", "--out", "parts"})
                .status,
            0);
  fs::path part;
  for (const auto& entry : fs::directory_iterator(place / "parts")) part = entry.path();
  const std::string text = support::text_of(part);
  using Json = nlohmann::ordered_json;
  for (const std::string row :
       {"null", "7", "[]", "\"x\"", R"({"usable": 3})", R"({"usable": true})",
        R"({"usable": true, "parameters": [{"cells": []}], "capture": []})"}) {
    const std::string rows = "[0," + row + "]\n";
    Json head = Json::parse(text.substr(0, text.find('\n')));
    head["bytes"] = rows.size();
    head.erase("sha256");
    place.write("bytes", head.dump() + "\n" + rows);
    head["sha256"] = run_command({"sha256sum", "bytes"}, place.path()).out.substr(0, 64);
    support::write_text(part, head.dump() + "\n" + rows);
    expect_refusal(place.run({"merge", "parts", "--threads", "1"}), "");
  }
  // one whose first line never ends
  support::write_text(part, text);
  support::write_text(place / "parts/part-9-of-9-x.jsonl", "");
  fs::resize_file(place / "parts/part-9-of-9-x.jsonl", 50ULL << 30U);  // sparse
  EXPECT_EQ(run_after(place, "ulimit -v 4000000", {"merge", "parts", "--threads", "1"}).status, 0);
}

/// JSON that is nested a hundred thousand times, wherever a command reads JSON.
TEST(Safety, DeepJsonIsRefused) {
  const Workplace place;
  ASSERT_EQ(
      place.run({"fit", "fit.toml", "--replicates", "0", "--threads", "1", "--out", "o"}).status,
      0);
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  place.write("deep.json",
              support::changed(place.read("o/fit.json"), "{", "{\"new\":" + deep + ","));
  place.write("ball.json", R"({"material": "x", "density": )" + deep + "}");
  for (const Words& words : std::vector<Words>{
           {"compare", "o/fit.json", "deep.json"},
           {"simulate", "fit.toml", "--velocity", "3", "--diameter", "4", "--parameters",
            "deep.json"},
           {"export", "fit.toml", "--to", "lammps", "--out", "e", "--parameters", "deep.json"},
           {"plan", "fit.toml", "--parameters", "deep.json"},
           {"init", "n", "--particle", "ball.json", "--surface", "steel", "--diameter", "5"}}) {
    expect_refusal(place.run(words), ".json");
  }
}

/// A limit of the size of files is an error like a full disk: what was there stays, and nothing is
/// left beside it.
TEST(Safety, ALimitOfTheSizeOfFilesIsAnError) {
  const Workplace place;
  const Words fit = {"fit", "fit.toml", "--replicates", "0", "--threads", "1", "--out", "o"};
  ASSERT_EQ(place.run(fit).status, 0);
  const std::string before = place.read("o/fit.json");
  const auto listing = place.listing();
  expect_refusal(run_after(place, "ulimit -f 1", fit), "fit.json");
  EXPECT_EQ(place.read("o/fit.json"), before);
  EXPECT_EQ(place.listing(), listing);
}

/// A mistake in the second fit file is found before the page of the first is made.
TEST(Safety, AReportReadsAllFitFilesFirst) {
  const Workplace place;
  place.write("wrong.toml", "dataset = \"nowhere\"\n");
  const auto listing = place.listing();
  expect_refusal(place.run({"report", "fit.toml", "wrong.toml", "--out", "pages"}), "wrong.toml");
  EXPECT_EQ(place.listing(), listing);
}

TEST(Safety, ASmallStackIsEnough) {
  const Workplace place;
  EXPECT_EQ(
      run_after(place, "ulimit -s 256", {"fit", "fit.toml", "--replicates", "19", "--threads", "2"})
          .status,
      0);
}

TEST(Safety, AStandardStreamThatIsClosedOrFullChangesNoStatus) {
  const Workplace place;
  for (const char* redirect : {"exec 2>/dev/full", "exec 2>&-", "exec 0<&- 2>&-"}) {
    for (const Words& words : std::vector<Words>{
             {"check", "nosuch"}, {"bogus"}, {"fit", "nosuch.toml"}, {"fit", "--bogus"}}) {
      EXPECT_EQ(run_after(place, redirect, words).status, 2) << redirect;
    }
    EXPECT_EQ(
        run_after(place, redirect, {"fit", "fit.toml", "--replicates", "0", "--out", "out"}).status,
        0);
    EXPECT_EQ(nlohmann::json::parse(place.read("out/fit.json"))["format_version"], 2);
  }
  for (const char* redirect : {"exec >&-", "exec >/dev/full", "exec >&- 2>&-"}) {
    for (const Words& words : std::vector<Words>{{"--help"}, {"check", "data"}, {"materials"}}) {
      EXPECT_EQ(run_after(place, redirect, words).status, 2) << redirect << words.front();
    }
  }
}

TEST(Safety, PlacesThatCannotBeUsedAreMistakesOfTheUser) {
  const Workplace place;
  const std::string too_long(5000, 'a');
  const Words init = {"init", too_long, "--like", "data", "--diameter", "5"};
  expect_refusal(place.run(init), "File name too long");
  expect_refusal(place.run({"report", "fit.toml", "--replicates", "9", "--out", too_long}), "");
  expect_refusal(place.run({"fit", "fit.toml", "--replicates", "0", "--out", too_long}), "");
  expect_refusal(place.run({"cluster", "slurm", too_long, "--shards", "2", "--out", "b"}), "");
  expect_refusal(place.run({"import", too_long, "--format", "csv", "--into", "new"}), "");
  const std::string fit = (place / "fit.toml").string();
  for (const Words& words : std::vector<Words>{
           {"fit", fit, "--replicates", "0", "--out", "o"},
           {"coverage", fit, "--datasets", "1", "--replicates", "9", "--out", "c.md"},
           {"cluster", "slurm", fit, "--shards", "2", "--out", "b"}}) {
    expect_refusal(run_after(place, "mkdir gone; cd gone; rmdir ../gone", words), "");
  }
  fs::create_directory(place / "private");
  fs::permissions(place / "private", fs::perms::none);
  if (geteuid() != 0) {
    expect_refusal(place.run({"init", "private/x", "--like", "data", "--diameter", "5"}), "");
  }
  fs::permissions(place / "private", fs::perms::owner_all);
}

TEST(Safety, APipeWithoutAWriterEndsWithTheSignal) {
  const Workplace place;
  ASSERT_EQ(mkfifo((place / "pipe.toml").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((place / "unfinished-fit.json.jsonl").c_str(), 0600), 0);
  EXPECT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "."}).status, 0);
  const Outcome run = run_after(place, "cat fit.toml >pipe.toml &", {"fit", "pipe.toml"});
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(Safety, PicturesNeedNoOtherProgram) {
  const Workplace place;
  const Outcome run = run_after(place, "PATH=/nonexistent; export PATH",
                                {"report", "fit.toml", "--replicates", "0", "--out", "pages"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(place.read("pages/fit.html").find("<svg "), std::string::npos);
}

TEST(Safety, LimitsAndHangUpsKeepWhatIsFinished) {
  for (const int signal : {SIGHUP, SIGXCPU}) {
    const Workplace place;
    const fs::path kept = place / "out/unfinished-fit.json.jsonl";
    Started run({"fit", "fit.toml", "--replicates", "1000000", "--out", "out"}, place.path());
    ASSERT_TRUE(run.wait_until([&] { return fs::exists(place / "out/fit.json.lock"); }));
    ASSERT_TRUE(run.wait_until_worked(std::chrono::seconds(1)));
    run.send(signal);
    EXPECT_EQ(run.end().status, 128 + signal);
    EXPECT_TRUE(fs::exists(kept));
  }
}

TEST(Safety, NumbersAreTakenAsTheyAreOrRefused) {
  const Workplace place;
  place.write("sizes.csv", "diameter,count\n2,10\n5,20\n9,5\n");
  const Words fit = {"fit", "fit.toml", "--replicates"};
  for (const Words& words : std::vector<Words>{
           with(fit, {"9", "--seed", "9223372036854775808"}),
           with(fit, {"9", "--seed", "99999999999999999999"}),
           with(fit, {"9", "--seed", "1.5"}),
           with(fit, {"9", "--seed", "1e3"}),
           with(fit, {"2.7"}),
           with(fit, {"nan"}),
           with(fit, {"9", "--threads", "1.5"}),
           {"coverage", "fit.toml", "--datasets", "1.5"},
           {"predict", "fit.toml", "--sizes", "sizes.csv", "--height", "nan"},
           {"plan", "fit.toml", "--velocity", "nan,20"},
           {"plan", "fit.toml", "--error", "inf"},
           {"plan", "fit.toml", "--assume", "C_H=nan"},
           {"export", "fit.toml", "--to", "table", "--out", "o", "--velocity", "1,nan"},
           {"init", "new", "--like", "data", "--diameter", "inf"},
           {"import", "sizes.csv", "--format", "csv", "--into", "o", "--adhesion-energy", "nan"}}) {
    expect_refusal(place.run(words), "");
  }
  for (const char* option : {"height", "threshold", "diameter-tolerance", "velocity-tolerance",
                             "lost-share", "angle", "height-range", "size-edges"}) {
    for (const char* value : {"nan", "inf", "-inf", "1e999"}) {
      expect_refusal(place.run(with(pair_words, {std::string("--") + option, value})), value);
    }
  }
  const Outcome most = place.run(with(fit, {"0", "--json", "--seed", "9223372036854775807"}));
  EXPECT_NE(most.out.find("\"seed\": 9223372036854775807"), std::string::npos);
}

/// Every hostile name that can be one of a file, in turn, for a folder with a dataset and a fit.
void for_each_hostile_folder(const std::function<void(const Workplace&, const std::string&)>& act) {
  const Workplace place;
  for (const std::string& name : support::hostile_names()) {
    if (name.find('/') != std::string::npos) continue;
    fs::create_directory(place / name);
    fs::copy(place / "data", place / name / "data");
    fs::copy_file(place / "fit.toml", place / name / "fit.toml");
    act(place, name);
    EXPECT_FALSE(place.has("PWNED") || place.has(fs::path(name) / "PWNED")) << name;
    fs::remove_all(place / name);
  }
}

TEST(Safety, HostileNamesRunNothingInExportsAndReachNoTerminal) {
  for_each_hostile_folder([](const Workplace& place, const std::string& name) {
    const std::string fit = "./" + name + "/fit.toml";
    const std::string result = "./" + name;
    const Outcome fitted = place.run({"fit", fit, "--replicates", "0", "--out", result});
    ASSERT_EQ(fitted.status, 0) << fitted.err;
    for (const char* target : {"yade", "lammps", "fluent", "openfoam"}) {
      const Outcome run = place.run(
          {"export", fit, "--parameters", result + "/fit.json", "--to", target, "--out", "out"});
      ASSERT_EQ(run.status, 0) << run.err;
      for (const std::string& shown : {fitted.out, run.out}) {
        EXPECT_EQ(shown.find_first_of("\x1b\x07\r"), std::string::npos) << shown;
        EXPECT_EQ(shown.find("\xc2\x9b"), std::string::npos) << shown;
      }
    }
    // Plain Python runs the script up to the first name that only YADE defines.
    const Outcome python = run_command({"python3", "out/impact.py"}, place.path());
    EXPECT_NE(python.err.find("NameError"), std::string::npos) << name << python.err;
    // The comments of C and C++ are comments: the compilers come as far as the headers of Fluent
    // and OpenFOAM.
    for (const auto& [compiler, file, header] : std::vector<std::array<std::string, 3>>{
             {"gcc", "recoil_rebound.c", "udf.h"},
             {"g++", "recoilRebound/recoilRebound.H", "PatchInteractionModel.H"}}) {
      const Outcome c = run_command({compiler, "-fsyntax-only", "out/" + file}, place.path());
      EXPECT_NE(c.err.find(header + ": No such file"), std::string::npos) << c.err;
      EXPECT_EQ(c.err.find(file + ":1:"), std::string::npos) << c.err;
    }
  });
}

TEST(Safety, HostileNamesRunNothingInShards) {
  for_each_hostile_folder([](const Workplace& place, const std::string& name) {
    const Outcome wrote = run_command({RECOIL_BINARY, "cluster", "parallel", "fit.toml",
                                       "--replicates", "9", "--shards", "2", "--out", "job"},
                                      place / name);
    if (wrote.status == 2) {  // names that a script of Slurm cannot hold
      EXPECT_NE(wrote.err.find("this folder cannot be named in the scripts"), std::string::npos)
          << wrote.err;
      return;
    }
    ASSERT_EQ(wrote.status, 0) << wrote.err;
    const Outcome ran = run_command({"sh", "job/run.sh"}, place / name);
    EXPECT_EQ(ran.status, 0) << name << ran.err;
    EXPECT_TRUE(place.has(fs::path(name) / "job/fit.json")) << name << ran.err;
  });
}

TEST(Safety, SlurmIsToldOfItsLimitBeforeItRefuses) {
  const Workplace place;
  const Outcome many =
      place.run({"cluster", "slurm", "fit.toml", "--shards", "2000", "--out", "job"});
  ASSERT_EQ(many.status, 0) << many.err;
  EXPECT_NE(many.out.find("note: Slurm takes at most 1000 shards"), std::string::npos) << many.out;
  place.write("bin/scontrol", "#!/bin/sh\necho 'MaxArraySize            = 1001'\n");
  fs::permissions(place / "bin/scontrol", fs::perms::owner_all);
  const Outcome run = run_command(
      {"sh", "-c", "PATH=" + (place / "bin").string() + ":$PATH sh job/run.sh"}, place.path());
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("at most 1000 shards"), std::string::npos) << run.err;
}

// Debian's hardening=+all, as readelf shows it.
TEST(Safety, TheProgramIsHardened) {
  const Outcome elf = run_command(
      {"readelf", "--wide", "--dynamic", "--program-headers", "--dyn-syms", RECOIL_BINARY}, "/");
  ASSERT_EQ(elf.status, 0) << elf.err;
  for (const char* mark : {"GNU_RELRO", "BIND_NOW", "PIE", "__stack_chk_fail", "_chk@"}) {
    EXPECT_NE(elf.out.find(mark), std::string::npos) << mark;
  }
  EXPECT_NE(elf.out.find("GNU_STACK"), std::string::npos);
  EXPECT_EQ(elf.out.find("RWE"), std::string::npos);
#ifdef __x86_64__
  // Control-flow enforcement marks its targets by endbr64. (The note that the whole program is so
  // marked is missing where the C library's own start-up code is not, as on Debian 12.)
  const std::string program = support::text_of(RECOIL_BINARY);
  std::size_t marks = 0;
  for (std::size_t at = 0; (at = program.find("\xf3\x0f\x1e\xfa", at)) != std::string::npos; ++at) {
    ++marks;
  }
  EXPECT_GT(marks, 1000U);
#endif
}

/// A command that writes, and the files that belong to its result.
struct Writer {
  Words words;
  std::vector<std::string> files;
};

/// Runs a command that replaces an earlier result, and lets its n-th writing call fail, for all n.
/// All files must be the old ones, or all the new ones, and there must be no other files.
void expect_whole_files(const Workplace& place, const Writer& writer) {
  const auto run = [&](const std::string& settings) {
    return run_after(place, "export LD_PRELOAD=" FAILING_CALLS " " + settings, writer.words);
  };
  const Outcome first = run("FAILING_LOG=$PWD/calls");
  ASSERT_EQ(first.status, 0) << first.err;
  const std::size_t calls = place.read("calls").size();
  ASSERT_GE(calls, 4U);
  std::vector<std::string> whole;
  for (const std::string& file : writer.files) whole.push_back(place.read(file));
  const auto listing = place.listing();
  for (std::size_t n = 1; n <= calls; ++n) {
    support::count_hostile_cases();
    for (const std::string& file : writer.files) place.write(file, "old");
    const Outcome failed = run("FAILING_CALL=" + std::to_string(n));
    EXPECT_TRUE(failed.status == 0 || failed.status == 2) << n << failed.err;
    EXPECT_EQ(failed.err.find("defect"), std::string::npos) << failed.err;
    const bool old = failed.status != 0 && place.read(writer.files[0]) == "old";
    for (std::size_t f = 0; f < whole.size(); ++f) {
      EXPECT_EQ(place.read(writer.files[f]), old ? "old" : whole[f]) << n << writer.files[f];
    }
    EXPECT_EQ(place.listing(), listing) << "call " << n;
  }
}

TEST(Faults, AFitIsWrittenWholeOrNotAtAll) {
  const Workplace place;
  expect_whole_files(place,
                     {{"fit", "fit.toml", "--replicates", "9", "--threads", "1", "--out", "out"},
                      {"out/fit.json"}});
}

TEST(Faults, AnExportIsWrittenWholeOrNotAtAll) {
  const Workplace place;
  expect_whole_files(place, {{"export", "fit.toml", "--to", "table", "--replicates", "0",
                              "--threads", "1", "--out", "out"},
                             {"out/restitution.csv", "out/capture.csv"}});
}

TEST(Faults, APlanIsWrittenWholeOrNotAtAll) {
  const Workplace place;
  expect_whole_files(place, {{"plan", "fit.toml", "--velocity", "1,20", "--diameter", "4",
                              "--impacts", "100", "--out", "out", "--replace"},
                             {"out/plan.json", "out/plan.html", "out/points.csv"}});
}

TEST(Faults, AnImportIsWrittenWholeOrNotAtAll) {
  const Workplace place;
  place.write("new.csv", "V,e\n1,0.5\n2,0.6\n4,0.7\n9,0.8\n");
  const Words words = {"import",       "new.csv",   "--format",
                       "csv",          "--into",    "mine",
                       "--like",       "data",      "--diameter",
                       "4um",          "--map",     "incident_velocity=V:m/s,restitution=e",
                       "--provenance", "synthetic", "--replace"};
  expect_whole_files(place, {words, {"mine/points.csv"}});
}

TEST(Faults, AShardIsWrittenWholeOrNotAtAll) {
  const Workplace place;
  const Words words = {"fit", "fit.toml", "--replicates", "9",     "--threads",
                       "1",   "--shard",  "1/2",          "--out", "parts"};
  ASSERT_EQ(place.run(words).status, 0);
  std::string part;
  for (const auto& entry : fs::directory_iterator(place / "parts")) {
    part = "parts/" + entry.path().filename().string();
  }
  fs::remove(place / part);
  expect_whole_files(place, {words, {part}});
}

}  // namespace
