"""What docs/results.md quotes of controls, from docs/tables_controls*.md: for quote_figures.py."""
from figure_tables import figure, quoted, read_tables, show, table

CONTROLS = read_tables("tables_controls.md")
MARTIAL = read_tables("tables_controls_martial.md")
RANDOM = read_tables("tables_controls_random.md")
ABLATIONS = read_tables("tables_controls_ablations.md")
LENGTHS = ("10", "50", "100", "150")
LONG = ("100", "150", "200", "250")
PARTS = ("trunk", "left_arm", "right_arm", "left_leg", "right_leg")
ALONE, SERVED, HARVEY = "model, network alone", "model", "Harvey et al. 2020"
METHODS = (ALONE, SERVED, HARVEY, "interpolation", "real")
HEAD = ("network alone", "as served (arrival, foot lock)", "Harvey et al., as served", "interpolation", "real motion", "wanted at least")
# Wanted at least: LRP over interpolation's by length, means of AVF and ART, how far a multiplier may be missed.
LRP, AVF, ART, FOLLOWS = (1.0, 0.57, 0.55, 0.60), 0.74, 0.81, 0.15
ABLATED = {  # paper C's own means, Tables 2 to 4: LRP over interpolation's, AVF, ART
    "full": (53.63, 0.74, 0.81), "one LSTM": (73.06, 0.70, 0.72), "fully connected controllers": (71.48, 0.68, 0.61),
    "one decoder": (55.45, 0.72, 0.51), "no velocity factors": (69.50, 0.56, 0.50), "no key loss": (81.83, 0.66, 0.41)}
LONGER = ("full", "no key loss")  # trained four times as long, too


def bounds(times):
    """Between which a multiplier counts as followed."""
    return [(1 + sign * FOLLOWS) * float(times) for sign in (-1, 1)]


def lrp(tables, name, method, held):
    ours = held and method in (ALONE, SERVED)
    values = [figure(tables, f"LRP over interpolation's, {name}", (method,), length) for length in LENGTHS]
    return ", ".join(show(value, 2, lambda v, bar=bar: v <= bar or not ours) for value, bar in zip(values, LRP))


def at_lengths(tables, title, method, digits, bar=None):
    """Figures at all lengths; with a bar, their mean too, which is held to it where it is ours."""
    text = ", ".join(show(figure(tables, title, (method,), length), digits) for length in LENGTHS)
    if bar is None:
        return text
    return f"{text}; {show(figure(tables, title, (method,), 'mean'), 2, lambda v: v >= bar or method not in (ALONE, SERVED))}"


def follows(tables, title, method, times):
    low, high = bounds(times)
    values = [figure(tables, f"{title}, dancedb", (method, times), part) for part in PARTS]
    return ", ".join(show(value, 2, lambda v: low <= v <= high) for value in values)


def ending(tables, method, what):
    title = "Repetition and endings, dancedb"
    values = [figure(tables, title, (method,), f"{what}, {length}") for length in LONG]
    real = [figure(tables, title, ("real",), f"{what}, {length}") for length in LONG]
    # As real dance: within two of a hundred half seconds.
    near = lambda value, of: method not in (ALONE, SERVED) or value <= of + 0.02
    return ", ".join(show(value, 2, lambda v, of=of: near(v, of)) for value, of in zip(values, real))


def paper_rows(tables, name, methods=METHODS, held=True):
    """`held`: to the bars."""
    avf, art = (AVF, ART) if held else (0, 0)
    return [["LRP over interpolation's", *(lrp(tables, name, method, held) for method in methods), ", ".join(f"{bar:.2f}" for bar in LRP)],
            ["AVF (1 cm a frame); mean", *(at_lengths(tables, f"AVF, {name}", method, 2, avf) for method in methods), f"{AVF}"],
            ["ART (7 cm); mean", *(at_lengths(tables, f"ART, {name}", method, 2, art) for method in methods), f"{ART}"],
            ["skating", *(at_lengths(tables, f"Skating ratio, {name}", method, 2) for method in methods), "–"]]


def all_rows(tables, methods):
    rows = paper_rows(tables, "dancedb", methods)
    for title, what in (("Velocity factors times a number", "factors × {}: trunk, arms, legs over the real dance's"),
                        ("Constant velocity factors", "the reference × {}, constant: trunk, arms, legs over the reference")):
        for times in ("0.5", "1.5"):
            low, high = bounds(times)
            cells = [follows(tables, title, method, times) if method in (ALONE, SERVED) else "–" for method in methods]
            rows.append([what.format(times), *cells, f"{low:.3f} to {high:.3f}"])
    for what in ("repeated", "still at the end"):
        cells = [ending(tables, method, what) for method in methods]
        rows.append([f"{what}, at {', '.join(LONG)} frames", *cells, "as real motion"])
    rows.append(["trembling: share of movement above 4 Hz", *(trembling(tables, "dancedb", method) for method in methods), "as real motion"])
    return rows


def trembling(tables, name, method):
    """No more than real motion's: a bar of our own."""
    title = f"Trembling, {name}"
    pairs = [(figure(tables, title, (method,), length), figure(tables, title, ("real",), length)) for length in LENGTHS]
    return ", ".join(show(value, 2, lambda v, of=of: v <= of or method not in (ALONE, SERVED)) for value, of in pairs)


def controls():
    return table(["figure, at 10, 50, 100, 150 frames", *HEAD], all_rows(CONTROLS, METHODS))


def controls_random():
    head = [name for name in HEAD if not name.startswith(HARVEY[:6])]
    return table(["figure, at 10, 50, 100, 150 frames", *head], all_rows(RANDOM, [method for method in METHODS if method != HARVEY]))


def controls_martial():
    return table(["figure, at 10, 50, 100, 150 frames", *HEAD[:-1]], [row[:-1] for row in paper_rows(MARTIAL, "cmu", held=False)])


def drawn():
    title = "Drawn paths, dancedb"
    rows = []
    for path in ("as danced", "straight", "on the spot", "a bow"):
        skating = [show(figure(CONTROLS, title, (path, method), "skating")) for method in ("interpolation, foot lock", ALONE, SERVED)]
        missed = [show(figure(CONTROLS, title, (path, method), "key missed cm"), 2, unit=" cm") + ", " +
                  show(figure(CONTROLS, title, (path, method), "a joint off degrees"), 1, unit="°") for method in (ALONE, SERVED)]
        off = show(figure(CONTROLS, title, (path, SERVED), "root off path mean cm"), 1, unit=" cm")
        rows.append([path, show(figure(CONTROLS, title, (path, SERVED), "root asked m/s")), *skating, *missed, off])
    return table(["path", "asked, m/s", "skating: interpolation, foot lock", "network alone", "as served", "key missed, worst joint: alone", "as served",
                  "root off the path, as served"], rows)


def controls_ablations():
    rows = []
    straight = figure(ABLATIONS, "LRP, cm, dancedb", ("interpolation",), "mean")
    trained = ABLATIONS.get("LRP, cm, dancedb", {})
    longer = {name: f"{name}, 8,000 updates" for name in LONGER if (f"{name}, 8,000 updates, network alone",) in trained}
    for name, paper in [*ABLATED.items(), *((row, ABLATED[name]) for name, row in longer.items())]:
        row = (f"{name}, network alone",)
        lengths = [show(figure(ABLATIONS, "LRP over interpolation's, dancedb", row, length)) for length in LENGTHS]
        means = [quoted(ABLATIONS, f"{what}, dancedb", row, "mean") for what in ("LRP, cm", "AVF", "ART")]
        rows.append([name, ", ".join(lengths), *means, ", ".join(f"{value:.2f}" for value in paper)])
    rows.append(["interpolation", "1", show(straight, 1), "–", "–", "84.87, –, –"])
    return table(["model", "LRP over interpolation's at 10, 50, 100, 150", "LRP, cm, mean", "AVF, mean", "ART, mean",
                  "paper C: LRP, AVF, ART"], rows)
