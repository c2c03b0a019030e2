#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "document/number.hpp"
#include "document/sentence.hpp"
#include "plot/plot.hpp"

/// The content of an output, independent of its format. terminal.hpp and html.hpp write it.
namespace recoil {

/// The content of a table cell. std::monostate is shown as a dash.
using Cell = std::variant<std::monostate, Sentence, Number, NumberRange>;

/// The content, or an empty cell for nullopt.
template <class T>
Cell cell_if(const std::optional<T>& content) {
  return content ? Cell(*content) : Cell();
}

/// The text of a cell; "–" for an empty one.
Sentence words_of_cell(const Cell& cell);

struct TableColumn {
  Sentence heading;
  std::string unit{};  ///< shown in brackets after the heading
  bool words = false;  ///< contains text: aligned left and wrapped
};

/// The first cell of a row is its heading. Other columns are not shown if they are empty in all
/// rows. A two-column table without headings is a list of names and values.
struct Table {
  Sentence caption;
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows;
  bool compact = false;  ///< set in small type, for tables with many rows

  bool empty() const { return rows.empty(); }
  bool has_headings() const;
};

/// `table` without its empty columns. Short rows are filled with empty cells.
Table without_empty_columns(Table table);

/// A list of names and values. Entries with an empty value are omitted.
Table items(const std::vector<std::pair<Sentence, Cell>>& entries);

struct Paragraph {
  Sentence text;
  bool lead = false;  ///< the main result, set in larger type
};

struct List {
  std::vector<Sentence> entries;
};

/// One picture with its caption. A page draws `picture` unless `svg` is given.
struct Figure {
  std::string id;
  std::string title;
  Sentence caption;   ///< a figure without a caption has no frame
  std::string svg{};  ///< the SVG element; empty: drawn from `picture`
  plot::Picture picture{};
  std::string csv{};       ///< the plotted data; empty: taken from `picture`
  std::string explored{};  ///< JSON from which `Document::script` makes interactive controls
};

/// A figure with the name and title of `picture`.
Figure figure_of(plot::Picture picture, Sentence caption);

/// Pictures side by side. The terminal omits them.
struct Figures {
  std::vector<Figure> figures;
};

/// A highlighted notice, such as the provenance of the points or a warning.
struct Banner {
  std::string label;  ///< one word, also its class in HTML
  Sentence text;
};

/// One line after a sign, so that its meaning does not depend on colour.
struct Remark {
  std::string look;  ///< its class in HTML
  std::string sign;
  Sentence text;
};

/// A formula between paragraphs.
struct Formula {
  std::string mathml;  ///< the content of a math element; empty: no formula
  std::string text;    ///< the same in one line of text
};

struct Block : std::variant<Paragraph, List, Table, Figures, Banner, Remark, Formula> {
  using variant::variant;
  const variant& content() const { return *this; }
  variant& content() { return *this; }
};
using Blocks = std::vector<Block>;

/// Whether a section belongs to the answer or to the details. Without --verbose, the terminal
/// prints only the answer; a page folds the details.
enum class Importance { answer, detail };

struct Section {
  std::string id;
  Sentence title;     ///< empty: the section has no heading
  Sentence remark{};  ///< printed after the title
  Blocks blocks{};
  std::string address{};  ///< target of the title's link; empty: no link
  Importance importance = Importance::answer;
};

/// True if a block, or every block of a section, has no content.
bool empty(const Block& block);
bool empty(const Section& section);

/// Appends `more` to `blocks`.
void append(Blocks& blocks, Blocks more);

struct Document {
  std::string title;  ///< title of the browser window
  Sentence heading;   ///< heading of the page
  Sentence subtitle{};
  Blocks foreword{};  ///< above the list of contents
  std::vector<Section> sections{};
  std::string foot{};    ///< footer: program and version
  bool cards = false;    ///< sections are cards side by side, without a list of contents
  std::string name{};    ///< prefix of the files that a reader saves from the page
  std::string script{};  ///< JavaScript of the page, in addition to `save_script`
};

std::vector<const Figure*> figures_of(const Section& section);

}  // namespace recoil
