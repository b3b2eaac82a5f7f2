#pragma once
// The one style sheet of the page, and its one script.
namespace softgrain::report {

inline constexpr const char* style_sheet = R"css(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.5rem 4rem; max-width: 1180px; background: #fff; color: #1c1f23;
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", "Liberation Sans", sans-serif; }
header { border-bottom: 3px solid #0072b2; margin-bottom: 1.5rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .3rem; overflow-wrap: anywhere; }
header p { margin: 0 0 .8rem; color: #535a63; }
h2 { font-size: 1.25rem; margin: 2.2rem 0 .7rem; padding-bottom: .2rem; border-bottom: 1px solid #d6dade; }
p { margin: .4rem 0; }
.verdict { background: #f1f6fa; border-left: 5px solid #0072b2; padding: .8rem 1.1rem; font-size: 1.05rem; }
.verdict p { margin: .45rem 0; max-width: 62em; overflow-wrap: anywhere; }
.note { color: #535a63; font-size: .86rem; max-width: 66em; }
dl { display: grid; grid-template-columns: minmax(7rem, max-content) 1fr; gap: .25rem 1.4rem; margin: .5rem 0; }
dt { font-weight: 600; }
dd { margin: 0; min-width: 0; overflow-wrap: anywhere; }
dd p { margin: 0 0 .2rem; }
details { margin-top: .8rem; }
summary { cursor: pointer; font-weight: 600; }
pre { background: #f6f7f8; border: 1px solid #e1e4e7; padding: .8rem 1rem; overflow-x: auto; font-size: .82rem;
  line-height: 1.4; white-space: pre-wrap; overflow-wrap: anywhere; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; min-width: 44rem; font-size: .92rem; font-variant-numeric: tabular-nums; }
th, td { padding: .38rem .7rem; text-align: left; vertical-align: top; border-bottom: 1px solid #e1e4e7; }
thead th { border-bottom: 2px solid #8b939c; vertical-align: bottom; font-weight: 600; line-height: 1.25; }
tbody th { font-weight: 600; white-space: nowrap; }
.number { text-align: right; white-space: nowrap; }
thead .number { white-space: normal; }
.swatch { display: inline-block; width: .8em; height: .8em; margin-right: .5em; border-radius: 2px; }
.flag { background: #fdeede; padding: 0 .25em; font-weight: 500; }
.plots { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 460px), 1fr)); gap: 1rem 1.5rem; }
figure { margin: 0; min-width: 0; break-inside: avoid; }
.plots svg { display: block; max-width: 100%; height: auto; }
.plots figure > svg { width: 100%; max-width: 760px; }
.stage { display: none; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 1.2rem 1.5rem; }
.stage.shown { display: grid; }
@media (min-width: 900px) { .of-three .stage { grid-template-columns: 1fr 1fr 1fr; } }
.stage img { display: block; width: 100%; height: auto; max-width: 720px; border: 1px solid #e1e4e7; }
figcaption { color: #8a3d00; font-size: .86rem; padding-top: .2rem; }
#loading:not([hidden]) { position: sticky; top: 0; z-index: 1; display: flex; flex-wrap: wrap; align-items: center;
  gap: .3rem 1rem; padding: .6rem 0; background: #fff; }
#loading label { font-weight: 600; }
#loading input { flex: 1 1 14rem; accent-color: #0072b2; }
#loading output { min-width: 13em; font-variant-numeric: tabular-nums; }
@media (max-width: 600px) { body { padding: 1rem .8rem 2rem; } dl { grid-template-columns: 1fr; } dd { margin-bottom: .5rem; } }
@page { size: A4; margin: 14mm 13mm; }
@media print {
  html { font-size: 9.5pt; } body { padding: 0; max-width: none; font-size: 1rem; }
  h1 { font-size: 17pt; } h2 { font-size: 12.5pt; margin-top: 6mm; break-after: avoid; }
  .verdict { font-size: 10.5pt; break-inside: avoid; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .swatch, .flag { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  table { font-size: 7.8pt; min-width: 0; } th, td { padding: 1mm 1.2mm; }
  tr, dd, .note { break-inside: avoid; }
  .wide { overflow: visible; break-inside: avoid; }
  #loading, .screen { display: none !important; }
  .stage { display: none !important; }
  .stage.last { display: grid !important; }
  .plots, .stage.last { grid-template-columns: 1fr 1fr; gap: 3mm 6mm; }
  details:not([open]) { display: none; }
}
)css";

inline constexpr const char* script = R"js(
const slider = document.getElementById("stage");
if (slider) {
  const stages = Array.from(document.querySelectorAll(".stage"));
  const name = document.getElementById("stage-name");
  const show = () => {
    const chosen = stages[slider.valueAsNumber];
    for (const stage of stages) stage.classList.toggle("shown", stage === chosen);
    name.value = chosen.dataset.name;
    slider.setAttribute("aria-valuetext", chosen.dataset.name);
  };
  slider.addEventListener("input", show);
  document.getElementById("loading").hidden = false;
  show();
}
)js";

}  // namespace softgrain::report
