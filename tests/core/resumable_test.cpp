// Work that several processes share: who does what, what a file of rows is trusted with, what is
// missing.
#include "core/resumable.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <csignal>
#include <set>

#include "core/program.hpp"
#include "support/mistake.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;
using support::TemporaryFolder;

RC_GTEST_PROP(Shard, EveryPieceBelongsToExactlyOne, ()) {
  const auto pieces = *rc::gen::inRange<std::size_t>(0, 300);
  const auto of = *rc::gen::inRange<std::size_t>(1, 40);
  std::vector<int> owners(pieces, 0);
  for (std::size_t number = 1; number <= of; ++number) {
    std::size_t own = 0;
    for (std::size_t i = 0; i < pieces; ++i) {
      if (!Shard{number, of}.owns(i)) continue;
      ++owners[i];
      ++own;
    }
    const Shard shard{number, of};
    RC_ASSERT(shard.share(pieces) == own);
    RC_ASSERT(own * of < pieces + of);  // as evenly as whole pieces go
  }
  for (const int count : owners) RC_ASSERT(count == 1);
}

TEST(Shard, IsNamedFromOne) {
  const auto shard = shard_named("3/40");
  ASSERT_TRUE(shard);
  EXPECT_EQ(shard->number, 3U);
  EXPECT_EQ(shard->of, 40U);
  EXPECT_TRUE(shard_named("1/1"));
  EXPECT_TRUE(shard_named("1/1000000"));
  for (const char* text : {"", "3", "/", "3/", "/4", "0/4", "5/4", "-1/4", "1/-4", "1/4 ", " 1/4",
                           "1/4/5", "1.0/4", "0x1/4", "1/1000001", "1/99999999999999999999999"}) {
    EXPECT_FALSE(shard_named(text)) << text;
  }
}

TEST(Shard, NumbersAreListedAsSlurmTakesThem) {
  EXPECT_EQ(array_list({}), "");
  EXPECT_EQ(array_list({7}), "7");
  EXPECT_EQ(array_list({1, 2}), "1-2");
  EXPECT_EQ(array_list({1, 2, 3, 5, 8, 9, 11}), "1-3,5,8-9,11");
}

Origin some_origin() { return origin_here({"fit", "a.toml"}, "inputs", 5, 10, "start"); }

TEST(Origin, WhatDiffersIsNamed) {
  const Origin one = some_origin();
  const auto with = [&](const auto& change) {
    Origin other = one;
    change(other);
    return difference(one, other);
  };
  EXPECT_EQ(with([](Origin&) {}), "");
  EXPECT_EQ(with([](Origin& o) { o.folder = "/elsewhere"; }), "");
  std::set<std::string> words;
  words.insert(with([](Origin& o) { o.version = "2"; }));
  words.insert(with([](Origin& o) { o.program = "2"; }));
  words.insert(with([](Origin& o) { o.seed = 6; }));
  words.insert(with([](Origin& o) { o.command.push_back("--x"); }));
  words.insert(with([](Origin& o) { o.pieces = 11; }));
  words.insert(with([](Origin& o) { o.inputs = "2"; }));
  words.insert(with([](Origin& o) { o.arithmetic = "2"; }));
  words.insert(with([](Origin& o) { o.start = "2"; }));
  EXPECT_EQ(words.size(), 8U);
  EXPECT_FALSE(words.contains(""));
}

TEST(Origin, OnesThatDifferNeverShareAFile) {
  const Origin one = some_origin();
  std::set<std::string> names;
  const auto add = [&](const Origin& origin, const Shard& shard) {
    return names.insert(part_path("", origin, shard).string()).second;
  };
  EXPECT_TRUE(add(one, {1, 2}));
  EXPECT_FALSE(add(one, {1, 2}));
  EXPECT_TRUE(add(one, {2, 2}));
  EXPECT_TRUE(add(one, {1, 3}));
  Origin other = one;
  other.folder = "/elsewhere";  // decides no digit
  EXPECT_FALSE(add(other, {1, 2}));
  for (std::string Origin::*field :
       {&Origin::version, &Origin::program, &Origin::inputs, &Origin::arithmetic, &Origin::start}) {
    other = one;
    other.*field += "x";
    EXPECT_TRUE(add(other, {1, 2}));
  }
  other = one;
  other.seed = 6;
  EXPECT_TRUE(add(other, {1, 2}));
}

Pieces squares() {
  return {"squares", 10, 2,
          [](std::size_t piece) { return Json(0.1 * static_cast<double>(piece * piece)); }};
}

void run_shard(const Pieces& pieces, const Shard& shard, const fs::path& folder) {
  const auto kept = rows_of_shard(folder, some_origin(), shard);
  resumable(pieces, *kept, shard);
  write_part(*kept, folder, some_origin(), shard);
}

TEST(Resumable, PartsOfAnyNumberOfShardsGiveTheSameRows) {
  for (const std::size_t of : {1U, 3U, 4U, 13U}) {
    const TemporaryFolder folder;
    for (std::size_t number = 1; number <= of; ++number) {
      run_shard(squares(), {number, of}, folder.path());
      EXPECT_TRUE(has_part(folder.path(), some_origin(), {number, of}));
    }
    ASSERT_EQ(parts_in(folder.path()).size(), of);
    EXPECT_TRUE(missing_shards(parts_in(folder.path())).numbers.empty());
    const auto rows = rows_of_parts(folder.path(), some_origin());
    ASSERT_EQ(rows->size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(rows->find(i)->get<double>(), 0.1 * static_cast<double>(i * i));
    }
  }
}

TEST(Resumable, RunsOnlyWhatIsMissing) {
  KeptRows kept;
  kept.put(3, -1.0);
  std::atomic<int> ran = 0;
  Pieces pieces = squares();
  pieces.run = [&ran](std::size_t piece) {
    ++ran;
    return Json(piece);
  };
  resumable(pieces, kept);
  EXPECT_EQ(ran, 9);
  EXPECT_EQ(kept.find(3)->get<double>(), -1.0);
  EXPECT_EQ(kept.find(4)->get<double>(), 4.0);
}

TEST(Resumable, MissingShardsAreThoseOfTheNumberThatMostPartsHave) {
  const TemporaryFolder folder;
  for (const std::size_t number : {1U, 4U}) run_shard(squares(), {number, 4}, folder.path());
  const auto missing = [&] { return missing_shards(parts_in(folder.path())); };
  EXPECT_EQ(missing().of, 4U);
  EXPECT_EQ(missing().numbers, (std::vector<std::size_t>{2, 3}));
  EXPECT_THROW(rows_of_parts(folder.path(), some_origin()), ComputationError);
  run_shard(squares(), {2, 2}, folder.path());  // 1, 3, 5, ... are those of shards 2 and 4 of 4
  EXPECT_EQ(missing().numbers, (std::vector<std::size_t>{3}));
  // Pieces 2 and 6 are left; of five shards they belong to the third and the second.
  for (const std::size_t number : {1U, 4U, 5U}) run_shard(squares(), {number, 5}, folder.path());
  EXPECT_EQ(missing().of, 5U);
  EXPECT_EQ(missing().numbers, (std::vector<std::size_t>{2, 3}));
}

TEST(Resumable, AStoppedShardGoesOnWhereItWas) {
  const TemporaryFolder folder;
  const Shard shard{1, 2};
  std::vector<std::size_t> ran;
  Pieces work = squares();
  work.threads = 1;
  work.run = [&](std::size_t piece) {
    ran.push_back(piece);
    if (ran.size() == 3) std::raise(SIGTERM);
    return Json(static_cast<double>(piece));
  };
  EXPECT_THROW(run_shard(work, shard, folder.path()), Interrupted);
  EXPECT_EQ(ran.size(), 3U);
  EXPECT_FALSE(has_part(folder.path(), some_origin(), shard));
  EXPECT_EQ(rows_of_shard(folder.path(), some_origin(), shard)->size(), 2U);
  Origin other = some_origin();
  other.seed = 6;
  EXPECT_EQ(rows_of_shard(folder.path(), other, shard)->size(), 0U) << "another seed begins anew";
  run_shard(work, shard, folder.path());
  EXPECT_EQ(ran.size(), 6U) << "the piece at work when the signal came is run again";
  EXPECT_EQ(std::set<std::size_t>(ran.begin(), ran.end()), (std::set<std::size_t>{0, 2, 4, 6, 8}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "the part alone";
}

TEST(Resumable, DamagedPartsAreNotTrusted) {
  const TemporaryFolder folder;
  run_shard(squares(), {1, 1}, folder.path());
  const fs::path file = part_path(folder.path(), some_origin(), {1, 1});
  const std::string name = file.filename().string();
  const std::string whole = folder.read(name);
  const auto told = [&] {
    return support::message_of([&] { rows_of_parts(folder.path(), some_origin()); });
  };
  EXPECT_EQ(told(), "no error");
  for (const std::size_t length : {whole.size() - 1, whole.size() - 3, whole.size() / 2}) {
    folder.write(name, whole.substr(0, length));
    EXPECT_FALSE(has_part(folder.path(), some_origin(), {1, 1}))
        << "the head alone tells that it is cut: " << length;
    EXPECT_FALSE(read_rows(file));
  }
  // One digit of one row: the head cannot tell, the rows can.
  std::string altered = whole;
  const std::size_t digit = altered.find("0.4", altered.find('\n'));
  ASSERT_NE(digit, std::string::npos);
  altered[digit + 2] = '5';
  folder.write(name, altered);
  EXPECT_TRUE(has_part(folder.path(), some_origin(), {1, 1}));
  EXPECT_FALSE(read_rows(file));
  EXPECT_NE(told().find("remove it, and run shard 1/1 again"), std::string::npos) << told();
  folder.write(name, whole + "[1,7]\n");
  EXPECT_FALSE(read_rows(file)) << "more rows than the head says";
  for (const char* text : {"", "{}", "{\"rows\":0}", "{\"rows\":0,\"part\":3,\"of\":2}", "[1]"}) {
    folder.write(name, text);
    EXPECT_FALSE(has_part(folder.path(), some_origin(), {1, 1})) << text;
  }
}

TEST(Resumable, PartsOfOtherWorkAreRefused) {
  const TemporaryFolder folder;
  const auto told = [&](const Origin& origin) {
    return support::message_of([&] { rows_of_parts(folder.path(), origin); });
  };
  EXPECT_NE(told(some_origin()).find("there are no parts here"), std::string::npos);
  run_shard(squares(), {1, 2}, folder.path());
  EXPECT_THROW(rows_of_parts(folder.path(), some_origin()), ComputationError);  // 2/2 is missing
  run_shard(squares(), {2, 2}, folder.path());
  EXPECT_EQ(told(some_origin()), "no error");
  Origin other = some_origin();
  other.seed = 6;
  EXPECT_NE(told(other).find("this part belongs to another computation"), std::string::npos);
  // a head whose members are of other types is no part; one of another seed is one too many
  const std::string name = part_path(folder.path(), some_origin(), {1, 2}).filename().string();
  const std::string text = folder.read(name);
  folder.write("part-typed.jsonl", support::changed(text, "\"part\":1", "\"part\":\"1\""));
  EXPECT_EQ(told(some_origin()), "no error");
  folder.write("part-other.jsonl", support::changed(text, "\"seed\":5", "\"seed\":6"));
  EXPECT_NE(told(some_origin()).find("this part does not belong to part-"), std::string::npos)
      << told(some_origin());
}

TEST(Arithmetic, TheFingerprintIsTheSameEveryTime) {
  EXPECT_EQ(arithmetic_fingerprint().size(), 64U);
  EXPECT_EQ(arithmetic_fingerprint(), arithmetic_fingerprint());
}

}  // namespace
}  // namespace recoil
