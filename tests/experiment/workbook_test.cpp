// Workbooks: the stored values, whatever the cells show, and what a hostile or damaged one can do.
// The archives are written here by libzip; the parts follow ECMA-376 and ISO 26300.
#include "experiment/workbook.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zip.h>

#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "import_folder.hpp"
#include "support/mistake.hpp"
#include "support/temporary_folder.hpp"

namespace {

using import_folder::Place;
using recoil::ImportFormat;
using recoil::read_sheet;
using recoil::Sheet;
using testing::ElementsAre;
using testing::HasSubstr;

using Parts = std::vector<std::pair<std::string, std::string>>;

/// The bytes of a zip archive. @param password encrypts its parts
std::string zipped(const Parts& parts, const char* password = nullptr) {
  const support::TemporaryFolder place;
  const std::string file = place / "book.zip";
  zip_t* const archive = zip_open(file.c_str(), ZIP_CREATE, nullptr);
  for (const auto& [name, text] : parts) {
    zip_source_t* const source = zip_source_buffer(archive, text.data(), text.size(), 0);
    const auto index =
        static_cast<zip_uint64_t>(zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8));
    if (password != nullptr) {
      zip_file_set_encryption(archive, index, ZIP_EM_AES_256, password);
    }
  }
  EXPECT_EQ(zip_close(archive), 0);
  return support::text_of(file);
}

std::string relations(const std::vector<std::pair<std::string, std::string>>& type_and_target) {
  std::string xml =
      "<Relationships xmlns='http://schemas.openxmlformats.org/package/2006/relationships'>";
  int id = 1;
  for (const auto& [type, target] : type_and_target) {
    xml += fmt::format(
        "<Relationship Id='rId{}' Type='http://schemas.openxmlformats.org/officeDocument/2006/"
        "relationships/{}' Target='{}'/>",
        id++, type, target);
  }
  return xml + "</Relationships>";
}

/// A workbook of two sheets, `rows` in the first one.
Parts xlsx(const std::string& rows, const std::string& state = "visible") {
  return {
      {"_rels/.rels", relations({{"officeDocument", "xl/workbook.xml"}})},
      {"xl/_rels/workbook.xml.rels", relations({{"worksheet", "worksheets/sheet1.xml"},
                                                {"worksheet", "/xl/worksheets/sheet2.xml"},
                                                {"styles", "styles.xml"},
                                                {"sharedStrings", "sharedStrings.xml"}})},
      {"xl/workbook.xml",
       "<workbook xmlns:r='http://schemas.openxmlformats.org/officeDocument/2006/relationships'>"
       "<sheets><sheet name='points' sheetId='7' state='" +
           state +
           "' r:id='rId1'/><sheet name='my notes' sheetId='9' r:id='rId2'/></sheets></workbook>"},
      {"xl/styles.xml",
       "<styleSheet><numFmts><numFmt numFmtId='164' formatCode='0.0'/>"
       "<numFmt numFmtId='165' formatCode='[$-407]dd/mm/yy;@'/>"
       "<numFmt numFmtId='166' formatCode='0.00\" m/s\"'/></numFmts><cellXfs><xf numFmtId='0'/>"
       "<xf numFmtId='164'/><xf numFmtId='165'/><xf numFmtId='9'/><xf numFmtId='14'/>"
       "<xf numFmtId='166'/></cellXfs></styleSheet>"},
      {"xl/sharedStrings.xml",
       "<sst><si><t>V [m/s]</t></si><si><r><t>res</t></r><r><rPr/><t>titution</t></r>"
       "<rPh sb='0' eb='1'><t>aloud</t></rPh></si></sst>"},
      {"xl/worksheets/sheet1.xml", "<worksheet><dimension ref='A1:ZZZZZZ99999999999'/><sheetData>" +
                                       rows + "</sheetData></worksheet>"},
      {"xl/worksheets/sheet2.xml",
       "<x:worksheet xmlns:x='a'><x:sheetData><x:row><x:c><x:v>5</x:v></x:c></x:row></x:sheetData>"
       "</x:worksheet>"}};
}

Sheet read(const Parts& parts, const std::string& name = "", char decimal = '.') {
  return read_sheet(zipped(parts), "book.xlsx", name, decimal);
}

std::string complaint(const std::string& bytes, const std::string& name = "") {
  return support::message_of([&] { read_sheet(bytes, "book.xlsx", name); });
}

TEST(Workbook, GivesTheStoredValues) {
  const Sheet sheet = read(
      xlsx("<row r='1'><c r='A1' t='s'><v>0</v></c><c r='B1' t='s'><v>1</v></c>"
           "<c r='C1' t='inlineStr'><is><t>a \"b\"&#9;&amp; c</t></is></c></row>"
           // shown as 0.8, 81 %, 4.90 m/s
           "<row r='2'><c r='A2' s='1'><v>0.85</v></c><c r='B2' s='3'><v>0.812345678901</v></c>"
           "<c r='C2' s='5'><v>4.9000000000000004</v></c></row>"
           // a row without cells, one without references, and a cell far to the right of its row
           "<row r='3'/><row><c><v>1E-6</v></c><c t='b'><v>1</v></c></row>"
           "<row r='6'><c r='C6'><f>A2/2</f><v>0.425</v></c></row>"));
  EXPECT_EQ(sheet.table,
            "\"V [m/s]\"\t\"restitution\"\t\"a \"\"b\"\" & c\"\n"
            "0.85\t0.812345678901\t4.9\n"
            "\n"
            "1e-06\t1\t\n"
            "\n"
            "\t\t0.425\n");
  EXPECT_EQ(sheet.name, "points");
  EXPECT_THAT(sheet.others, ElementsAre("my notes"));
}

TEST(Workbook, NamesWhatIsNoNumber) {
  const Sheet sheet = read(xlsx(
      // 45413 days after 1899-12-30 are 1 May 2024
      "<row><c s='2'><v>45413</v></c><c s='4'><v>45413.5</v></c><c s='4'><v>0.5</v></c></row>"
      "<row><c t='d'><v>2024-05-01</v></c><c t='e'><v>#N/A</v></c><c><f>B2+0.1</f></c></row>"));
  EXPECT_EQ(sheet.table,
            "\"date 2024-05-01\"\t\"date 2024-05-01\"\t\"time 0.5 d\"\n"
            "\"date 2024-05-01\"\t\"#N/A\"\t\"formula without a value: B2+0.1\"\n");
  Parts since_1904 = xlsx("<row><c s='2'><v>43951</v></c></row>");
  std::string& book = since_1904[2].second;
  book.insert(book.find("<sheets>"), "<workbookPr date1904='1'/>");
  EXPECT_EQ(read(since_1904).table, "\"date 2024-05-01\"\n");
}

TEST(Workbook, SheetsAreChosenByNameOrTheFirstThatIsSeen) {
  const Parts parts = xlsx("<row><c><v>1</v></c></row>", "hidden");
  EXPECT_EQ(read(parts).name, "my notes");
  EXPECT_EQ(read(parts).table, "5\n");
  EXPECT_EQ(read(parts, "points").table, "1\n");
  EXPECT_EQ(read(parts, "1").table, "1\n");
  EXPECT_EQ(read(parts, "2").name, "my notes");
  EXPECT_THAT(complaint(zipped(parts), "point"),
              HasSubstr("book.xlsx: no sheet is called 'point'; did you mean 'points'?"));
}

TEST(Workbook, OfPhyphoxTheSheetWithTheBouncesIsRead) {
  Parts parts = xlsx("<row><c><v>1</v></c></row>");
  parts[2].second = support::changed(parts[2].second, "name='points'", "name='Metadata Device'");
  EXPECT_EQ(read(parts).name, "my notes");
  parts[2].second = support::changed(parts[2].second, "name='my notes'", "name='Energy'");
  EXPECT_EQ(read(parts).name, "Energy");
}

TEST(Workbook, OpenDocument) {
  const Parts parts = {
      {"mimetype", "application/vnd.oasis.opendocument.spreadsheet"},
      {"content.xml",
       "<office:document-content xmlns:office='o' xmlns:table='t' xmlns:text='x'><office:body>"
       "<office:spreadsheet><table:table table:name='points'><table:table-header-rows>"
       "<table:table-row><table:table-cell office:value-type='string'><text:p>V "
       "<text:span>[m/s]</text:span></text:p></table:table-cell><table:table-cell/>"
       "<table:table-cell office:value-type='string'><text:p>e</text:p></table:table-cell>"
       "</table:table-row></table:table-header-rows>"
       "<table:table-row table:number-rows-repeated='2'><table:table-cell "
       "office:value-type='float' office:value='0.85' table:number-columns-repeated='2'><text:p>0.8"
       "</text:p></table:table-cell><table:table-cell office:value-type='boolean' "
       "office:boolean-value='true'/></table:table-row>"
       "<table:table-row><table:table-cell office:value-type='date' office:date-value='2024-05-01'>"
       "<text:p>1.5</text:p></table:table-cell></table:table-row>"
       "<table:table-row table:number-rows-repeated='1048570'><table:table-cell "
       "table:number-columns-repeated='16384'/></table:table-row>"
       "</table:table><table:table table:name='b'/></office:spreadsheet></office:body>"
       "</office:document-content>"}};
  const Sheet sheet = read(parts, "", ',');
  EXPECT_EQ(sheet.table,
            "\"V [m/s]\"\t\t\"e\"\n0,85\t0,85\t1\n0,85\t0,85\t1\n\"date 2024-05-01\"\t\t\n");
  EXPECT_THAT(sheet.others, ElementsAre("b"));
  Parts encrypted = parts;
  encrypted.emplace_back("META-INF/manifest.xml", "<m:file-entry><m:encryption-data/></m:x>");
  EXPECT_THAT(complaint(zipped(encrypted)), HasSubstr("the workbook is encrypted"));
}

TEST(Workbook, EveryKindThatCannotBeReadHasItsMessage) {
  const std::string good = zipped(xlsx("<row><c><v>1</v></c></row>"));
  for (const std::size_t length : {good.size() - 1, good.size() / 2, std::size_t{30}}) {
    EXPECT_THAT(complaint(good.substr(0, length)), HasSubstr("book.xlsx: the workbook is damaged"))
        << length;
  }
  std::string changed = good;  // the content of a part no longer has its sum
  changed[changed.find("_rels/.rels") + 15] ^= 0x55;
  EXPECT_THAT(complaint(changed), HasSubstr("the workbook is damaged"));
  EXPECT_THAT(complaint(zipped(xlsx("<row>"))), HasSubstr("the workbook is damaged"));
  EXPECT_THAT(complaint(zipped(xlsx("<row><c t='s'><v>99</v></c></row>"))),
              HasSubstr("the workbook is damaged (a text is missing)"));
  EXPECT_THAT(complaint(zipped(xlsx("<row><c><v>1</v></c></row>"), "secret")),
              HasSubstr("the workbook is encrypted"));
  EXPECT_THAT(complaint(zipped({{"a.txt", "text"}})),
              HasSubstr("this is not a workbook that recoil reads"));
  EXPECT_THAT(complaint("\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1 "), HasSubstr("the workbook is damaged"));
}

TEST(Workbook, ASmallFileTakesNeitherMemoryNorTime) {
  const std::string one = "<row r='1'><c r='A1'><v>1</v></c></row>";
  std::string wide = "<row>";
  for (int i = 0; i < 20000; ++i) wide += "<c><v>1</v></c>";
  wide += "</row>";
  std::string sparse;  // one cell in the last column, and a million rows
  for (int i = 0; i < 100000; ++i) sparse += "<row><c><v>1</v></c></row>";
  std::string texts;  // a long text, many times
  for (int i = 0; i < 100000; ++i) texts += "<row><c t='s'><v>0</v></c></row>";
  Parts repeated = xlsx(texts);
  repeated[4].second = "<sst><si><t>" + std::string(10000, 'a') + "</t></si></sst>";
  Parts laughs = xlsx("<row><c t='inlineStr'><is><t>&h;</t></is></c></row>");
  std::string entities = "<!DOCTYPE x [<!ENTITY a 'lol'>";
  for (char c = 'b'; c <= 'h'; ++c) {
    entities += fmt::format("<!ENTITY {} '", c);
    for (int i = 0; i < 10; ++i) entities += fmt::format("&{};", static_cast<char>(c - 1));
    entities += "'>";
  }
  laughs[5].second = entities + "]>" + laughs[5].second;
  Parts bomb = xlsx(one);
  bomb[5].second.append(30'000'000, ' ');
  const Parts repeats = {
      {"content.xml",
       "<d:document-content xmlns:d='o'><body><spreadsheet><table><table-row "
       "number-rows-repeated='1000000'><table-cell value-type='float' value='1' "
       "number-columns-repeated='16000'/></table-row></table></spreadsheet></body>"
       "</d:document-content>"}};
  const std::clock_t begin = std::clock();  // of this process
  for (const Parts& parts : {xlsx("<row r='2000000000'><c><v>1</v></c></row>"), xlsx(wide),
                             xlsx("<row r='1'><c "
                                  "r='XFD1'><v>1</v></c></row>" +
                                  sparse),
                             repeated, bomb, repeats}) {
    EXPECT_THAT(complaint(zipped(parts)), HasSubstr("is too large; save the sheet as CSV"));
  }
  EXPECT_EQ(read(laughs).table, "\"&h;\"\n");
  EXPECT_EQ(read(xlsx(one)).table, "1\n");  // its dimension is a lie
  EXPECT_LT(std::clock() - begin, 60 * CLOCKS_PER_SEC);
}

TEST(Workbook, IsImported) {
  const Place place;
  auto request = place.request(
      zipped(xlsx("<row r='1'><c r='A1' t='s'><v>0</v></c><c r='B1' t='s'><v>1</v></c></row>"
                  "<row r='2'><c r='A2'><v>0.812345678901</v></c><c r='B2' s='1'><v>0.7</v></c>"
                  "</row><row r='4'><c r='A4'><v>3</v></c><c r='B4' s='1'><v>0.85</v></c></row>")),
      ImportFormat::csv);
  request.map = {"incident_velocity=V [m/s]"};
  const auto made = recoil::import_points(request);
  ASSERT_EQ(made.dataset.points.size(), 2U);
  EXPECT_EQ(made.dataset.points[0].incident_velocity, 0.812345678901);
  EXPECT_EQ(made.dataset.points[1].restitution, 0.85);
  EXPECT_EQ(made.notes.front().remark, recoil::ImportRemark::sheet_read);
  EXPECT_THAT(made.notes.front().names, ElementsAre("points", "my notes"));
  const auto complaint_of = [&](const std::string& cell) {
    auto wrong = place.request(zipped(xlsx("<row r='1'><c t='s'><v>0</v></c><c t='s'><v>1</v></c>"
                                           "</row><row r='7'><c><v>2</v></c>" +
                                           cell + "</row>")),
                               ImportFormat::csv);
    wrong.map = request.map;
    wrong.into = place.folder() / "wrong";
    return import_folder::complaint(wrong);
  };
  EXPECT_THAT(complaint_of("<c s='4'><v>45413</v></c>"),
              HasSubstr("input.csv:7:3: 'date 2024-05-01' is not a number"));
  EXPECT_THAT(complaint_of("<c><f>A1</f></c>"), HasSubstr("'formula without a value: A1'"));
  auto text = place.request("V,e\n1,0.5\n", ImportFormat::csv);
  text.sheet = "points";
  text.into = place.folder() / "text";
  EXPECT_THAT(import_folder::complaint(text), HasSubstr("this is not a workbook"));
}

}  // namespace
