// SPDX-License-Identifier: BSD-3-Clause
#include "compare/page_parts.h"

namespace mlsmesh::apps {

// The shade at the right edge of a table lies behind its cells, still while they move, and under a cover that
// moves with them: it shows as long as there is more to come.
// Colours of series: Okabe and Ito, darker on white and lighter on black so that all stand out.
std::string pageStyle() {
  return R"css(
:root { color-scheme: light dark; --ground: #fff; --ink: #1d2733; --soft: #5a6675; --rule: #d5dbe3; --band: #f3f5f8;
  --link: #0054a6; --bad: #b3261e; --c0: #0072b2; --c1: #c25400; --c2: #00805c; --c3: #a8487e; --c4: #8a6d00;
  --c5: #1c7fb8; --c6: #333; --first: #8fb8de; --second: #1f5f99;
  --veil: rgba(20,60,120,.051); --shade: rgba(29,39,51,.34); }
@media (prefers-color-scheme: dark) {
  :root { --ground: #14181d; --ink: #e4e9ef; --soft: #9ba7b5; --rule: #39424d; --band: #1d232a; --link: #7db8f0;
    --bad: #ff8a80; --c0: #5aaee6; --c1: #ff9a4d; --c2: #3cc79e; --c3: #e59ac6; --c4: #e6c84c; --c5: #8fd0f7;
    --c6: #ccc; --first: #6288ad; --second: #a6cdf2; --veil: rgba(170,207,246,.06); --shade: rgba(0,0,0,.85); } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 0 1rem 3rem; max-width: 1400px; background: var(--ground); color: var(--ink);
  font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.6rem; margin: 1.2rem 0 .3rem; }
h2 { font-size: 1.3rem; margin: 2.2rem 0 .3rem; border-top: 2px solid var(--rule); padding-top: 1.2rem;
  overflow-wrap: anywhere; }
h3 { font-size: 1.05rem; margin: 1.6rem 0 .4rem; }
p { margin: .3rem 0 .6rem; max-width: 75ch; }
.facts, .note, figcaption small { color: var(--soft); }
.facts { overflow-wrap: anywhere; }
a { color: var(--link); }
nav { display: flex; flex-wrap: wrap; gap: .2rem 1rem; margin-bottom: .6rem; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; border: 1px solid var(--rule); border-radius: 6px; background:
  linear-gradient(to left, var(--ground) 40%, transparent) right / 3rem 100% no-repeat local,
  linear-gradient(to left, var(--shade), transparent) right / 1.1rem 100% no-repeat scroll, var(--ground); }
.wider { display: none; }
table { border-collapse: collapse; width: 100%; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .55rem; text-align: right; vertical-align: bottom; border-bottom: 1px solid var(--rule); }
tr:last-child > * { border-bottom: 0; }
thead th { background: var(--veil); font-weight: 600; }
tbody th { text-align: left; font-weight: 600; white-space: nowrap; position: sticky; left: 0; background: var(--ground); }
thead th[data-text] { text-align: left; }
thead th:first-child { text-align: left; position: sticky; left: 0; z-index: 1; background: var(--band); }
td { white-space: nowrap; }
tbody th, td { vertical-align: baseline; }
td.words { text-align: left; min-width: 11em; white-space: normal; }
td.bad { color: var(--bad); font-weight: 700; }
th button { all: unset; cursor: pointer; font: inherit; }
th button:focus-visible, .zoom:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
th[aria-sort] button::after { content: " \25B4"; }
th[aria-sort="descending"] button::after { content: " \25BE"; }
.icon { width: 14px; height: 14px; vertical-align: -2px; margin-right: .25em; }
.gallery { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(min(240px, 44vw), 1fr)); }
figure { margin: 0; border: 1px solid var(--rule); border-radius: 6px; overflow: hidden; background: var(--ground); }
figure.large { grid-column: 1 / -1; }
figure.large img { max-width: 100%; width: auto; margin: 0 auto; }
.zoom { all: unset; display: block; width: 100%; cursor: zoom-in; background: #fff; }
figure.large .zoom { cursor: zoom-out; }
figure img { display: block; width: 100%; height: auto; }
figcaption { padding: .35rem .6rem .5rem; font-size: 13px; line-height: 1.4; border-top: 1px solid var(--rule); }
figcaption small { display: block; font-size: 12px; }
.none { aspect-ratio: 1; display: grid; place-content: center; text-align: center; padding: 1rem; color: var(--soft);
  background: var(--band); font-size: 13px; overflow-wrap: anywhere; }
.legend { display: flex; flex-wrap: wrap; gap: .3rem 1.3rem; align-items: center; margin: .3rem 0 .7rem; padding: 0;
  list-style: none; font-size: 13px; }
.legend svg.swatch { width: 34px; height: 16px; vertical-align: -3px; margin-right: .4em; }
svg.scale { width: min(440px, 100%); height: auto; display: block; margin: .2rem 0 .7rem; }
.plots { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); }
.plot { width: 100%; max-width: 680px; height: auto; }
svg text { font: 12px system-ui, "DejaVu Sans", sans-serif; fill: var(--ink); }
svg text.title { font-size: 14px; font-weight: 600; }
svg text.number { font-size: 11.5px; font-weight: 700; }
.grid { stroke: var(--rule); stroke-width: 1; } .axis { stroke: var(--soft); stroke-width: 1; }
.line { fill: none; stroke-width: 1.6; opacity: .75; }
.first { fill: var(--first); } .second { fill: var(--second); }
.c0 { fill: var(--c0); } .c1 { fill: var(--c1); } .c2 { fill: var(--c2); } .c3 { fill: var(--c3); }
.c4 { fill: var(--c4); } .c5 { fill: var(--c5); } .c6 { fill: var(--c6); }
.l0 { stroke: var(--c0); } .l1 { stroke: var(--c1); } .l2 { stroke: var(--c2); } .l3 { stroke: var(--c3); }
.l4 { stroke: var(--c4); } .l5 { stroke: var(--c5); } .l6 { stroke: var(--c6); }
details { margin: .8rem 0; } summary { cursor: pointer; font-weight: 600; }
dl { font-size: 13px; margin: .5rem 0; display: grid; grid-template-columns: minmax(9em, max-content) 1fr; gap: .25rem 1rem; }
dt { font-weight: 600; } dd { margin: 0; overflow-wrap: anywhere; }
@media (max-width: 600px) { .wider { display: block; margin: 0 0 .3rem; font-size: 12px; } body { font-size: 14px; padding: 0 .7rem 2rem; } .gallery { gap: .5rem; }
  tbody th { white-space: normal; min-width: 11.5em; } dl { grid-template-columns: 1fr; } dd { margin-bottom: .4rem; } }
@media print { .wider { display: none; } .scroll { overflow: visible; } .zoom { cursor: auto; } figure, tr { break-inside: avoid; } }
)css";
}

std::string pageScript() {
  return R"js(
for (const table of document.querySelectorAll("table.sorts")) {
  const body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells];
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      heads.forEach(other => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const value = row => row.cells[column].dataset.v;
      const number = row => parseFloat(value(row));
      const order = (a, b) => {
        if (head.dataset.text !== undefined) return value(a).localeCompare(value(b)) * (down ? -1 : 1);
        const x = number(a), y = number(b);
        if (isNaN(x) || isNaN(y)) return isNaN(x) - isNaN(y);  // what is missing comes last, both ways
        return down ? y - x : x - y;
      };
      body.append(...[...body.rows].sort(order));
    });
  });
}
for (const zoom of document.querySelectorAll("figure .picture")) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "zoom";
  button.title = "larger or smaller";
  zoom.replaceWith(button);
  button.append(...zoom.childNodes);
  button.addEventListener("click", () => button.closest("figure").classList.toggle("large"));
}
)js";
}

}  // namespace mlsmesh::apps
