// Work that several processes share: who does what, what a file of rows is trusted with, what is
// missing.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <csignal>
#include <set>

#include "core/arithmetic.hpp"
#include "core/interrupt.hpp"
#include "core/parts.hpp"
#include "core/row_file.hpp"
#include "core/shared_work.hpp"
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

Origin some_origin() {
  return {{"fit", "a.toml"}, "/somewhere", "1.0", "program", "inputs", 5, 10, "digits", "start"};
}

TEST(Parts, WhatDiffersIsNamed) {
  const Origin one = some_origin();
  const auto with = [&](const auto& change) {
    Origin other = one;
    change(other);
    return difference(one, other);
  };
  EXPECT_EQ(with([](Origin&) {}), std::nullopt);
  EXPECT_EQ(with([](Origin& o) { o.folder = "/elsewhere"; }), std::nullopt);
  EXPECT_EQ(with([](Origin& o) { o.version = "2"; }), OriginDifference::version);
  EXPECT_EQ(with([](Origin& o) { o.program = "2"; }), OriginDifference::program);
  EXPECT_EQ(with([](Origin& o) { o.seed = 6; }), OriginDifference::seed);
  EXPECT_EQ(with([](Origin& o) { o.command.push_back("--x"); }), OriginDifference::command);
  EXPECT_EQ(with([](Origin& o) { o.pieces = 11; }), OriginDifference::pieces);
  EXPECT_EQ(with([](Origin& o) { o.inputs = "2"; }), OriginDifference::inputs);
  EXPECT_EQ(with([](Origin& o) { o.arithmetic = "2"; }), OriginDifference::arithmetic);
  EXPECT_EQ(with([](Origin& o) { o.start = "2"; }), OriginDifference::start);
}

TEST(Parts, OriginsThatDifferNeverShareAFile) {
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
  other.folder = "/elsewhere";  // where it was started decides nothing
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

/// The rows of `parts` [pieces], null where there is none.
std::vector<Json> rows_of(const std::vector<fs::path>& parts, std::size_t pieces) {
  std::vector<Json> rows(pieces);
  const std::vector<bool> there =
      read_parts(parts, pieces, [&rows](std::size_t piece, const Json& row) { rows[piece] = row; });
  for (std::size_t i = 0; i < pieces; ++i) EXPECT_EQ(there[i], !rows[i].is_null()) << i;
  return rows;
}

SharedWork squares() {
  SharedWork work;
  work.label = "squares";
  work.pieces = 10;
  work.threads = 2;
  work.run = [](std::size_t piece) { return Json(0.1 * static_cast<double>(piece * piece)); };
  return work;
}

TEST(SharedWork, PartsOfAnyNumberOfShardsGiveTheSameRows) {
  for (const std::size_t of : {1U, 3U, 4U, 13U}) {
    const TemporaryFolder folder;
    for (std::size_t number = 1; number <= of; ++number) {
      write_part(squares(), some_origin(), {number, of}, folder.path());
    }
    const std::vector<PartFile> parts = parts_in(folder.path());
    ASSERT_EQ(parts.size(), of);
    EXPECT_EQ(missing_shards(parts, 10, of), std::vector<std::size_t>{});
    std::vector<fs::path> files;
    for (const PartFile& part : parts) {
      EXPECT_FALSE(difference(part.origin, some_origin()));
      files.push_back(part.file);
    }
    const std::vector<Json> rows = rows_of(files, 10);
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(rows[i].get<double>(), 0.1 * static_cast<double>(i * i));
    }
  }
}

TEST(SharedWork, WhatIsMissingIsToldInShardsOfAnyNumber) {
  const TemporaryFolder folder;
  for (const std::size_t number : {1U, 4U}) {
    write_part(squares(), some_origin(), {number, 4}, folder.path());
  }
  EXPECT_EQ(missing_shards(parts_in(folder.path()), 10, 4), (std::vector<std::size_t>{2, 3}));
  // 1, 5, 9 and 2, 6: of two shards both lack something, of five those that own one of these.
  EXPECT_EQ(missing_shards(parts_in(folder.path()), 10, 2), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(missing_shards(parts_in(folder.path()), 10, 5), (std::vector<std::size_t>{1, 2, 3, 5}));
  write_part(squares(), some_origin(), {2, 2}, folder.path());
  EXPECT_EQ(missing_shards(parts_in(folder.path()), 10, 4), (std::vector<std::size_t>{3}));
}

TEST(SharedWork, AStoppedShardGoesOnWhereItWas) {
  const TemporaryFolder folder;
  const Shard shard{1, 2};
  SharedWork work = squares();
  work.threads = 1;
  std::vector<std::size_t> ran;
  work.run = [&](std::size_t piece) {
    ran.push_back(piece);
    if (ran.size() == 2) std::raise(SIGTERM);
    return Json(static_cast<double>(piece));
  };
  EXPECT_THROW(write_part(work, some_origin(), shard, folder.path()), Interrupted);
  EXPECT_EQ(ran.size(), 2U);
  EXPECT_TRUE(parts_in(folder.path()).empty());  // what is unfinished is no part
  EXPECT_TRUE(fs::exists(unfinished_path(folder.path(), some_origin(), shard)));
  // Another seed does not go on from it.
  Origin other = some_origin();
  other.seed = 6;
  EXPECT_FALSE(fs::exists(unfinished_path(folder.path(), other, shard)));
  write_part(work, some_origin(), shard, folder.path());
  EXPECT_EQ(ran.size(), 5U);
  EXPECT_EQ(std::set<std::size_t>(ran.begin(), ran.end()), (std::set<std::size_t>{0, 2, 4, 6, 8}));
  EXPECT_FALSE(fs::exists(unfinished_path(folder.path(), some_origin(), shard)));
  ASSERT_EQ(parts_in(folder.path()).size(), 1U);
}

TEST(SharedWork, DamagedPartsAreNotTrusted) {
  const TemporaryFolder folder;
  write_part(squares(), some_origin(), {1, 2}, folder.path());
  const fs::path file = part_path(folder.path(), some_origin(), {1, 2});
  const std::string whole = folder.read(file.filename().string());
  EXPECT_EQ(rows_of({file}, 10)[2].get<double>(), 0.4);
  for (const std::size_t length : {whole.size() - 1, whole.size() - 3, whole.size() / 2}) {
    folder.write(file.filename().string(), whole.substr(0, length));
    EXPECT_TRUE(rows_of({file}, 10)[2].is_null()) << length;
    EXPECT_TRUE(parts_in(folder.path()).empty())
        << "its head alone tells that it is cut: " << length;
  }
  // One digit of one row: the head cannot tell, the rows can.
  std::string altered = whole;
  const std::size_t digit = altered.find("0.4", altered.find('\n'));
  ASSERT_NE(digit, std::string::npos);
  altered[digit + 2] = '5';
  folder.write(file.filename().string(), altered);
  ASSERT_EQ(parts_in(folder.path()).size(), 1U);
  EXPECT_FALSE(is_unaltered(file));
  EXPECT_TRUE(rows_of({file}, 10)[2].is_null());
  EXPECT_TRUE(rows_of({file}, 10)[0].is_null()) << "nothing of it is taken";
  folder.write(file.filename().string(), whole);
  EXPECT_TRUE(is_unaltered(file));
  folder.write(file.filename().string(), whole + "[1,7]\n");
  EXPECT_TRUE(rows_of({file}, 10)[1].is_null()) << "more rows than the head says";
  EXPECT_TRUE(rows_of({file}, 3)[0].is_null()) << "a piece beyond the last";
  for (const char* text : {"", "{}", "{\"rows\":0}", "{\"rows\":0,\"part\":3,\"of\":2}", "[1]"}) {
    folder.write(file.filename().string(), text);
    EXPECT_FALSE(part_in(file)) << text;
  }
}

TEST(Arithmetic, TheFingerprintIsTheSameEveryTime) {
  EXPECT_EQ(arithmetic_fingerprint().size(), 64U);
  EXPECT_EQ(arithmetic_fingerprint(), arithmetic_fingerprint());
}

}  // namespace
}  // namespace recoil
