#pragma once

#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

#include "document/number.hpp"
#include "document/sentence.hpp"
#include "plot/plot.hpp"

/// What people read, before it is known where: the terminal (terminal.hpp) or a page (html.hpp)
/// writes it out.
namespace recoil {

/// A cell without content is shown as a dash.
using Cell = std::variant<std::monostate, Sentence, Number, NumberRange>;

template <class T>
Cell cell_if(const std::optional<T>& content) {
  return content ? Cell(*content) : Cell();
}

Sentence words_of_cell(const Cell& cell);

struct TableColumn {
  Sentence heading;
  std::string unit{};  ///< stands in the heading
  bool words = false;  ///< to be read rather than compared: to the left, and broken into lines
};

/// The first cell of a row is its heading. Columns in which no row says anything are not shown. A
/// table without headings is a list of names and values.
struct Table {
  Sentence caption;
  std::vector<TableColumn> columns;
  std::vector<std::vector<Cell>> rows;
  bool compact = false;  ///< small type, for many rows

  bool empty() const { return rows.empty(); }
  bool has_headings() const;
};

/// `table` as it is shown: every row as long as there are columns, columns that say nothing left
/// out.
Table without_empty_columns(Table table);

/// Names and values, two by two.
Table items(const std::vector<std::pair<Sentence, Cell>>& entries);

struct Paragraph {
  Sentence text;
  bool lead = false;  ///< the answer itself, in larger type
};

struct List {
  std::vector<Sentence> entries;
};

/// One picture, as SVG or as what it shows; a page draws those that are not drawn yet.
struct Figure {
  std::string id;
  std::string title;
  Sentence caption;   ///< what it shows, and what to look for; without one there is no frame
  std::string svg{};  ///< ready to inline; empty: not drawn yet
  plot::Picture picture{};
  std::string csv{};       ///< its data; empty: those of `picture`
  std::string explored{};  ///< JSON for `Document::script`, which makes controls of it
};

Figure figure_of(plot::Picture picture, Sentence caption);

/// Pictures side by side. A terminal has none.
struct Figures {
  std::vector<Figure> figures;
};

/// Something to know before reading on: where the points come from.
struct Banner {
  std::string label;  ///< one word, also the name of its look
  Sentence text;
};

/// One line behind a sign that can be told from others without its colour.
struct Remark {
  std::string look;  ///< the name of its look
  std::string sign;
  Sentence text;
};

struct Block;

/// A vector of blocks that a section can begin without: what makes and destroys it stands where a
/// block is complete.
struct Blocks : std::vector<Block> {
  Blocks();
  Blocks(std::vector<Block> blocks);
  Blocks(std::initializer_list<Block> blocks);
  Blocks(const Blocks&);
  Blocks(Blocks&&) noexcept;
  Blocks& operator=(const Blocks&);
  Blocks& operator=(Blocks&&) noexcept;
  ~Blocks();
};

/// How urgently a reader needs a section. The terminal prints the answer alone unless asked for
/// more; a page shows the answer and folds the details.
enum class Importance { answer, detail };

struct Section {
  std::string id;
  Sentence title;     ///< may be empty: a section without a heading
  Sentence remark{};  ///< behind the title
  Blocks blocks{};
  std::string address{};  ///< target of the title's link
  Importance importance = Importance::answer;
};

struct Block : std::variant<Paragraph, List, Table, Figures, Banner, Remark, Section> {
  using variant::variant;
  const variant& content() const { return *this; }
  variant& content() { return *this; }
};

/// Nothing to be shown.
bool empty(const Block& block);
bool empty(const Section& section);

/// Every section as a block of its own; `more` behind `blocks`.
void append(std::vector<Block>& blocks, std::vector<Block> more);

struct Document {
  std::string title;  ///< of the window
  Sentence heading;   ///< of the page
  Sentence subtitle{};
  std::vector<Block> foreword{};  ///< above the contents
  std::vector<Section> sections{};
  std::string foot{};    ///< who made it
  bool cards = false;    ///< the sections stand side by side, without a list of contents
  std::string name{};    ///< what the files that a reader saves from the page begin with
  std::string script{};  ///< JavaScript of the page, beside that which saves pictures
};

/// Every figure of a section, those in subsections too.
std::vector<const Figure*> figures_of(const Section& section);

}  // namespace recoil
