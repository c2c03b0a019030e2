#include "core/files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "support/mistake.hpp"
#include "support/small_disk.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  std::string read_failure(const fs::path& path, std::uintmax_t limit = 1000) const {
    return support::message_of([&] { read_text_file(path, limit); });
  }

  support::TemporaryFolder folder_;
};

TEST_F(Files, ReadsTheWholeText) {
  folder_.write("a", "x\r\ny\n");
  EXPECT_EQ(read_text_file(folder_ / "a"), "x\r\ny\n");
  folder_.write("empty", "");
  EXPECT_EQ(read_text_file(folder_ / "empty"), "");
}

TEST_F(Files, DropsTheByteOrderMark) {
  folder_.write("a", "\xEF\xBB\xBFx");
  EXPECT_EQ(read_text_file(folder_ / "a"), "x");
}

TEST_F(Files, RefusesWhatIsNoTextFile) {
  EXPECT_NE(read_failure(folder_ / "missing").find("no such file"), std::string::npos);
  EXPECT_NE(read_failure(folder_.path()).find("this is a folder"), std::string::npos);
  folder_.write("binary", std::string("ab\0c", 4));
  EXPECT_NE(read_failure(folder_ / "binary").find("byte 3 is NUL"), std::string::npos);
}

TEST_F(Files, RefusesAHugeFileBeforeReadingIt) {
  folder_.write("huge", "");
  fs::resize_file(folder_ / "huge", 1ULL << 33);  // sparse: takes no room on the disk
  EXPECT_NE(read_failure(folder_ / "huge", 256ULL << 20).find("the file has 8589 MB"),
            std::string::npos);
  folder_.write("just", std::string(1000, 'x'));
  EXPECT_EQ(read_failure(folder_ / "just"), "no error");
  folder_.write("over", std::string(1001, 'x'));
  EXPECT_NE(read_failure(folder_ / "over"), "no error");
}

TEST_F(Files, WritesWholeAndLeavesNothingBeside) {
  const std::string text("line\n\0binary", 12);
  write_whole_file(folder_ / "new" / "deep" / "a.json", text);
  EXPECT_EQ(folder_.read("new/deep/a.json"), text);
  write_whole_file(folder_ / "new" / "deep" / "a.json", "second");
  EXPECT_EQ(folder_.read("new/deep/a.json"), "second");
  EXPECT_EQ(folder_.listing().size(), 3U) << "two folders and one file";
}

TEST_F(Files, LinksStayAndDevicesAreWrittenInto) {
  folder_.write("real", "old");
  fs::create_symlink("real", folder_ / "link");
  fs::create_symlink("link", folder_ / "link of a link");
  fs::create_symlink("not there yet", folder_ / "promise");
  write_whole_file(folder_ / "link of a link", "new");
  write_whole_file(folder_ / "promise", "kept");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link of a link"));
  EXPECT_EQ(folder_.read("real"), "new");
  EXPECT_EQ(folder_.read("not there yet"), "kept");

  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_whole_file(pipe, "through");
  std::array<char, 16> got{};
  EXPECT_EQ(read(reader, got.data(), got.size()), 7);
  EXPECT_STREQ(got.data(), "through");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(Files, AResultNeverTakesThePlaceOfItsInput) {
  folder_.write("my.toml", "x");
  fs::create_symlink("my.toml", folder_ / "link");
  read_text_file(folder_ / "my.toml");
  EXPECT_NO_THROW(require_free({folder_ / "result", folder_ / "none"}));
  for (const char* out : {"my.toml", "link"}) {
    const fs::path place = folder_ / out;
    const std::string told = place.string() +
                             ": this input file would be overwritten; choose another place "
                             "for the result";
    EXPECT_EQ(support::message_of([&] { require_free({place}); }), told);
    EXPECT_EQ(support::message_of([&] { write_whole_file(place, "y"); }), told);
    EXPECT_EQ(folder_.read("my.toml"), "x");
  }
  write_whole_file(folder_ / "my.toml", "y", Replacing::data);
  EXPECT_EQ(folder_.read("my.toml"), "y");
}

TEST_F(Files, DataStayUnlessTheyAreToBeReplaced) {
  for (const char* name : {"points.csv", "datapackage.json"}) {
    const fs::path place = folder_ / name;
    write_whole_file(place, "new");
    EXPECT_NE(support::message_of([&] {
                write_whole_file(place, "other");
              }).find("existing data would be overwritten"),
              std::string::npos);
    EXPECT_EQ(folder_.read(name), "new");
    write_whole_file(place, "replaced", Replacing::data);
    EXPECT_EQ(folder_.read(name), "replaced");
  }
}

TEST_F(Files, TwoResultsOfOneNameAreRefused) {
  folder_.write("a", "x");
  fs::create_hard_link(folder_ / "a", folder_ / "same");
  for (const std::vector<fs::path>& outputs :
       {std::vector<fs::path>{folder_ / "b", folder_ / "c" / ".." / "b"},
        std::vector<fs::path>{folder_ / "a", folder_ / "same"}}) {
    EXPECT_THROW(require_free(outputs, Replacing::data), InputError);
  }
}

TEST_F(Files, WhatIsInTheWayIsNamed) {
  folder_.write("file", "x");
  fs::create_directory(folder_ / "taken");
  const auto told = [](const auto& act) { return support::message_of(act); };
  // before the first of them is written
  EXPECT_NE(told([&] {
              write_whole_files({{folder_ / "file", "y"}, {folder_ / "taken", "y"}});
            }).find("taken: a folder has the name of this result"),
            std::string::npos);
  EXPECT_EQ(folder_.read("file"), "x");
  EXPECT_NE(told([] {
              write_whole_file("/dev/full", "x");
            }).find("the file cannot be written (No space left on device); make room there"),
            std::string::npos);
  EXPECT_NE(told([&] { write_whole_file(folder_ / "file/below", "x"); }).find("cannot be written"),
            std::string::npos);
  EXPECT_NE(told([&] {
              require_writable_folder(folder_ / "file/below");
            }).find("is a file, not a folder"),
            std::string::npos);
  EXPECT_NE(
      told([&] { require_writable_folder(folder_ / "file"); }).find("is a file, not a folder"),
      std::string::npos);
  EXPECT_EQ(told([&] { require_writable_folder(folder_ / "new/deep"); }), "no error");
  EXPECT_NE(told([] { read_text_file("/dev/zero", 1000); }).find("(no more is read); split it"),
            std::string::npos);
  EXPECT_EQ(sha256_of_file(folder_ / "missing"), "");
}

TEST_F(Files, AReplacedFileKeepsItsPermissions) {
  folder_.write("private", "x");
  for (const mode_t mode : {0600U, 0640U, 0755U}) {
    ASSERT_EQ(chmod((folder_ / "private").c_str(), mode), 0);
    write_whole_file(folder_ / "private", "y");
    struct stat after {};
    ASSERT_EQ(stat((folder_ / "private").c_str(), &after), 0);
    EXPECT_EQ(after.st_mode & 07777U, mode);
  }
}

TEST_F(Files, APipeIsReadAndOneWithoutAWriterIsNotWaitedForLong) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto none =
      support::message_of([&] { read_text_file(pipe, 1000, std::chrono::milliseconds(50)); });
  EXPECT_NE(none.find("no data have arrived for 0.05 s"), std::string::npos) << none;
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    const int end = open(pipe.c_str(), O_WRONLY);
    EXPECT_EQ(write(end, "one ", 4), 4);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    EXPECT_EQ(write(end, "two", 3), 3);
    close(end);
  });
  EXPECT_EQ(read_text_file(pipe), "one two");
  writer.join();
  EXPECT_NE(read_failure("/dev/zero", 1000).find("has more than"), std::string::npos);
}

TEST_F(Files, ANamedDescriptorIsReadToItsEnd) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_EQ(write(ends[1], "all of it", 9), 9);
  close(ends[1]);
  const std::string name = "/dev/fd/" + std::to_string(ends[0]);
  EXPECT_EQ(descriptor_named(name), ends[0]);
  EXPECT_EQ(read_text_file(name), "all of it");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(read_text_file(name), "");  // at its end, it is not waited for
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  close(ends[0]);
  EXPECT_EQ(descriptor_named("-"), 0);
  EXPECT_EQ(descriptor_named("/dev/stdin"), 0);
  for (const char* const other : {"/dev/null", "/dev/fd/x", "/dev/fd/", "a/dev/fd/3", "./-"}) {
    EXPECT_EQ(descriptor_named(other), std::nullopt) << other;
  }
}

TEST_F(Files, AskingWhetherAFolderCanBeWrittenMakesNothing) {
  require_writable_folder(folder_ / "new" / "deeper");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  folder_.write("file", "x");
  EXPECT_THROW(require_writable_folder(folder_ / "file"), InputError);
  EXPECT_THROW(require_writable_folder(folder_ / "file" / "below"), InputError);
}

TEST_F(Files, AFailedWriteLeavesNeitherPartNorDamage) {
  folder_.write("occupied", "x");
  EXPECT_THROW(write_whole_file(folder_ / "occupied" / "a.json", "y"), InputError);
  fs::create_directories(folder_ / "target" / "inside");
  EXPECT_THROW(write_whole_file(folder_ / "target", "y"), InputError);
  EXPECT_EQ(folder_.read("occupied"), "x");
  EXPECT_EQ(folder_.listing().size(), 3U);
}

TEST_F(Files, ThatBelongTogetherAreReplacedTogetherOrNotAtAll) {
  const support::SmallDisk disk;
  ASSERT_TRUE(disk.is_mounted());
  const fs::path place = disk / "place/disk";
  const auto files = [&](const std::string& text, std::size_t size) {
    return std::vector<WholeFile>{{place / "a", text}, {place / "b", std::string(size, 'x')}};
  };
  write_whole_files(files("old", 10));
  const std::string told = support::message_of([&] { write_whole_files(files("new", 8U << 20U)); });
  EXPECT_EQ(told,
            (place / "b").string() +
                ": the file cannot be written (No space left on device); make room there, and "
                "run the same command again");
  EXPECT_EQ(disk.read("place/disk/a"), "old");
  EXPECT_EQ(fs::file_size(place / "b"), 10U);
  write_whole_files(files("new", 20));
  EXPECT_EQ(disk.read("place/disk/a"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(place), {}), 2) << "nothing beside them";
}

// FIPS 180-4 examples and NIST's long one, as published at csrc.nist.gov.
TEST(Hash, KnownAnswers) {
  // Of "abc": RFC 1321, FIPS 180-4.
  EXPECT_EQ(hash_hex("md5", "abc"), "900150983cd24fb0d6963f7d28e17f72");
  EXPECT_EQ(hash_hex("sha1", "abc"), "a9993e364706816aba3e25717850c26c9cd0d89d");
  EXPECT_EQ(hash_hex("sha512", "abc").substr(0, 32), "ddaf35a193617abacc417349ae204131");
  EXPECT_EQ(hash_hex("crc32", "abc"), "");
}

TEST(Sha256, KnownAnswers) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256_hex(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace recoil
