"""The looks and the script of the report page."""

from __future__ import annotations

STYLE = """
:root { --ink: #1d2330; --soft: #5d6880; --line: #e4e7ec; --paper: #fff; --back: #f6f7f9; --good: #177245;
  --good-back: #e8f5ee; --bad: #b42318; --bad-back: #fdeceb; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--back); color: var(--ink); font: 14px/1.5 system-ui, -apple-system, "Segoe UI",
  Roboto, "Helvetica Neue", Arial, sans-serif; }
header, footer { padding: 28px 24px 4px; max-width: 1500px; position: sticky; left: 0; }
footer { padding: 20px 24px 40px; color: var(--soft); font-size: 12.5px; }
h1 { font-size: 26px; line-height: 1.25; font-weight: 650; letter-spacing: -0.01em; margin: 0 0 4px; }
h2 { font-size: 13px; text-transform: uppercase; letter-spacing: 0.06em; color: var(--soft); font-weight: 600;
  margin: 26px 0 8px; }
p { margin: 0 0 8px; color: var(--soft); max-width: 900px; }
table { border-collapse: collapse; background: var(--paper); }
.numbers { border: 1px solid var(--line); border-radius: 8px; overflow: auto; display: inline-block;
  max-width: 100%; margin: 0 14px 14px 0; vertical-align: top; }
.numbers td, .numbers th { padding: 5px 12px; text-align: right; font-variant-numeric: tabular-nums;
  white-space: nowrap; border-bottom: 1px solid var(--line); font-size: 13px; }
.numbers tr:last-child td { border-bottom: 0; }
.numbers th { font-weight: 600; color: var(--soft); }
.numbers :is(td, th):first-child { text-align: left; }
.numbers small { display: block; color: var(--soft); font-size: 11px; line-height: 1.2; }
nav { display: flex; flex-wrap: wrap; gap: 10px 22px; align-items: center; padding: 12px 24px; position: sticky;
  left: 0; max-width: 100vw; font-size: 13.5px; }
nav label { white-space: nowrap; }
nav fieldset { border: 0; padding: 0; margin: 0; display: flex; flex-wrap: wrap; gap: 2px 12px; }
select { font: inherit; padding: 3px 6px; border: 1px solid #c8ced9; border-radius: 6px; background: var(--paper); }
.cases { border-top: 1px solid var(--line); min-width: 100%; }
.cases th { position: sticky; top: 0; z-index: 2; background: var(--paper); text-align: left; font-size: 13px;
  font-weight: 600; padding: 9px 8px; box-shadow: inset 0 -1px var(--line); white-space: nowrap; }
.cases td { padding: 10px 8px 14px; border-bottom: 1px solid var(--line); vertical-align: top; width: 180px;
  min-width: 180px; max-width: 180px; font-size: 12px; line-height: 1.4; overflow-wrap: anywhere; }
.cases td:first-child, .cases th:first-child { position: sticky; left: 0; background: var(--paper); z-index: 1;
  width: 250px; min-width: 250px; max-width: 250px; padding-left: 24px; }
.cases th:first-child { z-index: 3; }
.cases b { font-size: 13px; }
.request { margin: 3px 0 6px; color: var(--ink); font-size: 13.5px; }
.cases img { display: block; width: 160px; height: 160px; object-fit: contain; border: 1px solid var(--line);
  border-radius: 6px; background: #fff; cursor: zoom-in; margin-bottom: 6px; }
.none { width: 160px; height: 160px; border: 1px dashed #c8ced9; border-radius: 6px; margin-bottom: 6px;
  display: grid; place-items: center; color: var(--soft); }
.tag { display: inline-block; padding: 0 7px; border-radius: 99px; font-weight: 600; font-size: 11.5px;
  margin: 0 4px 2px 0; }
.tag.good { background: var(--good-back); color: var(--good); }
.tag.bad { background: var(--bad-back); color: var(--bad); }
.facts { color: var(--soft); font-variant-numeric: tabular-nums; }
ul { margin: 3px 0 0; padding-left: 14px; max-height: 150px; overflow: auto; }
li::marker { color: var(--bad); }
details { margin-top: 4px; }
summary { cursor: pointer; color: var(--soft); }
pre { margin: 4px 0 0; font: 11px/1.45 ui-monospace, SFMono-Regular, Menlo, Consolas, monospace;
  white-space: pre-wrap; }
dialog { border: 0; border-radius: 12px; padding: 18px 20px 20px; max-width: 96vw; color: var(--ink); }
dialog::backdrop { background: rgb(20 24 34 / 60%); }
dialog .strip { display: flex; gap: 16px; }
dialog figure { margin: 0; color: var(--soft); }
dialog img { width: min(30vw, 440px); height: auto; border: 1px solid var(--line); border-radius: 6px; }
@media print { nav { display: none; } .cases th { position: static; } }
"""

SCRIPT = """
const table = document.querySelector(".cases"), body = table.tBodies[0], rows = [...body.rows];
const by = name => document.querySelector(`[name=${name}]`);
const cell = row => row.querySelector(`td[data-method="${by("judge").value}"]`);
const number = (row, name) => Number(cell(row).dataset[name]);
const keys = {
  worst: row => -number(row, "bad"), best: row => number(row, "bad"), cd: row => -number(row, "cd"),
  slow: row => -number(row, "seconds"), tokens: row => -number(row, "tokens"),
  apart: row => { const all = [...row.querySelectorAll("td[data-method]:not([hidden])")];
    const right = all.filter(c => c.dataset.right == "1").length; return -Math.min(right, all.length - right); },
};
function arrange() {
  const sort = by("sort").value, only = by("only").value;
  rows.sort((a, b) => (sort in keys ? keys[sort](a) - keys[sort](b) : 0) || a.id.localeCompare(b.id));
  let shown = 0;
  for (const row of rows) {
    row.hidden = only != "all" && (cell(row).dataset.right == "1") != (only == "right");
    shown += !row.hidden;
    body.append(row);
  }
  document.querySelector("#shown").textContent = `${shown} of ${rows.length} cases`;
}
function columns() {
  for (const box of document.querySelectorAll("nav input"))
    for (const part of table.querySelectorAll(`[data-method="${box.value}"]`)) part.hidden = !box.checked;
  arrange();
}
document.querySelectorAll("nav select").forEach(s => s.addEventListener("change", arrange));
document.querySelectorAll("nav input").forEach(s => s.addEventListener("change", columns));
const dialog = document.querySelector("dialog");
body.addEventListener("click", event => {
  if (event.target.tagName != "IMG") return;
  const images = [...event.target.closest("tr").querySelectorAll("img")];
  const shown = [...new Set([images[0], event.target, images[1]])];
  dialog.querySelector("p").textContent = event.target.closest("tr").querySelector(".request").textContent;
  dialog.querySelector(".strip").replaceChildren(...shown.map(image => {
    const figure = document.createElement("figure"), copy = new Image();
    copy.src = image.src;
    figure.append(copy, document.createElement("br"), image.alt);
    return figure;
  }));
  dialog.showModal();
});
dialog.addEventListener("click", () => dialog.close());
columns();
"""
