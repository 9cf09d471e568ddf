#!/usr/bin/env python3
"""Checks links: of the pages as they are on disk, and of the site that was made of them.

    docs/site/check.py SITE

SITE is the folder html that ./dev docs leaves. Every link, anchor and picture inside of the project
must exist. Nothing that a page needs may come from the network. Prints what is wrong, and how much
was checked.
"""

import html.parser
import pathlib
import re
import sys
import urllib.parse

import markdown
from make import ROOT, page_files


class Page(html.parser.HTMLParser):
    """A Page is what a file of the site defines and refers to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.needs: list[str] = []  # pictures, styles, scripts
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        named = dict(attributes)
        self.anchors.update(value for key in ("id", "name") if (value := named.get(key)))
        if tag in {"a", "area"} and (target := named.get("href")):
            self.links.append(target)
        if tag in {"img", "script", "iframe"} and (target := named.get("src")):
            self.needs.append(target)
        if tag == "link" and (target := named.get("href")):
            self.needs.append(target)


# What is left of Markdown or of Doxygen's commands where one of them was not understood.
RESIDUES = re.compile(r"@ref\b|@htmlonly|@endhtmlonly|\{#|```|^## ", re.MULTILINE)


def residues(text: str) -> list[str]:
    prose = re.sub(r"<(pre|code)\b.*?</\1>|<div class=\"line\">.*?</div>", "", text, flags=re.S)
    return RESIDUES.findall(prose) + re.findall(r"&lt;/tt&gt;|@endcode|@section ", text)


def menu_targets(site: pathlib.Path) -> list[str]:
    """Returns where the navigation tree and the search lead, which scripts make from data."""
    found = []
    scripts = [file for file in site.glob("*.js") if not file.name.startswith("navtreeindex")]
    for script in [*scripts, *site.glob("search/*_*.js")]:
        prefix = "search/" if script.parent.name == "search" else ""
        for target in re.findall(r"[\"']([\w./-]+\.html(?:#[^\"']*)?)[\"']", script.read_text()):
            found.append(prefix + target)
    return found


def site_faults(site: pathlib.Path) -> tuple[list[str], int]:
    pages = {file.name: Page(file.read_text()) for file in sorted(site.glob("*.html"))}
    faults, count = [], 0

    def check(place: str, target: str) -> None:
        file, _, anchor = urllib.parse.unquote(target).partition("#")
        path = pathlib.PurePath(file or place)
        normal = (site / path).resolve()
        if not normal.is_file():
            faults.append(f"{place}: {target} is not there")
        elif anchor and normal.name in pages and anchor not in pages[normal.name].anchors:
            faults.append(f"{place}: {target} has no such anchor")

    for name, page in pages.items():
        left = residues((site / name).read_text())
        if left:
            faults.append(f"{name}: a reader sees {left[0]!r}")
        for target in page.links + page.needs:
            if target == "javascript:void(0)":
                continue
            if markdown.is_outside(target):
                if target in page.needs or target.startswith("file:"):
                    faults.append(f"{name}: needs {target}")
                continue
            count += 1
            check(name, target)
    for target in menu_targets(site):
        count += 1
        # Doxygen lists values of C's enumerations that need no comment without an anchor of their
        # own. The tree then leads to the top of the right page.
        target = re.sub(r"^(group__\w+\.html)#gga\w+$", r"\1", target)
        check("the menu", target.removeprefix("search/../").removeprefix("search/"))
    return faults, count


def disk_faults() -> tuple[list[str], int]:
    texts = {page: (ROOT / page).read_text() for page in page_files()}
    faults, count = [], 0
    for page, text in texts.items():
        for target, _ in markdown.links(text):
            if markdown.is_outside(target):
                continue
            count += 1
            path, anchor = markdown.resolve(page, target)
            if not (ROOT / path).exists():
                faults.append(f"{page}: {target} is not there")
            elif anchor and anchor not in markdown.anchors(texts.get(path, "")):
                faults.append(f"{page}: {target} has no such anchor")
    return faults, count


def main(site: pathlib.Path) -> int:
    on_disk, disk_count = disk_faults()
    in_site, site_count = site_faults(site.resolve())
    for fault in on_disk + in_site:
        print(fault, file=sys.stderr)
    print(f"{disk_count} links of pages on disk and {site_count} of the site: checked")
    if disk_count < 100 or site_count < 1000:
        print("too few to be all", file=sys.stderr)
        return 1
    return 1 if on_disk or in_site else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
