#!/usr/bin/python3
"""Fills in the quotes of docs/figures/*.json on pages and beside the checkpoint default, so that they can't drift. scripts/evaluate.sh and
scripts/train_papers.sh measure these; printed.json has the papers' own.

    scripts/quote_figures.py            writes
    scripts/quote_figures.py --check    changes nothing; fails where a page says something else
    scripts/quote_figures.py --print docs/papers.md     prints the tables of one page instead

Two kinds of quotation, each up to <!-- end -->:
    <!-- table: FILE TABLE | COLUMN | COLUMN ... -->    the rows of a table with any figure, and what is wanted of them (wanted.json); COLUMN=VALUE
                                                        leaves only rows that have it, COLUMN~PART those that have a part
                                                        like it, "wanted" those of which something is wanted; "plain" does
                                                        not say what; FILE+FILE has the methods of both
    <!-- figure: FILE TABLE | ROW | COLUMN -->          one figure; ROW is the row's first column
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FIGURES = ROOT / "docs/figures"
PAGES = ("docs/results.md", "docs/controls.md", "docs/weight.md", "docs/hearing.md", "docs/papers.md", "docs/papers_ablations.md",
         "docs/papers_ablations_c.md")
WANTED = json.loads((FIGURES / "wanted.json").read_text())


def rows_of(files, table):
    rows = []
    for file in files.split("+"):
        found = [one["rows"] for one in json.loads((FIGURES / f"{file}.json").read_text())["tables"] if one["name"] == table]
        if not found:
            sys.exit(f"quote_figures.py: {file}.json has no table {table}")
        known = [row.get("method") for row in rows]
        rows += [row for row in found[0] if not rows or row["method"] not in known]
    return rows


def show(value):
    if value is None:
        return "–"
    if isinstance(value, str):
        return value
    if isinstance(value, list):
        return "–".join(map(show, value))
    return f"{value:.0f}" if abs(value) >= 99.5 else f"{value:.1f}" if abs(value) >= 9.95 else f"{value:.2f}"


def cell(row, column):
    if column not in row:
        sys.exit(f"quote_figures.py: no column '{column}' beside {list(row)}")
    return show(row[column])


def has(row, kept):
    column, how, value = re.fullmatch(r"(\w+)([=~])(.*)", kept).groups()
    return row.get(column) == value if how == "=" else value in row.get(column, "")


def table(place, *columns):
    file, name = place.split()
    wanted = {} if "plain" in columns else WANTED.get(name, {})
    filters = [column for column in columns if re.fullmatch(r"\w+[=~][\w ,]+", column)]
    only_wanted = "wanted" in columns
    columns = [column for column in columns if column not in ("wanted", "plain", *filters)]
    lines = [columns + (["wanted"] if wanted else [])]
    for row in rows_of(file, name):
        if not all(has(row, kept) for kept in filters) or (only_wanted and row[columns[0]] not in wanted):
            continue
        label, *cells = [cell(row, column) for column in columns]
        if all(one == "–" for one in cells):
            continue
        lines.append([label, *cells] + ([wanted.get(row[columns[0]], "")] if wanted else []))
    lines.insert(1, ["---"] * len(lines[0]))
    return "\n\n" + "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n\n"


def figure(place, label, column):
    file, name = place.split()
    for row in rows_of(file, name):
        if next(iter(v for k, v in row.items() if v == label), None):
            return cell(row, column)
    sys.exit(f"quote_figures.py: {name} has no row '{label}'")


def quoted(page):
    def write(match):
        kind, arguments = match.group(1), [part.strip() for part in match.group(2).split("|")]
        return f"<!-- {kind}: {match.group(2)} -->{ {'table': table, 'figure': figure}[kind](*arguments)}<!-- end -->"

    return re.sub(r"<!-- (table|figure): (.*?) -->.*?<!-- end -->", write, page, flags=re.S)


def style_figures():
    """How often default's styles are recognised, as model/flow/checkpoint/style_figures_file.h reads it."""
    weights = re.search(r"^Model default/(\w+),", json.loads((FIGURES / "liveliness.json").read_text())["summary"]).group(1)
    (row,) = rows_of("liveliness", "liveliness_styles_dancedb")
    styles = {"recognised": row["danced"], "chance": row["chance"], "low": row["danced interval"][0]}
    return json.dumps({"weights": weights, "styles": styles}, indent=1) + "\n"


if "--print" in sys.argv:
    for page in sys.argv[sys.argv.index("--print") + 1 :]:
        for quotation in re.findall(r"<!-- table: (.*?) -->", (ROOT / page).read_text()):
            place, *columns = [part.strip() for part in quotation.split("|")]
            print(place + table(place, *columns))
    sys.exit()
wrong = []
quoting = {name: quoted((ROOT / name).read_text()) for name in PAGES}
quoting["model/checkpoints/default.figures.json"] = style_figures()
for name, after in quoting.items():
    if after != (ROOT / name).read_text():
        wrong.append(name)
        if "--check" not in sys.argv:
            (ROOT / name).write_text(after)
if wrong and "--check" in sys.argv:
    sys.exit(f"quote_figures.py: {', '.join(wrong)}: other figures than docs/figures; run scripts/quote_figures.py")
