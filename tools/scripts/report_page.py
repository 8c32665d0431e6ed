# SPDX-License-Identifier: BSD-3-Clause
"""The page of a report: one HTML text that needs nothing but itself, and prints on two sheets of A4."""

import html
import json

STYLE = """
@page { size: A4; margin: 12mm 14mm; }
body { font: 10.5pt/1.4 sans-serif; color: #222; background: #fff; max-width: 182mm; margin: 6mm auto; }
h1 { font-size: 17pt; margin: 0 0 1mm; } h2 { font-size: 12pt; margin: 4mm 0 1mm; border-bottom: 1px solid #ccc; }
.verdict { font-size: 13pt; font-weight: bold; padding: 2.5mm 4mm; margin: 2mm 0; border-left: 3mm solid; overflow-wrap: anywhere; }
.good { background: #e8f4e8; border-color: #2e7d32; } .bad { background: #fbe9e7; border-color: #c62828; }
table { border-collapse: collapse; width: 100%; } td, th { padding: 0.7mm 2mm; text-align: right; border-bottom: 1px solid #eee; }
td:first-child, th:first-child { text-align: left; }
img { width: 100%; } .charts { display: flex; gap: 3mm; } .charts > svg { flex: 1 1 0; min-width: 0; }
.small { font-size: 8pt; line-height: 1.3; } .small p { margin: 0.8mm 0; overflow-wrap: anywhere; } code { font-size: 9pt; overflow-wrap: anywhere; }
@media print { body { margin: 0; max-width: none; } .second { break-before: page; } .noprint { display: none; } }
"""


def shown(value):
    """A number with four significant digits; whole ones whole."""
    if value is None:
        return "–"
    return f"{value:,.0f}".replace(",", " ") if value == int(value) and abs(value) < 1e15 else f"{value:.4g}"


def _verdict(report):
    if report["changed"]:
        names = ", ".join(report["changed"][:3]) + (f" and {len(report['changed']) - 3} more" if len(report["changed"]) > 3 else "")
        return "bad", f"CHANGED SINCE: {len(report['changed'])} files are not as they were written ({names}). What follows is what was written."
    judged = " and ".join(report["judged"]) or "no"
    if report["certified"]:
        without = "" if "inner" in report["judged"] else " There are no inner surfaces."
        sample = f" This is a sample of {report['sample_of']} fibres, the others of which have no surfaces here." if report["sample_of"] else ""
        return "good", f"CERTIFIED: every surface is closed, no two meet, and no walker can leak ({judged} surfaces judged).{without}{sample}"
    return "bad", f"NOT CERTIFIED ({judged} surfaces judged): " + ("; ".join(report["faults"]) or "no reason is given")


def _table(rows):
    lines = [f"<tr><td>{html.escape(name)}</td><td>{shown(asked)}</td><td>{shown(reached)}</td></tr>" for name, asked, reached in rows]
    return "<table><tr><th></th><th>asked</th><th>reached</th></tr>" + "".join(lines) + "</table>"


def _stage(stage):
    def listed(values):
        return " · ".join(f"{html.escape(str(name))}&nbsp;{html.escape(value if isinstance(value, str) else json.dumps(value))}" for name, value in values.items())

    read = "".join(f" · read {html.escape(str(one.get('path')))}" for one in stage.get("files", []))
    reached = f" → {listed(stage['reached'])}" if stage.get("reached") else ""
    return f"<p><b>{html.escape(str(stage.get('filter')))}</b> {html.escape(str(stage.get('version')))}: {listed(stage.get('properties', {}))}{read}{reached}</p>"


def page(report):
    """The HTML of a report: title, certified, judged, faults, changed, rows, picture (a data URI, or None with no_picture saying why), charts
    and profiles (SVG texts), sample_of (fibres, or None), stages, versions, again (commands), manifest (a data URI), citation (text and link)."""
    kind, verdict = _verdict(report)
    picture = (f'<img alt="Left: a cut across the substrate. Right: the fibres, with axons that stand out of their myelin." src="{report["picture"]}">'
               if report["picture"] else f"<p>{html.escape(report['no_picture'])}</p>")
    cite, link = report["citation"]
    parts = [
        "<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8"><meta name="generator" content="CACTUS report">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{html.escape(report['title'])}</title><style>{STYLE}</style></head><body>",
        f'<h1>{html.escape(report["title"])}</h1><div class="verdict {kind}">{html.escape(verdict)}</div>',
        f'<h2>Asked and reached</h2>{_table(report["rows"])}<h2>The substrate</h2>{picture}',
        f'<div class="second"><h2>Distributions</h2><div class="charts">{"".join(report["charts"])}</div>',
        "".join(f'<p class="small">{html.escape(note)}</p>' for note in report["notes"]),
        f'<h2>Along a thin fibre, a middle one and a thick one</h2><div class="charts">{"".join(report["profiles"])}</div>' if report["profiles"] else "",
        f'<h2>Parameters</h2><div class="small">{"".join(_stage(stage) for stage in report["stages"])}</div>',
        "<h2>To make it again</h2><p>" + "<br>".join(f"<code>{html.escape(line)}</code>" for line in report["again"]) + "</p>",
        f'<p class="noprint"><a download="manifest.json" href="{report["manifest"]}">manifest.json</a> is in this page, too.</p>',
        f'<h2>To cite</h2><p>{html.escape(cite)} <a href="{html.escape(link, quote=True)}">{html.escape(link)}</a></p>',
        f'<p class="small">{html.escape(report["versions"])}</p></div></body></html>',
    ]
    return "\n".join(parts) + "\n"
