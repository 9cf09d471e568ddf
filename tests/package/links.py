"""Follows the relative links of Markdown pages, and prints those that lead nowhere.

usage: links.py PAGE_OR_FOLDER...
"""

import re
import sys
from pathlib import Path
from urllib.parse import unquote


def without_code(text):
    """Returns the text without its code, which may look like links."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def links(page):
    text = without_code(page.read_text())
    yield from re.findall(r"\]\(([^)\s]+)\)", text)
    yield from re.findall(r"""(?:src|href)=["']([^"']+)""", text)


def anchors(page):
    """Returns the names that a page's headings get, as GitHub makes them."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    names = set(re.findall(r"""(?:id|name)=["']([^"']+)""", text))
    for heading in re.findall(r"^#+ +(.*)$", text, flags=re.MULTILINE):
        shown = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        names.add(re.sub(r"[^\w\- ]", "", shown).strip().replace(" ", "-"))
    return names


def is_dead(page, link):
    if re.match(r"[a-z]+:", link):
        return False
    path, _, anchor = link.partition("#")
    target = page.parent / unquote(path) if path else page
    if not target.exists():
        return True
    return bool(anchor) and target.suffix == ".md" and anchor not in anchors(target)


def main(places):
    pages = []
    for place in map(Path, places):
        pages += sorted(place.rglob("*.md")) if place.is_dir() else [place]
    dead = [(page, link) for page in pages for link in links(page) if is_dead(page, link)]
    for page, link in dead:
        print(f"{page}: {link} leads nowhere", file=sys.stderr)
    return 1 if dead or not pages else 0


sys.exit(main(sys.argv[1:]))
