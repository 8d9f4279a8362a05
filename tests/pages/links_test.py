#!/usr/bin/python3
"""Links and pictures of pages lead somewhere; pages and pictures are no longer than somebody in a hurry reads."""

import re
import subprocess
import unittest

from pages import ROOT, anchors, links, pages

# References, which are looked up and not read: rows, one entry after the other, or written by a program.
LOOKED_UP = {"docs/api.md", "docs/decisions.md", "docs/papers.md", "docs/papers_ablations_c.md", "docs/reliability.md"}
# Five minutes, and what a start page may take of them.
WORDS, START_WORDS = 900, 450
PICTURES = 1_150_000
FILM = 4 << 20


class PagesTest(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in pages():
            text = (ROOT / page).read_text()
            for link in links(text):
                if "://" in link or link.startswith("mailto:"):
                    continue
                with self.subTest(page=page, link=link):
                    path, _, anchor = link.partition("#")
                    target = (ROOT / page).parent / path if path else ROOT / page
                    self.assertTrue(target.exists(), "there is no such file")
                    self.assertTrue(target.resolve().is_relative_to(ROOT), "leads out of the repository")
                    if anchor and target.suffix == ".md":
                        self.assertIn(anchor, anchors(target.read_text()))
                    elif anchor:
                        self.assertLessEqual(int(anchor.removeprefix("L")), len(target.read_text().splitlines()))

    def test_files_in_code_exist(self):
        """`model/dance/validation` and the like: files, folders, or a header with its source."""
        for page in pages():
            for name in re.findall(r"`((?:bench|client|docker|docs|examples|model|proto|scripts|server|network|studio|tests)/[\w./]+)`", (ROOT / page).read_text()):
                with self.subTest(page=page, name=name):
                    self.assertTrue(any((ROOT / (name + end)).exists() for end in ("", ".h", ".cpp", ".sh", ".py")), "there is no such file")

    def test_files_in_comments_exist(self):
        """From the root, from model/, or in the file's own folder; others' headers are not ours."""
        others = {"asm/prctl.h", "torch/torch.h"}
        for name in subprocess.run(["git", "ls-files", "*.h", "*.cpp", "*.proto"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split():
            comments = "\n".join(re.findall(r"//.*", (ROOT / name).read_text()))
            for path in set(re.findall(r"(?<![\w/.-])((?:[a-z_]+/)+[a-z_]+\.(?:h|cpp|proto|py|sh|md))\b", comments)) - others:
                with self.subTest(file=name, path=path):
                    self.assertTrue(any((folder / path).exists() for folder in (ROOT, ROOT / "model", (ROOT / name).parent)), "there is no such file")

    def test_every_page_is_led_to(self):
        led_to = {((ROOT / page).parent / link.partition("#")[0]).resolve() for page in pages() for link in links((ROOT / page).read_text())}
        for page in pages():
            if page not in ("README.md", "bench/notes.md"):  # which is part of performance.md
                self.assertTrue({ROOT / page, (ROOT / page).parent} & led_to, f"no page leads to {page}")

    def test_every_picture_is_shown(self):
        led_to = {((ROOT / page).parent / link).resolve() for page in pages() for link in links((ROOT / page).read_text())}
        for picture in (ROOT / "docs/images").iterdir():
            self.assertIn(picture, led_to, f"no page shows {picture.name}")

    def test_pages_are_read_in_five_minutes(self):
        for page in pages():
            if page not in LOOKED_UP:
                words = len(re.sub("<!--.*?-->", "", (ROOT / page).read_text()).split())
                limit = START_WORDS if page in ("README.md", "client/node/README.md", "client/python/README.md") else WORDS
                self.assertLessEqual(words, limit, f"{page} is too long")

    def test_decisions_take_a_hundred_words_and_experiments_fifty(self):
        places, titles, texts = {}, {}, []
        for path in sorted((ROOT / "docs/decisions").iterdir()):
            for record in re.split(r'\n\n(?=<a id="\d+">)', path.read_text())[1:]:
                number, title, text = re.fullmatch(r'<a id="(\d+)"></a>\*\*\1\. (.*?)\*\*(.*)', record.strip(), flags=re.S).groups()
                self.assertLessEqual(len((title + text).split()), 101, record)
                self.assertNotIn(number, places, "a number is there twice")
                places[number], titles[number] = f"decisions/{path.name}#{number}", " ".join(title.split()).rstrip(".")
                texts.append(title + text)
        index = re.findall(r"^\| \[(\d+)\]\((.*?)\) \| (.*?) \| .+ \|$", (ROOT / "docs/decisions.md").read_text(), flags=re.M)
        self.assertEqual(sorted(index), sorted((number, places[number], titles[number]) for number in places), "the index has each decision")
        rows = [row for row in (ROOT / "docs/experiments.md").read_text().splitlines() if row.startswith("| ")]
        self.assertGreater(len(rows), 10)
        for row in rows:
            self.assertLessEqual(len(row.replace("|", "").split()), 50, row)
        tried = " ".join(row.split("|")[1] for row in rows)
        named = re.findall(r"(?:decision|see) (\d+)", " ".join(texts)) + re.findall(r"\((\d+)\)", tried)
        self.assertLessEqual(set(named), set(places), "there is no such decision")

    def test_pictures_are_quick_to_fetch(self):
        self.assertLess(sum(picture.stat().st_size for picture in (ROOT / "docs/images").iterdir()), PICTURES)
        for film in (ROOT / "docs/films").iterdir():
            self.assertLess(film.stat().st_size, FILM, film.name)


unittest.main()
