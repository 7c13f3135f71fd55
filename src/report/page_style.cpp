#include "report/page.hpp"

namespace bitshade {

std::string_view page_style() {
  return R"css(
:root { color-scheme: light dark; --ink: #1d2126; --soft: #5b6470; --paper: #fbfbfa; --card: #fff;
  --edge: #d9dcdf; --grid: #e4e7e9; --link: #0b62a8; --good: #00714f; --bar: #cfe3f3;
  --c0: #0072b2; --c1: #d55e00; --c2: #009e73; --c3: #b8608f; --c4: #3d93c7; --c5: #b97f00; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e8ea; --soft: #a2abb5; --paper: #15181b;
  --card: #1c2024; --edge: #363c43; --grid: #2b3036; --link: #6fb7f0; --good: #4fc79e; --bar: #23435c;
  --c0: #4aa3df; --c1: #f08a45; --c2: #35c49a; --c3: #dd93ba; --c4: #86ccf2; --c5: #e8b64a; } }
@media print { :root { color-scheme: light; --ink: #000; --soft: #444; --paper: #fff; --card: #fff;
  --edge: #bbb; --grid: #ddd; --link: #000; --good: #00573d; --bar: #d8e6f0; --c0: #0072b2;
  --c1: #d55e00; --c2: #009e73; --c3: #b8608f; --c4: #3d93c7; --c5: #b97f00; } }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; max-width: 62rem; padding: 1.5rem 1.25rem 4rem; background: var(--paper);
  color: var(--ink); font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .3rem; }
h2 { font-size: 1.3rem; margin: 2.6rem 0 .6rem; padding-top: .8rem; border-top: 1px solid var(--edge); }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .4rem; }
p { margin: .5rem 0; max-width: 46rem; }
.soft, figcaption, footer { color: var(--soft); font-size: .9rem; }
nav a { margin-right: 1rem; }
a { color: var(--link); }
ul.findings { padding-left: 1.2rem; max-width: 46rem; }
ul.findings li { margin: .35rem 0; }
ul.findings li:first-child { font-weight: 600; }
code, pre { font-family: ui-monospace, "SF Mono", Menlo, Consolas, monospace; font-size: .84em; }
code.command { display: block; margin-top: .3rem; padding: .35rem .55rem; background: var(--card);
  border: 1px solid var(--edge); border-radius: 4px; overflow-wrap: anywhere; color: var(--ink); }
code.command::before { content: "$ "; color: var(--soft); }
.scroll { overflow-x: auto; margin: .6rem 0; border: 1px solid var(--edge); border-radius: 6px;
  background: var(--card); }
table { border-collapse: collapse; width: 100%; font-size: .85rem; font-variant-numeric: tabular-nums; }
th, td { padding: .32rem .5rem; text-align: right; white-space: nowrap; }
th.word, td.word { text-align: left; }
thead th { border-bottom: 1px solid var(--edge); vertical-align: bottom; font-weight: 600; }
tbody tr + tr td { border-top: 1px solid var(--grid); }
tbody tr:hover td { background: color-mix(in srgb, var(--bar) 35%, transparent); }
th button { all: unset; cursor: pointer; display: inline-block; }
th button:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
th[aria-sort=ascending] button::after { content: " \2191"; }
th[aria-sort=descending] button::after { content: " \2193"; }
td.level { background: linear-gradient(to left, var(--bar) var(--level, 0%), transparent 0); }
figure { margin: 1.2rem 0; }
figcaption { max-width: 46rem; margin-top: .4rem; }
figcaption b { color: var(--ink); }
.plot { overflow-x: auto; }
svg { display: block; width: 100%; min-width: 31rem; max-width: 46rem; height: auto; background: var(--card);
  border: 1px solid var(--edge); border-radius: 6px; font: 12.5px system-ui, sans-serif; }
svg text { fill: var(--ink); } svg .title { fill: var(--soft); }
svg .grid { stroke: var(--grid); } svg .axis { stroke: var(--soft); }
svg .split { fill: var(--ink); }
.c0 { --own: var(--c0); } .c1 { --own: var(--c1); } .c2 { --own: var(--c2); }
.c3 { --own: var(--c3); } .c4 { --own: var(--c4); } .c5 { --own: var(--c5); }
.cm { --own: var(--soft); }
svg .line { fill: none; stroke: var(--own); stroke-width: 2; } svg .line.cm { stroke-dasharray: 6 4; }
svg .spread { stroke: var(--own); stroke-width: 1.2; opacity: .7; }
svg .compare-with { stroke: var(--soft); stroke-dasharray: 2 3; }
svg .mark { fill: var(--own); stroke: var(--card); stroke-width: 1; } svg .area { fill: var(--own); }
svg .mark.hollow { fill: var(--card); stroke: var(--own); stroke-width: 2; }
.choices { display: flex; flex-wrap: wrap; gap: .5rem 1rem; margin: .6rem 0; font-size: .9rem; }
.choices label { display: flex; gap: .4rem; align-items: center; }
select { font: inherit; color: inherit; background: var(--card); border: 1px solid var(--edge);
  border-radius: 4px; padding: .2rem .3rem; max-width: 15rem; }
.compare { position: relative; border: 1px solid var(--edge); border-radius: 6px; overflow: hidden;
  line-height: 0; --at: 50%; touch-action: pan-y; background: #fff; }
.compare img { width: 100%; height: auto; image-rendering: auto; }
.compare .over { position: absolute; inset: 0; clip-path: inset(0 calc(100% - var(--at)) 0 0); }
.compare .edge { position: absolute; top: 0; bottom: 0; left: var(--at); width: 2px; margin-left: -1px;
  background: #d55e00; pointer-events: none; }
.compare .edge::after { content: "\2194"; position: absolute; top: 50%; left: -14px; width: 30px;
  height: 30px; border-radius: 50%; background: #d55e00; color: #fff; font: 18px/30px sans-serif;
  text-align: center; }
.compare input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0;
  cursor: ew-resize; }
.compare input:focus-visible ~ .edge { outline: 2px solid var(--link); }
.compare .tag { position: absolute; top: .5rem; padding: .15rem .5rem; border-radius: 3px;
  background: rgba(20, 24, 28, .78); color: #fff; font-size: .8rem; line-height: 1.4;
  pointer-events: none; }
.compare .tag.a { left: .5rem; } .compare .tag.b { right: .5rem; }
.still { max-width: 100%; height: auto; border: 1px solid var(--edge); border-radius: 6px; }
dl.effects { display: grid; grid-template-columns: max-content 1fr; gap: .35rem 1rem; max-width: 50rem; }
dl.effects dt { font-weight: 600; } dl.effects dd { margin: 0; }
.badge { display: inline-block; min-width: 5.4em; font-size: .78rem; text-align: center;
  border: 1px solid var(--edge); border-radius: 3px; padding: 0 .35rem; margin-right: .5rem;
  color: var(--soft); }
.badge.yes { color: var(--good); border-color: currentColor; font-weight: 600; }
.by { color: var(--soft); font-size: .85rem; }
@media (max-width: 34rem) { body { padding: 1rem .8rem 3rem; } h1 { font-size: 1.4rem; }
  dl.effects { grid-template-columns: 1fr; gap: .1rem; } dl.effects dd { margin-bottom: .5rem; }
  .choices label { width: 100%; justify-content: space-between; } }
@media print { body { max-width: none; padding: 0; font-size: 10pt; } .choices, nav { display: none; }
  figure, .scroll, tr { break-inside: avoid; } h2, h3 { break-after: avoid; }
  .scroll { overflow: visible; } th, td { padding: .12rem .22rem;
  font-size: 6.5pt; white-space: normal; }
  svg, .still, .compare { min-width: 0; max-width: 30rem; } }
)css";
}

}  // namespace bitshade
