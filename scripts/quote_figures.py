#!/usr/bin/python3
"""Writes what docs/results.md and README.md quote from docs/tables*.md, so that it can't drift.

    scripts/quote_figures.py            writes
    scripts/quote_figures.py --check    changes nothing; fails where a page quotes something else

A quotation stands between <!-- figures: NAME --> and <!-- end -->; NAME is a function below, or of
quote_controls.py. Bold is a bar that is not reached. A figure that the tables don't have is a dash, and named on stderr.
"""
import math
import re
import sys

sys.dont_write_bytecode = True
from figure_tables import ROOT, figure, missing, over, quoted, read_tables, show, table
from quote_controls import controls, controls_ablations, controls_martial, controls_random, drawn  # noqa: F401: pages name them

PAGES = ("docs/results.md", "README.md")
SETS = ("dancedb", "tang2018")
LENGTHS = ("10", "30", "60", "90")
HARVEY = "Harvey et al. 2020"
WANTED = {"dancedb": (0.95, 0.75, 0.75, 0.78), "tang2018": (0.90, 0.75, 0.80, 0.82)}  # L2P over interpolation's
TABLES = read_tables("tables.md")
ABLATIONS = read_tables("tables_ablations.md")
UNSEEN_GENRE = read_tables("tables_unseen_genre.md")
FREE = read_tables("tables_free.md")


def of(title, labels, column, tables=TABLES):
    return figure(tables, title, labels, column)


def rows_of(title):
    return TABLES.get(title, {})


def near_real(value):
    return 0.8 <= value <= 1.2


def transitions(which, method, column, lengths=LENGTHS, tables=TABLES):
    return [of(f"Transitions between real poses, {which}", (frames, method), column, tables) for frames in lengths]


def over_other(which, column, other="real", reached=lambda value: True):
    pairs = zip(transitions(which, "model", column), transitions(which, other, column))
    return ", ".join(show(over(model, value), 2, reached) for model, value in pairs)


def ratios(which, method, bars, tables=TABLES):
    pairs = zip(transitions(which, method, "L2P / interpolation's", tables=tables), bars)
    return ", ".join(show(value, 2, lambda v, bar=bar: v <= bar) for value, bar in pairs)


def has_music(which):
    return f"Steps on beats, {which}" in TABLES


def samples(which):
    title = f"L2P of samples over interpolation's, {which}"
    names = [labels[0] for labels in rows_of(title)]
    best = next((name for name in names if name.startswith("best of")), "best of 10, T = 1")
    served = transitions(which, "model", "L2P / interpolation's", ("30",))[0]
    near = of(title, (best,), "30 frames")
    return (show(of(title, ("one, T = 1",), "30 frames"), 2, lambda v: v <= 1) + "; " +
            show(near, 2, lambda v: served is not None and v < served))


def fid(which):
    title = f"FID, variability, diversity, {which}"
    real = of(title, ("real",), "FID")
    methods = ("model without keys", "interpolation, foot lock", HARVEY)
    others = [over(of(title, (name,), "FID"), real) for name in methods]
    lowest = min((value for value in others if value is not None), default=0)
    own = over(of(title, ("model",), "FID"), real)
    return ", ".join([show(value, 1) for value in others] + [show(own, 1, lambda v: v < lowest)])


def features(column):
    methods = ("model", "interpolation", HARVEY, "real")
    return lambda which: ", ".join(show(transitions(which, method, column, ("60",))[0], 1) for method in methods)


def foot_contacts(which):
    return "; ".join(", ".join(show(value) for value in transitions(which, method, "PFC")) for method in ("model", "real"))


def beats(which, row, column):
    return of(f"Steps on beats, {which}", (row,), column)


def beats_hit(which):
    return "; ".join(f"{show(beats(which, row, 'hit rate %'), 0, unit=' %')}, "
                     f"{show(beats(which, row, 'above chance'), 0, lambda v: v >= 8)} points" for row in ("no keys", "keys each 2 s"))


def on_beats(which):
    equal = beats(which, "keys each 100 frames", "hit rate %")
    on = beats(which, "as many keys, on beats", "hit rate %")
    return f"{show(on, 0, lambda v: equal is not None and v > equal)} against {show(equal, 0)} %"


def coverage(which):
    return "; ".join(show(beats(which, row, "coverage / real's"), 2, lambda v: 0.9 <= v <= 1.1) for row in ("no keys", "keys each 2 s"))


def alignment(which):
    return "; ".join(show(beats(which, *place), 2) for place in (("keys each 2 s", "alignment"), ("keys each 2 s", "its chance"),
                                                                 ("real", "alignment")))


def variability(which):
    title = f"FID, variability, diversity, {which}"
    free = of(title, ("model without keys",), "variability")
    return show(free, 0) + "; " + show(of(title, ("model",), "variability"), 0, lambda v: free is not None and v < free)


def long(which, row, column, tables=TABLES):
    return of(f"Long dances, {which}", (row,), column, tables)


def long_speed(which, tables=TABLES):
    rows = {"no keys": "real motion", "keys each 2 s": "real motion of these keys"}
    return "; ".join(show(over(*(long(which, row, "speed median m/s", tables) for row in pair)), 2, near_real) for pair in rows.items())


def broken(row, beside=None, tables=TABLES):
    def shares(which, row, allowed):
        return ", ".join(show(long(which, row, column, tables), 0, lambda v: v <= allowed, " %")
                         for column in ("frozen %", "exploded %", "drifted %"))
    return lambda which: shares(which, row, 0) + ("; " + shares(which, beside, 100) if beside else "")


def hard_keys(which):
    return (show(long(which, "keys each 2 s", "keys above real p95 %"), 0, lambda v: v <= 5, " %") + "; " +
            show(long(which, "real motion", "keys above real p95 %"), 0, unit=" %"))


def hinges(which):
    return "; ".join(show(long(which, row, "hinges backwards %"), 2, unit=" %") for row in ("no keys", "keys each 2 s"))


def final_keys(which):
    title = f"How keys are met, {which}"
    worst = [[of(title, (frames, "model"), column) for frames in LENGTHS] for column in ("final error worst mm", "worst degrees")]
    most = [max((value for value in values if value is not None), default=None) for values in worst]
    return show(most[0], 4, lambda v: v <= 1, " mm") + "; " + show(most[1], 5, lambda v: v <= 0.1, "°")


def influence(column, reached=lambda value: True):
    title = "What changes a dance, "
    return lambda which: "; ".join(show(of(title + which, (row,), column), 0, reached, " cm") for row in ("no keys", "keys each 2 s"))


def another_song(which):
    moved = lambda value: value > 0
    return f"{influence('another song', moved)(which)} ({influence('no song')(which)})"


def stress(which):
    title = f"Keys that ask for too much or too little, {which}"
    cells = []
    for frames in ("30", "90"):
        real = of(title, ("real motion", frames), "frozen %")
        own = of(title, ("almost the same pose", frames), "frozen %")
        cells.append(show(own, 0, lambda v: v == 0, " %") + ", " + show(real, 0, unit=" %"))
    return "; ".join(cells)


def raw_key(which, frames, method):
    return figure(ABLATIONS, f"How keys are met, {which}", (frames, method), "raw KPD cm²")


def out_of_order(which, frames):
    """Which ablated models break the order that is wanted: full below no time embedding below no key loss, and below frames from the start."""
    pairs = (("no time embedding", "full"), ("no key loss", "no time embedding"), ("frames from the start", "full"))
    errors = {method: tuple(raw_key(which, frames, name) for name in (method, below)) for method, below in pairs}
    return {method for method, (error, below) in errors.items() if error is not None and below is not None and error <= below}


def ablation_order(which):
    methods = ("full", "no time embedding", "no key loss", "frames from the start")
    if None in [raw_key(which, frames, method) for frames in LENGTHS for method in methods]:
        return "–"
    broken_by = [out_of_order(which, frames) for frames in LENGTHS]
    orders = (set(methods[1:3]), set(methods[3:]))
    counts = [sum(not order & broken for broken in broken_by) for order in orders]
    return "; ".join(show(count, 0, lambda v: v == len(LENGTHS), f" of {len(LENGTHS)}") for count in counts)


def served():
    bars = "; ".join(", ".join(f"{bar:.2f}" for bar in WANTED[which]) for which in SETS)
    rows = [["L2P over interpolation's at 10, 30, 60, 90 frames", *(ratios(which, "model", WANTED[which]) for which in SETS), bars]]
    genres = {which: rows_of(f"L2P of the model over interpolation's, by genre, {which}") for which in SETS}
    for name in sorted({labels[0] for which in SETS for labels in genres[which]} - {"all"}):
        cells = []
        for which in SETS:
            figures = genres[which].get((name,), {})
            title = f"L2P of the model over interpolation's, by genre, {which}"
            cells.append(", ".join(show(of(title, (name,), f"{frames} frames"), 2, lambda v, bar=bar: v <= bar)
                                   for frames, bar in zip(LENGTHS, WANTED[which])) if figures else "–")
        rows.append([f"the same, {name}", *cells, ", ".join(f"{bar:.2f}" for bar in WANTED["tang2018"])])
    rows.append(["the same, DANCE_T, a genre in no training clip", "–", ratios("tang2018", "model", WANTED["tang2018"], UNSEEN_GENRE),
                 ", ".join(f"{bar:.2f}" for bar in WANTED["tang2018"])])

    def add(label, cell, wanted, music=False):
        rows.append([label, *(cell(which) if has_music(which) or not music else "–" for which in SETS), wanted])

    add("one sample at T = 1, 30 frames; best of 10 there", samples, "1.0; under the served figure")
    add("FID over real motion's: no keys, interpolation, Harvey et al., model", fid, "the model's the lowest (aim: within 2)")
    for column in ("FID_k", "FID_g"):
        add(f"{column}: model, interpolation, Harvey et al., real motion at 60 frames", features(column), "–")
    for column in ("L2Q", "NPSS"):
        add(f"{column} over interpolation's at 10, 30, 60, 90 frames",
            lambda which, column=column: over_other(which, column, "interpolation"), "–")
    add("PFC: model; real motion, at 10, 30, 60, 90 frames", foot_contacts, "–")
    add("beats hit, over chance: no keys; a key each 2 s", beats_hit, "+8 points", True)
    add("beats hit: as many keys, on beats, against each 100 frames", on_beats, "more", True)
    add("kinematic beats over real motion's: no keys; keys", coverage, "0.9 to 1.1", True)
    add("beat alignment (AIST++) of keyed dances; its chance; real motion's", alignment, "–", True)
    add("variability, in the encoder's units: no keys; keys", variability, "more without keys")
    add("another seed changes a dance by: no keys; keys", influence("another seed"), "–")
    add("another song changes a dance by: no keys; keys (no song at all)", another_song, "more than 0", True)
    for column in ("speed median m/s", "jerk median m/s³"):
        add(f"median {column.split()[0]} over real motion's at 10, 30, 60, 90 frames",
            lambda which, column=column: over_other(which, column, reached=near_real), "0.8 to 1.2")
    add("skating over real motion's at 10, 30, 60, 90 frames", lambda which: over_other(which, "skating", reached=lambda v: v <= 1), "1")
    add("keys passed harder than real motion's 95th percentile; real motion itself", hard_keys, "5 %")
    add("final key error, worst", final_keys, "1 mm; 0.1°")
    add("50 dances of up to 60 s without keys: frozen, exploded, drifted", broken("no keys"), "none")
    add("50 such dances, a key each 2 s: frozen, exploded, drifted; the real motion that the keys are of",
        broken("keys each 2 s", "real motion of these keys"), "none")
    add("60 s dances' median speed over real motion's: no keys; keys each 2 s", long_speed, "0.8 to 1.2")
    add("hinges bent backwards, share of frames and hinges: no keys; keys", hinges, "–")
    add("frozen onto a key that is almost the same pose, beside real motion, 30 frames; 90", stress, "none")
    add("raw key error of the small ablation models: full < no time embedding < no key loss; counting left < counting passed",
        ablation_order, "all lengths")
    return table(["figure", "dancedb, an unseen dancer", "tang2018", "wanted at least"], rows)


def free():
    rows = [["L2P over interpolation's at 10, 30, 60, 90 frames", *(ratios(which, "free data", [math.inf] * 4) for which in SETS)]]
    fids = lambda which: [of(f"FID, variability, diversity, {which}", (name,), "FID") for name in
                          ("free data", "interpolation, foot lock", "real")]
    rows.append(["FID; interpolation's; real motion's", *("; ".join(show(value, 1) for value in fids(which)) for which in SETS)])
    rows.append(["median speed over real motion's at 10, 30, 60, 90 frames",
                 *(", ".join(show(over(own, real)) for own, real in zip(transitions(which, "free data", "speed median m/s"),
                                                                        transitions(which, "real", "speed median m/s"))) for which in SETS)])
    for label, cell in (("50 dances of up to 60 s without keys: frozen, exploded, drifted", broken("no keys", tables=FREE)),
                        ("the same, a key each 2 s; the real motion that the keys are of",
                         broken("keys each 2 s", "real motion of these keys", FREE)),
                        ("60 s dances' median speed over real motion's: no keys; keys each 2 s", lambda which: long_speed(which, FREE))):
        rows.append([label, *(cell(which) for which in SETS)])
    return table(["figure", *SETS], rows)


def ablations():
    methods = ("full", "no time embedding", "no key loss", "no keys in training", "frames from the start")
    rows = []
    for which in SETS:
        for frames in LENGTHS:
            wrong = out_of_order(which, frames)
            cells = []
            for method in methods:
                cell = quoted(ABLATIONS, f"How keys are met, {which}", (frames, method), "raw KPD cm²")
                cell = re.sub(r"[\d.]+", lambda number: f"{float(number[0]):,.0f}", cell)
                cells.append(f"**{cell}**" if method in wrong else cell)
            rows.append([which, frames, *cells])
    return table(["set", "frames", *methods], rows)


def pictures():
    images = sorted((ROOT / "docs/images").glob("tables_*.png"))
    lines = []
    for label, kind in (("Ten transitions of each method", "sheet"), ("Plots", ""), ("Plots of the ablations", "ablations")):
        of_kind = [image for image in images if (image.stem.split("_")[1] if image.stem.split("_")[1] in ("sheet", "ablations") else "") == kind]
        links = [f"[{image.stem.removeprefix('tables_').removeprefix(kind).strip('_').replace('__', ', ').replace('_', ' ')}](images/{image.name})"
                 for image in of_kind]
        if links:
            lines.append(f"{label}: " + ",\n".join(links) + ".")
    return "\n\n" + "\n\n".join(lines) + "\n\n"


def readme():
    rows = []
    for frames in LENGTHS[1:]:
        row = [frames]
        for which in SETS:
            row.append(show(transitions(which, "model", "L2P / interpolation's", (frames,))[0]))
            skating = [transitions(which, method, "skating", (frames,))[0] for method in ("model", "real")]
            row.append(f"{show(skating[0])} ({show(skating[1])})")
        rows.append(row)
    return table(["frames", "ratio, dancedb (an unseen dancer)", "skating", "ratio, tang2018", "skating"], rows)


def readme_beats():
    keyed = "keys each 2 s"
    hit, chance = (show(beats("tang2018", keyed, column), 0) for column in ("hit rate %", "chance %"))
    more = show(beats("tang2018", keyed, "coverage / real's"), 1)
    return (f"With a key each 2 s, {hit} % of its kinematic beats are on the music's, where chance is {chance} %; it has {more} times as many "
            "of them as real dancers.")


def long_speeds():
    speeds = lambda row, real: " and ".join(show(over(long(which, row, "speed median m/s"), long(which, real, "speed median m/s"))) for which in SETS)
    return (f"without keys {speeds('no keys', 'real motion')} of their median speed ({', '.join(SETS)}), "
            f"with one each 2 s {speeds('keys each 2 s', 'real motion of these keys')}")


def free_ratios():
    return ", ".join(", ".join(show(value) for value in transitions(which, "free data", "L2P / interpolation's", LENGTHS[1:])) + f" on {which}"
                     for which in SETS)


def real_jerk():
    jerks = [show(transitions(which, "real", "jerk median m/s³", ("30",))[0], 0) for which in SETS]
    return f"{jerks[0]} m/s³ on dancedb, whose recordings are noisy, and {jerks[1]} on tang2018"


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    wrong = []
    for page in PAGES:
        path = ROOT / page
        text = path.read_text()
        quoted = re.sub(r"(<!-- figures: (\w+) -->).*?(<!-- end -->)", lambda match: match[1] + globals()[match[2]]() + match[3], text,
                        flags=re.DOTALL)
        if quoted == text:
            continue
        wrong.append(page)
        if not check:
            path.write_text(quoted)
    for name in sorted(missing):
        print(f"quote_figures.py: not in the tables: {name}", file=sys.stderr)
    if check and wrong:
        sys.exit(f"quote_figures.py: {', '.join(wrong)}: other figures than docs/tables*.md; run scripts/quote_figures.py")


if __name__ == "__main__":
    main()
