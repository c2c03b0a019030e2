#include "experiment/workbook.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>

#include "core/error.hpp"
#include "data/text.hpp"
#include "experiment/excel97.hpp"
#include "experiment/workbook_cells.hpp"

namespace recoil {
namespace {

constexpr std::size_t largest_part = 24UL << 20;  // unpacked; as a tree up to 25 times as much

constexpr std::string_view zip_mark = "PK\x03\x04";
constexpr std::string_view compound_mark = "\xD0\xCF\x11\xE0";  // .xls, and .xlsx with a password

using Xml = pugi::xml_node;

/// True if the name of a node without its prefix is `name`: "x:sheet" is a "sheet".
bool is(const Xml& node, std::string_view name) {
  const std::string_view full = node.name();
  return full.substr(full.rfind(':') + 1) == name;
}

Xml child(const Xml& node, std::string_view name) {
  return node.find_child([&](const Xml& one) { return is(one, name); });
}

std::string attribute(const Xml& node, std::string_view name) {
  const auto found = node.find_attribute([&](const pugi::xml_attribute& one) {
    const std::string_view full = one.name();
    return full.substr(full.rfind(':') + 1) == name;
  });
  return found.value();
}

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, failed] = std::from_chars(text.data(), end, value);
  return failed == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

/// A workbook, which is a zip archive of XML files ("parts"), and the errors about it.
class Archive : public WorkbookErrors {
 public:
  Archive(std::string_view bytes, const std::string& file) : WorkbookErrors(file) {
    if (bytes.size() > largest_workbook) fail_too_large();
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source != nullptr) zip_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (zip_) return;
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    zip_source_free(source);
    fail_damaged(why);
  }

  bool has(const std::string& part) const {
    return zip_name_locate(zip_.get(), part.c_str(), 0) >= 0;
  }

  std::string text(const std::string& part) const {
    zip_stat_t status;
    if (zip_stat(zip_.get(), part.c_str(), 0, &status) != 0)
      fail_damaged("it lacks " + quote(part));
    if (status.encryption_method != ZIP_EM_NONE) fail_encrypted();
    if (status.size > largest_part) fail_too_large();
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> opened(
        zip_fopen_index(zip_.get(), status.index, 0), &zip_fclose);
    std::string content(status.size, '\0');
    const auto size = static_cast<zip_int64_t>(content.size());
    char more = 0;  // at the end, where nothing is left, zip_fread checks the sum
    if (!opened || zip_fread(opened.get(), content.data(), status.size) != size ||
        zip_fread(opened.get(), &more, 1) != 0) {
      fail_damaged(quote(part) + " cannot be unpacked");
    }
    return content;
  }

  pugi::xml_document xml(const std::string& part) const {
    const std::string content = text(part);
    pugi::xml_document document;
    const pugi::xml_parse_result read = document.load_buffer(content.data(), content.size());
    if (!read) fail_damaged(fmt::format("{}: {}", quote(part), read.description()));
    return document;
  }

 private:
  struct Discard {
    void operator()(zip_t* zip) const { zip_discard(zip); }
  };
  std::unique_ptr<zip_t, Discard> zip_;
};

/// A sheet of a workbook, and where it is.
struct Listed : ListedSheet {
  std::string part;  ///< .xlsx
  Xml table;         ///< .ods
};

/// Takes the sheet of this name out of `all`.
Listed take_sheet(std::vector<Listed>& all, const std::string& name, const WorkbookErrors& errors) {
  const std::size_t at = chosen_sheet({all.begin(), all.end()}, name, errors);
  Listed taken = all[at];
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(at));
  return taken;
}

// ---- Office Open XML (.xlsx) ----

/// The parts that a part refers to, by the last word of their type ("worksheet") and by id.
struct Relations {
  std::map<std::string, std::string> by_type, by_id;
};

Relations relations_of(const Archive& archive, const std::filesystem::path& part) {
  const std::filesystem::path folder = "/" / part.parent_path();
  const std::string file = folder / "_rels" / (part.filename().string() + ".rels");
  const pugi::xml_document document = archive.xml(file.substr(1));
  Relations relations;
  for (const Xml& node : child(document, "Relationships").children()) {
    const std::string type = attribute(node, "Type");
    const std::string target = (folder / attribute(node, "Target")).lexically_normal();
    relations.by_type[type.substr(type.rfind('/') + 1)] = target.substr(1);
    if (type.ends_with("/worksheet")) relations.by_id[attribute(node, "Id")] = target.substr(1);
  }
  return relations;
}

/// A text of plain or formatted pieces, without the phonetic ones.
std::string rich_text(const Xml& node) {
  std::string text;
  for (const Xml& piece : node.children()) {
    if (is(piece, "t")) text += piece.text().get();
    if (is(piece, "r")) text += child(piece, "t").text().get();
  }
  return text;
}

/// Which cell styles show dates.
std::vector<bool> date_styles(const pugi::xml_document& document) {
  const Xml sheet = child(document, "styleSheet");
  std::map<std::string, bool> stated;
  for (const Xml& format : child(sheet, "numFmts").children()) {
    stated[attribute(format, "numFmtId")] = shows_date(attribute(format, "formatCode"));
  }
  std::vector<bool> styles;
  for (const Xml& style : child(sheet, "cellXfs").children()) {
    const std::string id = attribute(style, "numFmtId");
    styles.push_back(stated.contains(id) ? stated[id] : shows_date(whole_number(id).value_or(0)));
  }
  return styles;
}

/// The column of "AB12", from 1.
std::optional<std::size_t> column_of(std::string_view reference) {
  std::size_t column = 0;
  for (const char c : reference) {
    if (c < 'A' || c > 'Z' || column > sheet_columns) break;
    column = 26 * column + static_cast<std::size_t>(c - 'A' + 1);
  }
  return column > 0 ? std::optional(column) : std::nullopt;
}

class XlsxReader {
 public:
  XlsxReader(const Archive& archive, char decimal) : archive_(archive), cells_(archive, decimal) {}

  /// @param sheets gets the sheets that are not read
  Sheet read(const std::string& name, std::vector<Listed>& sheets) {
    const std::string workbook = relations_of(archive_, "").by_type["officeDocument"];
    if (!workbook.ends_with(".xml")) archive_.fail_other_kind();
    const pugi::xml_document document = archive_.xml(workbook);
    const Xml root = child(document, "workbook");
    if (!root) archive_.fail_other_kind();
    Relations parts = relations_of(archive_, workbook);
    for (const Xml& sheet : child(root, "sheets").children()) {
      const std::string part = parts.by_id[attribute(sheet, "id")];
      const bool hidden =
          !attribute(sheet, "state").empty() && attribute(sheet, "state") != "visible";
      if (!part.empty()) sheets.push_back({{attribute(sheet, "name"), hidden}, part, Xml()});
    }
    const Listed chosen = take_sheet(sheets, name, archive_);
    const std::string since = attribute(child(root, "workbookPr"), "date1904");
    epoch_ = first_day(since == "1" || since == "true");
    if (parts.by_type.contains("styles")) {
      date_styles_ = date_styles(archive_.xml(parts.by_type["styles"]));
    }
    if (parts.by_type.contains("sharedStrings")) {
      const pugi::xml_document strings = archive_.xml(parts.by_type["sharedStrings"]);
      for (const Xml& item : child(strings, "sst").children()) texts_.push_back(rich_text(item));
    }
    read_cells(archive_.xml(chosen.part));
    return {cells_.table(), chosen.name, {}};
  }

 private:
  void read_cells(const pugi::xml_document& document) {
    std::size_t row = 0;
    for (const Xml& line : child(child(document, "worksheet"), "sheetData").children()) {
      row = whole_number(attribute(line, "r")).value_or(row + 1);
      if (row == 0) archive_.fail_damaged("a row 0");
      std::size_t column = 0;
      for (const Xml& cell : line.children()) {
        column = column_of(attribute(cell, "r")).value_or(column + 1);
        put(row - 1, column - 1, cell);
      }
    }
  }

  void put(std::size_t row, std::size_t column, const Xml& cell) {
    const std::string type = attribute(cell, "t");
    const std::string value = child(cell, "v").text().get();
    const std::string formula = child(cell, "f").text().get();
    if (type == "inlineStr") {
      cells_.put_text(row, column, rich_text(child(cell, "is")));
    } else if (value.empty()) {
      if (!formula.empty()) cells_.put_text(row, column, "formula without a value: " + formula);
    } else if (type == "s") {
      const auto index = whole_number(value);
      if (!index || *index >= texts_.size()) archive_.fail_damaged("a text is missing");
      cells_.put_text(row, column, texts_[*index]);
    } else if (type == "str" || type == "e" || type == "d") {
      cells_.put_text(row, column, type == "d" ? "date " + value : value);
    } else {  // a number or a boolean
      const std::size_t style = whole_number(attribute(cell, "s")).value_or(0);
      const auto number = parse_number(value);
      if (number && type != "b" && style < date_styles_.size() && date_styles_[style]) {
        cells_.put_text(row, column, date_text(*number, epoch_));
      } else {
        cells_.put_number(row, column, value);
      }
    }
  }

  const Archive& archive_;
  Cells cells_;
  std::vector<std::string> texts_;
  std::vector<bool> date_styles_;
  std::chrono::sys_days epoch_;
};

// ---- OpenDocument (.ods) ----

void put_ods(Cells& cells, std::size_t row, std::size_t column, const Xml& cell) {
  const std::string type = attribute(cell, "value-type");
  if (type == "float" || type == "percentage" || type == "currency") {
    cells.put_number(row, column, attribute(cell, "value"));
  } else if (type == "boolean") {
    cells.put_number(row, column, attribute(cell, "boolean-value") == "true" ? "1" : "0");
  } else if (type == "date" || type == "time") {
    cells.put_text(row, column, fmt::format("{} {}", type, attribute(cell, type + "-value")));
  } else if (type == "string") {
    std::string text;
    for (const Xml& paragraph : cell.children()) {
      if (is(paragraph, "p"))
        text += pugi::xpath_query("string(.)").evaluate_string(paragraph) + ' ';
    }
    cells.put_text(row, column, text);
  }
}

/// The times that a row or a cell is repeated.
std::size_t repeats(const Xml& node, const char* what) {
  return whole_number(attribute(node, fmt::format("number-{}-repeated", what))).value_or(1);
}

Sheet read_ods(const Archive& archive, char decimal, const std::string& name,
               std::vector<Listed>& sheets) {
  const std::string manifest = "META-INF/manifest.xml";
  if (archive.has(manifest) &&
      archive.text(manifest).find("encryption-data") != std::string::npos) {
    archive.fail_encrypted();
  }
  const pugi::xml_document document = archive.xml("content.xml");
  const Xml root = child(document, "document-content");
  std::map<std::string, bool> hidden;  // by style
  for (const Xml& style : child(root, "automatic-styles").children()) {
    hidden[attribute(style, "name")] =
        attribute(child(style, "table-properties"), "display") == "false";
  }
  for (const Xml& node : child(child(root, "body"), "spreadsheet").children()) {
    if (!is(node, "table")) continue;
    sheets.push_back({{attribute(node, "name"), hidden[attribute(node, "style-name")]}, "", node});
  }
  const Listed chosen = take_sheet(sheets, name, archive);
  Cells cells(archive, decimal);
  std::size_t row = 0;
  for (const auto& found : chosen.table.select_nodes(".//*[local-name() = 'table-row']")) {
    const Xml line = found.node();
    const std::size_t rows = repeats(line, "rows");
    std::size_t column = 0;
    for (const Xml& cell : line.children()) {
      const std::size_t columns = repeats(cell, "columns");
      for (std::size_t k = 0; k < rows * columns && !attribute(cell, "value-type").empty(); ++k) {
        put_ods(cells, row + k / columns, column + k % columns, cell);
      }
      column += columns;
    }
    row += rows;
  }
  return {cells.table(), chosen.name, {}};
}

}  // namespace

bool is_workbook(std::string_view bytes) {
  return bytes.starts_with(zip_mark) || bytes.starts_with(compound_mark);
}

Sheet read_sheet(std::string_view bytes, const std::string& file, const std::string& name,
                 char decimal) {
  if (bytes.starts_with(compound_mark)) return read_excel97(bytes, file, name, decimal);
  const Archive archive(bytes, file);
  const bool ods = archive.has("content.xml");
  if (!ods && !archive.has("_rels/.rels")) archive.fail_other_kind();
  std::vector<Listed> others;
  Sheet sheet = ods ? read_ods(archive, decimal, name, others)
                    : XlsxReader(archive, decimal).read(name, others);
  for (const Listed& other : others) sheet.others.push_back(other.name);
  return sheet;
}

}  // namespace recoil
