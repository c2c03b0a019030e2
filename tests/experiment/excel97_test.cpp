// Workbooks of Excel 97 (.xls): the stored values, and what damaged files do. The files are written
// here, record by record, after [MS-XLS] and [MS-CFB].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "experiment/workbook.hpp"
#include "support/mistake.hpp"

namespace {

using recoil::read_sheet;
using recoil::Sheet;
using testing::ElementsAre;
using testing::HasSubstr;

std::string little(std::uint64_t value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 0xFFU);
  return text;
}
std::string u16(std::uint64_t value) { return little(value, 2); }
std::string u32(std::uint64_t value) { return little(value, 4); }
std::string f64(double value) { return little(std::bit_cast<std::uint64_t>(value), 8); }

std::string record(unsigned kind, const std::string& data) {
  return u16(kind) + u16(data.size()) + data;
}
/// A part of the stream: 5, the workbook, or 16, a sheet.
std::string part(unsigned type, const std::string& records) {
  return record(0x809, u16(0x600) + u16(type) + std::string(12, '\0')) + records + record(0xA, "");
}
std::string cell(unsigned row, unsigned column, unsigned style = 0) {
  return u16(row) + u16(column) + u16(style);
}
std::string number(unsigned row, unsigned column, double value, unsigned style = 0) {
  return record(0x203, cell(row, column, style) + f64(value));
}
std::string narrow(const std::string& text) { return u16(text.size()) + '\0' + text; }

/// A compound file with one stream. @param next of the sectors of the stream, if not the usual one
std::string compound(std::string stream, const std::string& name = "Workbook",
                     std::uint32_t last = 0xFFFFFFFE) {
  const std::size_t size = stream.size();
  const bool small = size < 4096;
  const std::size_t unit = small ? 64 : 512;
  stream.resize((size + unit - 1) / unit * unit);
  std::string smalls;  // the table of small sectors
  const std::size_t pieces = stream.size() / unit;
  for (std::size_t k = 1; small && k <= pieces; ++k) smalls += u32(k < pieces ? k : last);
  stream.resize((stream.size() + 511) / 512 * 512);
  const std::size_t sectors = stream.size() / 512;
  // sector 0: table; 1: directory; 2: table of small sectors; then the stream
  std::string table = u32(0xFFFFFFFD) + u32(0xFFFFFFFE) + u32(0xFFFFFFFE);
  for (std::size_t k = 1; k <= sectors; ++k) {
    table += u32(k < sectors ? k + 3 : small ? 0xFFFFFFFE : last);
  }
  EXPECT_LE(table.size(), 512U);
  table.resize(512, '\xFF');
  smalls.resize(512, '\xFF');
  const auto entry = [](const std::string& called, char type, std::size_t first,
                        std::size_t length) {
    std::string wide;
    for (const char c : called) wide += std::string{c, '\0'};
    wide.resize(64);
    return wide + u16(2 * called.size() + 2) + type + std::string(49, '\0') + u32(first) +
           u32(length) + u32(0);
  };
  std::string directory = entry("Root Entry", 5, small ? 3 : 0xFFFFFFFE, small ? size : 0) +
                          entry(name, 2, small ? 0 : 3, size);
  directory.resize(512);
  std::string header = "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1" + std::string(16, '\0') + u16(0x3E) +
                       u16(3) + u16(0xFFFE) + u16(9) + u16(6) + std::string(10, '\0') + u32(1) +
                       u32(1) + u32(0) + u32(4096) + u32(2) + u32(1) + u32(0xFFFFFFFE) + u32(0) +
                       u32(0);
  header.resize(512, '\xFF');
  return header + table + directory + smalls + stream;
}

/// The stream of a workbook: a hidden sheet with 7, the sheet with these cells, and a chart.
/// @param globals more records of the workbook
std::string stream_of(const std::string& cells, const std::string& globals = "") {
  const auto listed = [](std::size_t start, const std::string& state_and_type,
                         const std::string& name) {
    return record(0x85, u32(start) + state_and_type + static_cast<char>(name.size()) + '\0' + name);
  };
  const std::string hidden = part(16, number(0, 0, 7.0));
  const std::string shown = part(16, cells);
  const auto head = [&](std::size_t start) {
    return part(5, globals + listed(start, {'\1', '\0'}, "old") +
                       listed(start + hidden.size(), {'\0', '\0'}, "points") +
                       listed(0, {'\0', '\2'}, "a chart"));
  };
  return head(head(0).size()) + hidden + shown;
}

/// Number formats 0, 14 (a date), 164 (a date with a code) and 165 (none), by style, and texts. The
/// second text goes on in a second record, where its letters have two bytes; the first has runs of
/// formats.
std::string globals() {
  std::string all = record(0x41E, u16(164) + narrow("[$-407]dd/mm/yy;@")) +
                    record(0x41E, u16(165) + narrow("0.00\" m/s\""));
  for (const unsigned format : {0U, 14U, 164U, 165U}) all += record(0xE0, u16(0) + u16(format));
  const std::string first = u16(7) + '\x08' + u16(1) + "V [m/s]" + std::string(4, 'x');
  const std::string wide = u16(0x00E9) + u16(0xD83D) + u16(0xDE00);
  return all + record(0xFC, u32(2) + u32(2) + first + u16(6) + '\0' + "res") +
         record(0x3C, '\1' + wide);
}

Sheet read(const std::string& stream, const std::string& name = "") {
  return read_sheet(compound(stream), "book.xls", name);
}

TEST(Excel97, GivesTheStoredValues) {
  const std::string cells =
      record(0xFD, cell(0, 0) + u32(0)) + record(0xFD, cell(0, 1) + u32(1)) +
      record(0x204, cell(0, 3) + narrow("a \"b\"")) + number(1, 0, 0.812345678901) +  //
      record(0x27E, cell(1, 1, 3) + u32(490U << 2U | 3U)) +                           // 490 / 100
      record(0x27E, cell(1, 2) + u32(0x3FF80000)) +   // upper half of 1.5
      record(0x27E, cell(1, 3) + u32(0xFFFFFFFEU)) +  // -1
      record(0xBD,
             u16(2) + u16(0) + u16(0) + u32(5U << 2U | 2U) + u16(0) + u32(6U << 2U | 2U) + u16(1)) +
      record(0x205, cell(2, 2) + "\1" + '\0') + record(0x205, cell(2, 3) + "\x2A\1") +
      record(6, cell(4, 0) + f64(0.425) + std::string(8, '\0')) +
      record(6, cell(4, 1) + std::string(6, '\0') + "\xFF\xFF" + std::string(8, '\0')) +
      record(0x207, narrow("text")) +
      record(6, cell(4, 2) + '\1' + '\0' + '\1' + std::string(3, '\0') + "\xFF\xFF") +
      // a chart within the sheet, whose numbers are not those of the sheet
      part(32, number(0, 0, 99.0));
  const std::string stream = stream_of(cells, globals());
  ASSERT_LT(stream.size(), 4096U);  // thus in small sectors
  for (const std::string& filled : {stream, stream + std::string(5000, '\0')}) {
    const Sheet sheet = read(filled);
    EXPECT_EQ(sheet.table,
              "\"V [m/s]\"\t\"resé😀\"\t\t\"a \"\"b\"\"\"\n"
              "0.812345678901\t4.9\t1.5\t-1\n"
              "5\t6\t1\t\"#N/A\"\n"
              "\n"
              "0.425\t\"text\"\t1\t\n");
    EXPECT_EQ(sheet.name, "points");
    EXPECT_THAT(sheet.others, ElementsAre("old"));
  }
}

TEST(Excel97, SheetsByNameAndNumberAndDatesAsTexts) {
  const std::string cells = number(0, 0, 45413.0, 1) + number(0, 1, 45413.25, 2) +
                            number(0, 2, 0.5, 1) + number(0, 3, 2.5, 3);
  // 45413 days after 1899-12-30 are 1 May 2024
  const std::string row = "\"date 2024-05-01\"\t\"date 2024-05-01\"\t\"time 0.5 d\"\t2.5\n";
  const std::string stream = stream_of(cells, globals());
  EXPECT_EQ(read(stream, "points").table, row);
  EXPECT_EQ(read(stream, "2").table, row);
  EXPECT_EQ(read(stream, "old").table, "7\n");
  EXPECT_EQ(read(stream, "1").table, "7\n");
  for (const char* const none : {"3", "0", "-1", "x"}) {
    EXPECT_THAT(support::message_of([&] { read(stream, none); }), HasSubstr("no sheet is called"));
  }
  const std::string since_1904 =
      stream_of(number(0, 0, 43951.0, 1), record(0x22, u16(1)) + globals());
  EXPECT_EQ(read(since_1904).table, "\"date 2024-05-01\"\n");
}

TEST(Excel97, WhatCannotBeReadHasItsMessage) {
  const auto complaint = [](const std::string& bytes) {
    return support::message_of([&] { read_sheet(bytes, "book.xls", ""); });
  };
  EXPECT_THAT(complaint(compound(stream_of("", record(0x2F, u16(1))))), HasSubstr("encrypted"));
  EXPECT_THAT(complaint(compound("x", "EncryptedPackage")), HasSubstr("encrypted"));
  EXPECT_THAT(complaint(compound("x", "WordDocument")), HasSubstr("not a workbook"));
  std::string excel_95 = stream_of("");
  excel_95[5] = 5;
  EXPECT_THAT(complaint(compound(excel_95)), HasSubstr("not a workbook"));
  // rings, of sectors and of small sectors, and texts that are not there
  const std::string long_stream = stream_of("") + std::string(5000, '\0');
  EXPECT_THAT(complaint(compound(long_stream, "Workbook", 3)), HasSubstr("damaged"));
  EXPECT_THAT(complaint(compound(stream_of(""), "Workbook", 0)), HasSubstr("damaged"));
  EXPECT_THAT(complaint(compound(stream_of(record(0xFD, cell(0, 0) + u32(1))))),
              HasSubstr("damaged"));
  EXPECT_THAT(complaint(compound(stream_of("", record(0xFC, u32(9) + u32(0xFFFFFFFF))))),
              HasSubstr("too large"));
}

TEST(Excel97, EveryDamageIsAMessageOrATable) {
  const std::string good = compound(stream_of(
      record(0xFD, cell(0, 0) + u32(0)) + record(0xFD, cell(0, 1) + u32(1)) + number(1, 0, 2.5, 2) +
          record(6, cell(4, 1) + std::string(6, '\0') + "\xFF\xFF" + std::string(8, '\0')) +
          record(0x207, narrow("text")),
      globals()));
  const auto attempt = [](const std::string& bytes) {
    try {
      read_sheet(bytes, "book.xls", "");
    } catch (const recoil::InputError& error) {
      EXPECT_NE(error.problem(), "");
    }
  };
  for (std::size_t length = 8; length < good.size(); length += 7) attempt(good.substr(0, length));
  for (std::size_t at = 8; at < good.size(); ++at) {
    for (const unsigned flip : {0x01U, 0x80U, 0xFFU}) {
      std::string damaged = good;
      damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ flip);
      attempt(damaged);
    }
  }
}

}  // namespace
