"""The pages that people read: their fenced commands, links and anchors."""

import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]


def pages():
    """All pages, as paths from the root."""
    found = []
    for folder, inside, files in os.walk(ROOT):
        inside[:] = [name for name in inside if name not in ("build", "node_modules", "out") and not name.startswith(".")]
        found += [str((pathlib.Path(folder) / name).relative_to(ROOT)) for name in files if name.endswith(".md")]
    return sorted(found)


def fences(text):
    """(line number, language, lines) of each fenced block."""
    block = None
    for number, line in enumerate(text.splitlines(), 1):
        if block is None and line.lstrip().startswith("```"):
            block = (number + 1, line.strip().strip("`"), [])
        elif block is not None and line.strip() == "```":
            yield block
            block = None
        elif block is not None:
            block[2].append(line)


def without_fences(text):
    return re.sub(r"^ *```.*?^ *```$", "", text, flags=re.S | re.M)


def anchors(text):
    """What GitHub calls the headings of a page."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", without_fences(text), flags=re.M):
        name = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        found.add(name if name not in found else f"{name}-1")
    return found | set(re.findall(r'<a (?:name|id)="([^"]+)"', text))


def links(text):
    """Targets of links and pictures, without those in code."""
    plain = re.sub(r"`[^`\n]*`", "", without_fences(text))
    return re.findall(r"!?\[[^\]]*\]\(([^)\s]+)\)", re.sub(r"!\[[^\]]*\]\(([^)\s]+)\)", r"[](\1)", plain))
