#include "core/files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "core/error.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "recoil-files-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

  std::string get(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  std::string read_failure(const fs::path& path, std::uintmax_t limit = 1000) const {
    try {
      read_text_file(path, limit);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder_),
                                                  fs::recursive_directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(Files, ReadsTheWholeText) {
  put("a", "x\r\ny\n");
  EXPECT_EQ(read_text_file(folder_ / "a"), "x\r\ny\n");
  put("empty", "");
  EXPECT_EQ(read_text_file(folder_ / "empty"), "");
}

TEST_F(Files, DropsTheByteOrderMark) {
  put("a", "\xEF\xBB\xBFx");
  EXPECT_EQ(read_text_file(folder_ / "a"), "x");
}

TEST_F(Files, RefusesWhatIsNoTextFile) {
  EXPECT_NE(read_failure(folder_ / "missing").find("no such file"), std::string::npos);
  EXPECT_NE(read_failure(folder_).find("this is a folder"), std::string::npos);
  put("binary", std::string("ab\0c", 4));
  EXPECT_NE(read_failure(folder_ / "binary").find("byte 3 is NUL"), std::string::npos);
}

TEST_F(Files, RefusesAHugeFileBeforeReadingIt) {
  put("huge", "");
  fs::resize_file(folder_ / "huge", 1ULL << 33);  // sparse: takes no room on the disk
  EXPECT_NE(read_failure(folder_ / "huge", 256ULL << 20).find("the file has 8589 MB"),
            std::string::npos);
  put("just", std::string(1000, 'x'));
  EXPECT_EQ(read_failure(folder_ / "just"), "no error");
  put("over", std::string(1001, 'x'));
  EXPECT_NE(read_failure(folder_ / "over"), "no error");
}

TEST_F(Files, WritesWholeAndLeavesNothingBeside) {
  const std::string text("line\n\0binary", 12);
  write_whole_file(folder_ / "new" / "deep" / "a.json", text);
  EXPECT_EQ(get("new/deep/a.json"), text);
  write_whole_file(folder_ / "new" / "deep" / "a.json", "second");
  EXPECT_EQ(get("new/deep/a.json"), "second");
  EXPECT_EQ(entries(), 3U) << "two folders and one file";
}

TEST_F(Files, AskingWhetherAFolderCanBeWrittenMakesNothing) {
  require_writable_folder(folder_ / "new" / "deeper");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  put("file", "x");
  EXPECT_THROW(require_writable_folder(folder_ / "file"), InputError);
  EXPECT_THROW(require_writable_folder(folder_ / "file" / "below"), InputError);
}

TEST_F(Files, AFailedWriteLeavesNeitherPartNorDamage) {
  put("occupied", "x");
  EXPECT_THROW(write_whole_file(folder_ / "occupied" / "a.json", "y"), InputError);
  fs::create_directories(folder_ / "target" / "inside");
  EXPECT_THROW(write_whole_file(folder_ / "target", "y"), InputError);
  EXPECT_EQ(get("occupied"), "x");
  EXPECT_EQ(entries(), 3U);
}

// FIPS 180-4 examples and NIST's long one, as published at csrc.nist.gov.
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
