// SPDX-License-Identifier: Apache-2.0
#include "style.hpp"

namespace rave::experiment {

// The colours of lines are those of Okabe and Ito, lifted for the dark look.
const char* const kPageStyle = R"css(
:root{color-scheme:light dark;--page:#fff;--ink:#16181d;--soft:#5b6270;--rule:#d8dce3;--card:#f4f5f8;
--good:#117a4f;--bad:#96570a;--c0:#0068a6;--c1:#b34c00;--c2:#007a5a;--c3:#a03b7a;--c4:#6a6f7a;--c5:#8a6a00}
@media(prefers-color-scheme:dark){:root{--page:#14161b;--ink:#eceef2;--soft:#a3aab8;--rule:#333842;
--card:#1d2027;--good:#4cc38a;--bad:#e6a344;--c0:#5ab4f0;--c1:#f0935a;--c2:#3fc49c;--c3:#e58cc2;--c4:#a9b0bd;
--c5:#e0c04c}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);font:14px/1.45 Inter,system-ui,"DejaVu Sans",sans-serif}
main{max-width:1080px;margin:0 auto;padding:24px 20px 48px}
.top{display:flex;flex-wrap:wrap;gap:4px 24px;justify-content:space-between;color:var(--soft);font-size:13px}
.top b{color:var(--ink);letter-spacing:.04em}
h1{font-size:28px;line-height:1.2;margin:20px 0 8px}
h2{font-size:16px;margin:0 0 2px}
.answer{font-size:19px;line-height:1.4;margin:0 0 8px;max-width:60em}
.soft{color:var(--soft);margin:0 0 12px}
.chips{display:flex;flex-wrap:wrap;gap:6px;margin:12px 0 0;padding:0;list-style:none}
.chips li{background:var(--card);border-radius:999px;padding:3px 10px;font-size:12px}
section{border-top:1px solid var(--rule);margin-top:28px;padding-top:18px}
.pair{display:grid;grid-template-columns:minmax(0,1fr) minmax(0,1fr);gap:24px;align-items:start}
.pair>:only-child{grid-column:1/-1}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:13px;font-variant-numeric:tabular-nums}
th{color:var(--soft);font-weight:500;font-size:12px}
th,td{padding:5px 10px;text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}
th:first-child,td:first-child,.left{text-align:left}
td.strong,.strong{font-weight:600}
.good{color:var(--good)}.bad{color:var(--bad)}
svg{width:100%;height:auto;display:block;font:11px Inter,system-ui,"DejaVu Sans",sans-serif;fill:var(--ink)}
svg .tick,svg .axis{fill:var(--soft)}
svg .grid{stroke:var(--rule)}svg .zero{stroke:var(--soft)}
svg .c0{stroke:var(--c0)}svg .c1{stroke:var(--c1)}svg .c2{stroke:var(--c2)}
svg .c3{stroke:var(--c3)}svg .c4{stroke:var(--c4)}svg .c5{stroke:var(--c5)}
svg text.c0{fill:var(--c0);stroke:none}svg text.c1{fill:var(--c1);stroke:none}
svg text.c2{fill:var(--c2);stroke:none}svg text.c3{fill:var(--c3);stroke:none}
svg text.c4{fill:var(--c4);stroke:none}svg text.c5{fill:var(--c5);stroke:none}
svg .run{fill:var(--c0);stroke:none;opacity:.55}
svg .bar{stroke-width:2}svg .mean{fill:var(--c0);stroke:var(--page);stroke-width:1.5}
svg .curve{fill:none;stroke-width:1.75}svg .band{fill:var(--c0);stroke:none;opacity:.18}
svg .d1{stroke-dasharray:6 3}svg .d2{stroke-dasharray:2 3}
svg .on-dark{fill:#fff}svg .on-light{fill:#16181d}svg .best{stroke:var(--ink);stroke-width:2}
code,pre{font:12px "JetBrains Mono",ui-monospace,"DejaVu Sans Mono",monospace}
pre{background:var(--card);border-radius:6px;padding:10px 12px;white-space:pre-wrap;overflow-wrap:anywhere;margin:6px 0}
dl{display:grid;grid-template-columns:repeat(auto-fit,minmax(200px,1fr));gap:14px;margin:0}
dt{color:var(--soft);font-size:12px}dd{margin:0;overflow-wrap:anywhere}
@media(max-width:760px){.pair{grid-template-columns:minmax(0,1fr)}h1{font-size:22px}.answer{font-size:16px}
main{padding:16px 12px 32px}}
@media print{section{break-inside:avoid}main{max-width:none;padding:0}}
)css";

}  // namespace rave::experiment
