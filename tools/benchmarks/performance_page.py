# SPDX-License-Identifier: BSD-3-Clause
"""Tables and curves of what tools/benchmarks/performance.py has measured.

    python3 tools/benchmarks/performance_page.py docs            writes the part of docs/performance.md that comes from docs/performance.csv, and the curves
    python3 tools/benchmarks/performance_page.py --check docs    says where page or curves are not those of the table, and writes nothing
"""

import argparse
import csv
import hashlib
import os
import sys

SETTINGS = ["way", "side_um", "fraction", "voxel_um", "threads"]
STAGES = {"packing": "packing", "optimiser": "optimiser", "growth": "growth", "surfaces": "surfaces", "writer": "certificate and files"}
COLUMNS = ["processor", "cores", "memory_GB", "version", "date", *SETTINGS, "fibres", "length_um", "triangles", "certified", "folder_MB", "clock_s",
           "processor_s", "peak_MB", "others_percent"]
COLUMNS += [f"{stage}_{quantity}" for stage in (*STAGES, "certificate", "production") for quantity in ("clock_s", "processor_s", "peak_MB")]
BEGIN, END = "<!-- made from performance.csv by tools/benchmarks/performance_page.py -->\n", "<!-- by hand -->\n"

# Villarreal-Haro et al. 2023, doi:10.3389/fninf.2023.1208073: how many fibres in (500 µm)³, and what it takes to grow one.
PAPER = {"fibres": 33_478, "side": 500, "growth_s": 60}
COLOURS = ["#4f772d", "#1b6ca8", "#e09f3e", "#c8553d", "#6d597a"]


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if rows and list(rows[0]) != COLUMNS:
        sys.exit(f"performance: {path} has other columns than this version writes: name another folder with --output")
    return rows


def settings(row):
    """By which rows are told apart, and sorted."""
    return (row["way"], *(float(row[name]) for name in SETTINGS[1:]))


def number(row, name):
    return float(row[name])


def per_um(row, seconds):
    """Milliseconds for a µm of fibre."""
    return 1000 * seconds / number(row, "length_um")


def table(heads, rows):
    """Lines of a Markdown table."""
    return "\n".join(["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)] + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def significant(value, digits=3):
    """With so many digits, and none less before the point."""
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e" in text or value >= 10**digits else text


class Measured:
    """The rows in the series that they are shown in. What a series does not vary is what most of the rows have."""

    def __init__(self, rows):
        self.rows = rows
        filters = [row for row in rows if row["way"] == "filters"]
        usual = {name: self.most([row[name] for row in rows]) for name in ("fraction", "voxel_um", "threads")}

        def series(found, varied, *kept):
            found = [row for row in found if all(row[name] == usual[name] for name in kept)]
            sides = {}
            for row in found:
                sides.setdefault(row["side_um"], []).append(row)
            longest = max(sides.values(), key=len, default=[])
            return sorted(longest if len(longest) > 1 else [], key=lambda row: float(row[varied]))

        by_side = [row for row in rows if all(row[name] == usual[name] for name in usual)]
        self.sides = {}
        for row in sorted(by_side, key=lambda row: float(row["side_um"])):
            self.sides.setdefault(float(row["side_um"]), {})[row["way"]] = row
        self.fractions = series(filters, "fraction", "voxel_um", "threads")
        self.voxels = series(filters, "voxel_um", "fraction", "threads")
        self.threads = series(filters, "threads", "fraction", "voxel_um")

    @staticmethod
    def most(values):
        return max(sorted(set(values)), key=values.count) if values else ""

    def made_by(self, way):
        return [ways[way] for ways in self.sides.values() if way in ways]


def about(rows):
    """The machine, in one sentence."""
    row = rows[-1]
    days = sorted({row["date"] for row in rows})
    others = max(number(row, "others_percent") for row in rows)
    return (f"{row['cores']} cores of {row['processor']}, {row['memory_GB']} GB; version {', '.join(sorted({row['version'] for row in rows}))}, "
            f"{' to '.join(dict.fromkeys((days[0], days[-1])))}. Other programs took at most {others:.0f} % of the machine.\n")


def by_side(found):
    rows = []
    for side, ways in found.sides.items():
        for way, row in ways.items():
            rows.append([f"{side:g}", {"filters": "four filters", "streamed": "SubstrateProduction"}[way], row["fibres"],
                         significant(number(row, "clock_s")), significant(number(row, "processor_s")), f"{per_um(row, number(row, 'processor_s')):.1f}",
                         f"{number(row, 'peak_MB'):.0f}", significant(number(row, "triangles") / 1e6), significant(number(row, "folder_MB")), row["certified"]])
    heads = ["side (µm)", "made by", "fibres", "clock (s)", "processor time (s)", "ms per µm of fibre", "peak memory (MB)", "triangles (10⁶)", "folder (MB)", "certified"]
    return table(heads, rows)


def by_stage(found):
    rows = []
    for row in found.made_by("filters"):
        whole = number(row, "processor_s")
        cells = [f"{number(row, f'{stage}_processor_s'):.1f} ({100 * number(row, f'{stage}_processor_s') / whole:.0f} %)" for stage in STAGES]
        rows.append([f"{number(row, 'side_um'):g}", *cells, f"{number(row, 'certificate_processor_s'):.1f}"])
    peaks = found.made_by("filters")[-1]
    rows.append([f"{number(peaks, 'side_um'):g}: peak memory (MB)"] + [f"{number(peaks, f'{stage}_peak_MB'):.0f}" for stage in (*STAGES, "certificate")])
    return table(["side (µm)", *STAGES.values(), "certificate alone"], rows)


def by_setting(rows, name, head):
    cells = [[f"{number(row, name):g}", row["fibres"], significant(number(row, "clock_s")), f"{per_um(row, number(row, 'processor_s')):.1f}",
              *(f"{per_um(row, number(row, f'{stage}_processor_s')):.2f}" for stage in ("optimiser", "growth", "surfaces", "writer")),
              f"{number(row, 'peak_MB'):.0f}", f"{number(row, 'triangles') / number(row, 'length_um'):.0f}", significant(number(row, "folder_MB")), row["certified"]]
             for row in rows]
    heads = [head, "fibres", "clock (s)", "ms per µm of fibre", "optimiser", "growth", "surfaces", "certificate and files", "peak memory (MB)", "triangles per µm",
             "folder (MB)", "certified"]
    return table(heads, cells)


def by_threads(found):
    one = found.threads[0]
    cells = []
    for row in found.threads:
        gains = [number(one, f"{stage}_clock_s") / number(row, f"{stage}_clock_s") for stage in STAGES]
        whole = number(one, "clock_s") / number(row, "clock_s")
        share = whole * number(one, "threads") / number(row, "threads")
        cells.append([row["threads"], significant(number(row, "clock_s")), significant(number(row, "processor_s")), f"{whole:.2f}", f"{100 * share:.0f} %"]
                     + [f"{gain:.2f}" for gain in gains])
    return table(["threads", "clock (s)", "processor time (s)", "speed-up", "efficiency", *STAGES.values()], cells)


def beside_the_paper(found):
    """What the largest substrate says of the paper's, if a µm of fibre takes there what it takes here."""
    row = found.made_by("filters")[-1]
    # A fibre is as much longer than the side as it is here.
    length = PAPER["side"] * number(row, "length_um") / number(row, "fibres") / number(row, "side_um")
    side = f"{number(row, 'side_um'):g}"
    fibre = sum(number(row, f"{stage}_processor_s") for stage in ("growth", "surfaces")) / number(row, "length_um") * length
    hours = fibre * PAPER["fibres"] / 3600
    rest = sum(number(row, f"{stage}_processor_s") for stage in ("growth", "surfaces", "writer")) / number(row, "length_um") * length * PAPER["fibres"] / 3600
    paper = PAPER["growth_s"] * PAPER["fibres"] / 3600
    return table(
        [f"(500 µm)³, {PAPER['fibres']:,} fibres", "the paper", f"here, extrapolated from {side} µm"],
        [["growth of a fibre, one core", f"about {PAPER['growth_s']} s", f"{fibre:.1f} s, with both surfaces"],
         ["all fibres, core-hours", f"{paper:.0f}", f"{hours:.0f}, with both surfaces"],
         ["with certificate and files, core-hours", "–", f"{rest:.0f}"]])


def section(rows):
    """The part of the page that comes from the table."""
    found = Measured(rows)
    parts = ["\n" + about(rows)]
    if found.sides:
        parts += ["\n## By side\n\n", by_side(found), "\n![Time and memory by side](images/performance-sides.svg)\n"]
    if found.made_by("filters"):
        parts += ["\n## Where the time goes\n\nProcessor time of each stage of the four filters, in seconds.\n\n", by_stage(found), "\n![Shares of the stages](images/performance-stages.svg)\n"]
    for series, name, head, title in ((found.fractions, "fraction", "fibre volume fraction", "By fraction"), (found.voxels, "voxel_um", "VoxelSize (µm)", "By voxel")):
        if series:
            parts += [f"\n## {title}\n\nSide {number(series[0], 'side_um'):g} µm; stages in ms of processor time per µm of fibre.\n\n", by_setting(series, name, head)]
    if found.fractions or found.voxels:
        parts.append("\n![Time by fraction and by voxel](images/performance-settings.svg)\n")
    if found.threads:
        parts += [f"\n## By threads\n\nSide {number(found.threads[0], 'side_um'):g} µm; the last columns are the speed-up of each stage.\n\n", by_threads(found),
                  "\n![Gain by threads](images/performance-threads.svg)\n"]
    if found.made_by("filters"):
        parts += ["\n## Beside the paper\n\n", beside_the_paper(found)]
    return "".join(parts) + "\n"


def page(rows, now):
    """A whole page: what stands outside the two marks of the one there is now stays."""
    before, after = ("# What substrates take\n\n", "") if not now else (now.split(BEGIN)[0], now.split(END)[1])
    return before + BEGIN + section(rows) + END + after


def note(path):
    """What each curve says of the table that it is of."""
    with open(path, "rb") as file:
        return f"of performance.csv {hashlib.sha256(file.read()).hexdigest()}"


def legend(axes, columns=2):
    axes.legend(ncols=columns, loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0.3)


def curves(rows):
    """Names, and functions that draw on axes."""
    found = Measured(rows)
    filters, streamed = found.made_by("filters"), found.made_by("streamed")
    ways = [(rows, label, colour, mark) for rows, label, colour, mark in
            ((filters, "four filters", COLOURS[1], "o"), (streamed, "SubstrateProduction", COLOURS[3], "s")) if rows]

    def times(axes):
        for rows, label, colour, mark in ways:
            lengths = [number(row, "length_um") / 1000 for row in rows]
            axes.plot(lengths, [number(row, "processor_s") for row in rows], colour, marker=mark, label=f"{label}, processor time")
            axes.plot(lengths, [number(row, "clock_s") for row in rows], colour, marker=mark, linestyle=":", label=f"{label}, clock")
        axes.set(xscale="log", yscale="log", xlabel="all fibres (mm)", ylabel="s")
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter("{x:g}")
        legend(axes)

    def memory(axes):
        for rows, label, colour, mark in ways:
            axes.plot([number(row, "side_um") for row in rows], [number(row, "peak_MB") / 1000 for row in rows], colour, marker=mark, label=label)
        axes.set(xlabel="side (µm)", ylabel="peak memory (GB)")
        axes.set_ylim(bottom=0, top=1.1 * axes.get_ylim()[1])
        legend(axes)

    def shares(axes):
        left = [0.0] * len(filters)
        names = [f"{number(row, 'side_um'):g} µm" for row in filters]
        for (stage, label), colour in zip(STAGES.items(), COLOURS):
            share = [100 * number(row, f"{stage}_processor_s") / number(row, "processor_s") for row in filters]
            axes.barh(names, share, left=left, color=colour, label=label)
            left = [a + b for a, b in zip(left, share)]
        axes.set(xlabel="processor time (%)", xlim=(0, 100))
        legend(axes, 3)

    def by(series, name, label):
        def draw(axes):
            for (stage, text), colour in list(zip(STAGES.items(), COLOURS))[1:]:
                axes.plot([number(row, name) for row in series], [per_um(row, number(row, f"{stage}_processor_s")) for row in series], colour, marker="o", label=text)
            axes.set(xlabel=label, ylabel="ms per µm of fibre", ylim=(0, None))
            legend(axes)
        return draw

    def gains(axes):
        threads = [number(row, "threads") for row in found.threads]
        axes.plot(threads, [count / threads[0] for count in threads], "#999", linestyle=":", label="as many times as threads")
        for (stage, text), colour in list(zip(STAGES.items(), COLOURS))[1:]:
            axes.plot(threads, [number(found.threads[0], f"{stage}_clock_s") / number(row, f"{stage}_clock_s") for row in found.threads], colour, marker="o", label=text)
        axes.set(xlabel="threads", ylabel="times as fast", xticks=threads, ylim=(0, None))
        legend(axes)

    settings_shown = [by(rows, name, label) for rows, name, label in
                      ((found.fractions, "fraction", "fibre volume fraction"), (found.voxels, "voxel_um", "VoxelSize (µm)")) if rows]
    drawn = {"sides": [times, memory] if ways else [], "stages": [shares] if filters else [], "settings": settings_shown, "threads": [gains] if found.threads else []}
    return {name: panels for name, panels in drawn.items() if panels}


def draw(folder, rows):
    import matplotlib

    matplotlib.use("Agg")  # without a window
    from matplotlib import pyplot

    # Same table, same bytes; text stays text.
    pyplot.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
                            "svg.hashsalt": "performance", "svg.fonttype": "none"})
    said = note(os.path.join(folder, "performance.csv"))
    for name, panels in curves(rows).items():
        canvas, axes = pyplot.subplots(1, len(panels), figsize=(4.4 * max(len(panels), 1.1), 3), layout="constrained", squeeze=False)
        for panel, place in zip(panels, axes[0]):
            panel(place)
        canvas.savefig(picture(folder, name), metadata={"Date": None, "Description": said})
        pyplot.close(canvas)


def picture(folder, name):
    return os.path.join(folder, "images", f"performance-{name}.svg")


def write(folder):
    rows = read(os.path.join(folder, "performance.csv"))
    path = os.path.join(folder, "performance.md")
    now = ""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            now = file.read()
        if BEGIN not in now or END not in now:
            sys.exit(f"performance: {path} has not the marks of this page: move it, or name another folder with --output")
    with open(path, "w", encoding="utf-8") as file:
        file.write(page(rows, now))
    draw(folder, rows)


def faults(folder):
    """What of page and curves is not of the table."""
    table_path = os.path.join(folder, "performance.csv")
    rows = read(table_path)
    with open(os.path.join(folder, "performance.md"), encoding="utf-8") as file:
        now = file.read()
    if page(rows, now) != now:
        yield "performance.md does not say what performance.csv says"
    for name in curves(rows):
        if not os.path.exists(picture(folder, name)):
            yield f"{picture(folder, name)} is missing"
            continue
        with open(picture(folder, name), encoding="utf-8") as file:
            if note(table_path) not in file.read():
                yield f"{picture(folder, name)} is of another performance.csv"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, and fail where page or curves are not those of the table")
    parser.add_argument("folder")
    arguments = parser.parse_args()
    if not arguments.check:
        write(arguments.folder)
        return 0
    found = list(faults(arguments.folder))
    print("\n".join(found) or "page and curves are those of performance.csv")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
