"""Reads docs/tables*.md, and writes tables that quote them: for quote_figures.py."""
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
missing = set()  # what was asked for and stands nowhere


def read_tables(page):
    """{title: {row's labels: {column: cell}}} of a page of docs/; none of one that is not there."""
    path = ROOT / "docs" / page
    tables, columns, title = {}, [], ""
    for line in path.read_text().splitlines() if path.exists() else []:
        if line.startswith("### "):
            title, columns = line[4:], []
            tables[title] = {}
        elif line.startswith("|") and not columns:
            columns = [cell.strip() for cell in line.strip("|").split("|")]
        elif line.startswith("|:"):
            labels = sum(rule.startswith(":") for rule in line.strip("|").split("|"))
        elif line.startswith("|"):
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            tables[title][tuple(cells[:labels])] = dict(zip(columns[labels:], cells[labels:]))
    return tables


def quoted(tables, title, labels, column):
    """The cell as it stands, with its interval; a dash where there is none."""
    text = tables.get(title, {}).get(tuple(labels), {}).get(column)
    if text is None:
        missing.add(f"{title}: {', '.join(labels)}: {column}")
    return text or "–"


def figure(tables, title, labels, column):
    text = quoted(tables, title, labels, column)
    try:
        return float(text.split(" ")[0])
    except ValueError:  # a dash
        return None


def show(value, digits=2, reached=lambda value: True, unit=""):
    if value is None:
        return "–"
    text = f"{value:,.{digits}f}{unit}"
    return text if reached(value) else f"**{text}**"


def over(above, below):
    return above / below if above is not None and below else None


def table(head, rows):
    lines = [head, [" --- "] * len(head)] + rows
    return "\n\n" + "\n".join("|" + "|".join(cell if cell == " --- " else f" {cell} " for cell in line) + "|" for line in lines) + "\n\n"
