#include "document/html.hpp"

namespace recoil {

std::string_view style_sheet() {
  return R"css(:root {
  --picture: #ffffff; --paper: #ffffff; --ground: #f6f7f8; --ink: #1d2329; --quiet: #59636e; --line: #d9dee3;
  --accent: #0b5c8f; --note: #fff6e0; --note-line: #c98a00; --card: #ffffff;
  --good: #00684c; --doubt: #a04600;
}
@media (prefers-color-scheme: dark) {
  :root {
    --picture: #1d2228; --paper: #171b20; --ground: #101317; --ink: #e6e9ec; --quiet: #a3adb8; --line: #323a43;
    --accent: #7cc4f0; --note: #2d2613; --note-line: #d9a53a; --card: #1d2228;
    --good: #5cc9a4; --doubt: #f0a56b;
  }
  .picture svg { filter: invert(.9) hue-rotate(180deg); }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
  margin: 0 auto; padding: 1.5rem 1rem 3rem; max-width: 68rem; background: var(--ground);
  color: var(--ink); overflow-wrap: anywhere;
  font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", Helvetica, Arial, sans-serif;
}
a { color: var(--accent); }
.skip { position: absolute; left: -100rem; }
.skip:focus { position: static; }
h1 { font-size: 1.75rem; line-height: 1.25; margin: 0 0 .25rem; letter-spacing: -.01em; }
h2 { font-size: 1.25rem; line-height: 1.3; margin: 2.5rem 0 .75rem; padding-top: .75rem;
  border-top: 1px solid var(--line); }
p, ul { max-width: 48rem; }
.formula { overflow-x: auto; }
.subtitle { color: var(--quiet); margin: 0 0 1rem; }
.summary { font-size: 1.08rem; }
sub { line-height: 0; }
code { font-family: "DejaVu Sans Mono", ui-monospace, monospace; font-size: .86em; }
nav { font-size: .92rem; line-height: 1.8; margin: .75rem 0; }
nav a { margin-right: 1rem; display: inline-block; }
.banner { display: flex; flex-wrap: wrap; gap: .25rem .9rem; align-items: baseline;
  border-left: .3rem solid var(--accent); background: var(--card); padding: .7rem 1rem;
  margin: 1rem 0; }
.banner span { flex: 1 1 22rem; }
.banner strong { text-transform: uppercase; letter-spacing: .06em; font-size: .85rem; }
.banner.reconstruction, .banner.synthetic, .banner.warning {
  background: var(--note); border-left-color: var(--note-line); }
.figures { display: grid; gap: 1rem;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); }
.figures.single { max-width: 33.5rem; }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: .4rem;
  overflow: hidden; break-inside: avoid; }
.picture { background: var(--picture); padding: .4rem; }
.picture svg { display: block; width: 100%; height: auto; }
figcaption { padding: .5rem .9rem .8rem; font-size: .88rem; line-height: 1.45;
  color: var(--quiet); border-top: 1px solid var(--line); }
.save { margin: 0; padding: .3rem .9rem; font-size: .82rem; color: var(--quiet); max-width: none; }
.save a { margin-right: .5rem; }
.explore { padding: 0 .9rem .6rem; font-size: .88rem; }
.explore .control { display: grid; grid-template-columns: 9.5rem 1fr 7rem;
  gap: .1rem .7rem; align-items: center; margin: .3rem 0; }
.explore input { width: 100%; min-width: 0; margin: 0; font: inherit; color: var(--ink);
  accent-color: var(--accent); }
.explore input[type=number] { background: var(--paper); border: 1px solid var(--line);
  border-radius: .25rem; padding: .15rem .35rem; }
.explore button { font: inherit; margin: .3rem 0 0; }
.explored-result { margin: .5rem 0 0; }
.wide { width: fit-content; max-width: 100%; overflow-x: auto; margin: .75rem 0 1.25rem; border: 1px solid var(--line);
  border-radius: .4rem; background: var(--card); }
table { border-collapse: collapse; width: 100%; font-size: .93rem;
  font-variant-numeric: tabular-nums; overflow-wrap: normal; }
caption { text-align: left; padding: .6rem .8rem; color: var(--quiet); }
th, td { padding: .42rem .8rem; text-align: right; border-top: 1px solid var(--line);
  vertical-align: top; white-space: nowrap; }
thead th { border-top: 0; color: var(--quiet); font-weight: 600; }
tbody th { font-weight: 600; }
th:first-child { text-align: left; }
td.words, th.words { text-align: left; }
td .label { display: none; }
td.words, tbody th { white-space: normal; min-width: 5rem; }
td.prose { white-space: normal; min-width: 16rem; }
table.compact { font-size: .8rem; }
table.compact th, table.compact td { padding: .18rem .7rem; font-weight: 400; }
.answer table.compact th, .answer table.compact td { padding: .18rem .35rem; }
.answer table.compact th { white-space: normal; }
.answer table.compact td.words { white-space: normal; min-width: 4rem; }
details summary { cursor: pointer; color: var(--accent); margin: .5rem 0; }
details.section { border-top: 1px solid var(--line); margin-top: 1rem; padding-top: .25rem; }
details.section > summary h2 { display: inline; border: 0; margin: 0; padding: 0; color: inherit; }
.answer { display: grid; gap: 0 1.5rem;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); }
.answer > section { grid-column: 1 / -1; min-width: 0; }
.answer > section > h2 { border: 0; margin: .5rem 0; padding: 0; font-size: 1.05rem; }
.answer > #picture:has(.single) { grid-column: auto; grid-row: span 3; }
.answer > #capture, .answer > #parameters, .answer > #calibrations { grid-column: auto; }
.answer > #picture { margin-bottom: .75rem; }
.answer .wide { margin: .25rem 0 .75rem; }
footer { margin-top: 3rem; padding-top: .75rem; border-top: 1px solid var(--line);
  color: var(--quiet); font-size: .85rem; }
.cards { display: grid; gap: 1.25rem; margin-top: 1.5rem;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 22rem), 1fr)); }
.card { background: var(--card); border: 1px solid var(--line); border-radius: .5rem;
  overflow: hidden; display: flex; flex-direction: column; break-inside: avoid; }
.card h2 { border: 0; margin: 0; padding: .9rem 1rem 0; font-size: 1.12rem; }
.card .subtitle { padding: 0 1rem; margin: .15rem 0 .5rem; font-size: .9rem; }
.card .banner { margin: 0; font-size: .86rem; line-height: 1.4; }
.card .verdict { margin: 0; padding: .5rem 1rem; font-size: .9rem; line-height: 1.4;
  border-top: 1px solid var(--line); }
.verdict .mark { display: inline-block; min-width: 1.4em; font-weight: 700; text-align: center;
  border: 1px solid currentColor; border-radius: .3rem; }
.verdict.fits .mark, .verdict.fits_with_moved_constants .mark { color: var(--good); }
.verdict.fits_within_law_error .mark { color: var(--accent); }
.verdict.does_not_fit .mark, .verdict.untested .mark { color: var(--doubt); }
.card .wide { width: 100%; border: 0; margin: 0; border-radius: 0; }
.card table { font-size: .86rem; }
.card tbody th, .card td:last-child { white-space: normal; }
.card th, .card td { padding: .35rem .6rem; }
.card > p:not(.subtitle):not(.verdict) { margin: 0; padding: 0 1rem .5rem; font-size: .86rem;
  color: var(--quiet); }
@media (max-width: 34rem) {
  body { padding: 1rem .75rem 2rem; }
  h1 { font-size: 1.4rem; }
  th, td { padding: .38rem .6rem; }
  th, td, tbody th, table.compact td { white-space: normal; overflow-wrap: anywhere; }
  thead th, td:not(.words) { overflow-wrap: break-word; }
  td.prose { min-width: 0; }
  .stack thead { display: none; }
  .stack tr { display: block; padding: .3rem 0; border-top: 1px solid var(--line); }
  .stack th, .stack td { display: block; border: 0; padding: .12rem .6rem; }
  .stack td { text-align: right; overflow: hidden; }
  .stack td .label { display: inline; float: left; margin-right: 1rem; color: var(--quiet); }
  .stack td:empty { display: none; }
  .explore .control { grid-template-columns: 1fr 7.5rem; }
  .explore .control span { grid-column: 1 / -1; }
}
@media print {
  :root { --picture: #fff; --paper: #fff; --ground: #fff; --ink: #000; --quiet: #333; --line: #bbb;
    --accent: #000; --note: #fff; --note-line: #000; --card: #fff; --good: #000;
    --doubt: #000; }
  @page { margin: 15mm; }
  body { max-width: none; padding: 0; font-size: 9.5pt; }
  nav, .skip, .save, .explore, .explored { display: none; }
  h1 { font-size: 17pt; }
  h2 { font-size: 12.5pt; margin-top: 1.4rem; break-after: avoid; }
  .summary { font-size: 10.5pt; }
  .figures { grid-template-columns: 1fr 1fr; gap: .5rem; }
  .figures.single { max-width: none; }
  .cards { grid-template-columns: 1fr 1fr; }
  figcaption { font-size: 8pt; }
  .picture svg { filter: none; }
  .wide { overflow: visible; break-inside: avoid; }
  .wide:has(tr:nth-child(16)) { break-inside: auto; }
  table { font-size: 8pt; overflow-wrap: anywhere; }
  th, td { padding: .15rem .4rem; white-space: normal; }
  td.prose { min-width: 0; }
  table.compact th, table.compact td { padding: .08rem .4rem; }
  tr { break-inside: avoid; }
  thead { display: table-header-group; }
  a { color: inherit; text-decoration: none; }
  a[href^="http"]::after, a[href$=".html"]::after { content: " (" attr(href) ")"; }
}
)css";
}

}  // namespace recoil
