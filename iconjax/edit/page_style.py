"""The looks and the few lines of script of the trace page."""

from __future__ import annotations

STYLE = """
:root { --ink: #1d2330; --soft: #667085; --line: #e4e7ec; --paper: #ffffff; --back: #f6f7f9; --good: #177245;
  --good-back: #e8f5ee; --bad: #b42318; --bad-back: #fdeceb; --mark: #3550b5; --mark-back: #edf0fb; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--back); color: var(--ink); font: 15px/1.55 system-ui,
  -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1200px; margin: 0 auto; padding: 40px 32px 64px; }
header h1 { font-size: 30px; line-height: 1.25; letter-spacing: -0.015em; font-weight: 650; margin: 0 0 10px;
  overflow-wrap: anywhere; }
header p { margin: 0; color: var(--soft); }
h2 { font-size: 13px; text-transform: uppercase; letter-spacing: 0.06em; color: var(--soft); font-weight: 600;
  margin: 44px 0 12px; }
.pictures { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 20px; margin-top: 28px; }
figure { margin: 0; background: var(--paper); border: 1px solid var(--line); border-radius: 12px;
  padding: 16px; }
figure img { display: block; width: 100%; height: auto; max-height: 420px; object-fit: contain; }
figcaption { margin-top: 10px; color: var(--soft); font-size: 13px; }
.columns { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 0 32px; }
.card { background: var(--paper); border: 1px solid var(--line); border-radius: 12px; overflow: auto; }
.card.text { padding: 14px 18px; white-space: pre-line; overflow-wrap: anywhere; }
table { border-collapse: collapse; width: 100%; font-size: 14px; }
th { text-align: left; font-weight: 600; color: var(--soft); font-size: 12.5px; padding: 10px 14px;
  border-bottom: 1px solid var(--line); white-space: nowrap; background: var(--paper); }
td { padding: 9px 14px; border-bottom: 1px solid var(--line); vertical-align: top; overflow-wrap: anywhere; }
tr:last-child td { border-bottom: 0; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
code { font: 13px/1.5 ui-monospace, SFMono-Regular, Menlo, Consolas, "Liberation Mono", monospace; }
.tag { display: inline-block; padding: 1px 8px; border-radius: 99px; font-size: 12.5px; font-weight: 500;
  background: #eff1f4; color: #475467; margin: 0 4px 3px 0; white-space: nowrap; }
.tag.good { background: var(--good-back); color: var(--good); }
.tag.bad { background: var(--bad-back); color: var(--bad); }
.tag.mark { background: var(--mark-back); color: var(--mark); }
.swatch { display: inline-block; width: 12px; height: 12px; border-radius: 3px; margin-right: 8px; }
.quiet { color: var(--soft); }
.search th button { all: unset; cursor: pointer; }
.search th button:hover, .search th button:focus-visible { color: var(--ink); text-decoration: underline; }
.search th button::after { content: " \\2195"; opacity: 0.35; }
.search th[aria-sort=ascending] button::after { content: " \\2191"; opacity: 1; }
.search th[aria-sort=descending] button::after { content: " \\2193"; opacity: 1; }
.search tr.kept td { background: #f4faf6; }
.search td { font-size: 13px; min-width: 64px; }
.search td.wide { min-width: 190px; }
.search th.number.wide { text-align: left; }
.legend { margin: 0 0 12px; font-size: 13px; color: var(--soft); }
.bar { display: flex; height: 6px; border-radius: 3px; overflow: hidden; margin: 5px 0 4px;
  background: #eff1f4; }
.bar span { display: block; }
footer { margin-top: 44px; color: var(--soft); font-size: 13px; }
@media (max-width: 820px) { .pictures, .columns { grid-template-columns: 1fr; } main { padding: 24px 16px; } }
@media print { body { background: #fff; } figure, .card { break-inside: avoid; } }
"""

SCRIPT = """
for (const table of document.querySelectorAll("table.search")) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  heads.forEach((head, column) => head.firstElementChild.addEventListener("click", () => {
    const up = head.getAttribute("aria-sort") !== "ascending";
    const key = row => row.cells[column].dataset.key;
    const numeric = head.classList.contains("number");
    const order = (a, b) => numeric ? key(a) - key(b) : key(a).localeCompare(key(b));
    body.append(...[...body.rows].sort((a, b) => (up ? 1 : -1) * (order(a, b) || 0)));
    heads.forEach(other => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", up ? "ascending" : "descending");
  }));
}
"""

COLOURS = (
    "#3550b5",
    "#d9822b",
    "#177245",
    "#b4407a",
    "#2a8fa8",
    "#8a6d1f",
    "#7a4fc0",
    "#b42318",
    "#5b6b7f",
    "#4f9d2f",
)
"""Colours of the cost terms, in order of their total cost; further terms begin again."""
