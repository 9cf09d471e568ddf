"""This module turns the pages of docs/ into what Doxygen 1.9 understands.

On disk and at a host of repositories, links between pages are relative, and headings have anchors
by their texts. Doxygen's anchors are explicit and one set for all pages. So every heading gets one
that begins with its page's name, and links are rewritten.
"""

import os
import pathlib
import re
from dataclasses import dataclass

FENCE = re.compile(r"^ *(```|~~~)")
HEADING = re.compile(r"^(#{1,6}) +(.*?)\s*$")
LINK = re.compile(r"(!?)\[((?:[^\]\[`]|`[^`]*`)*)\]\(([^)\s]+)\)")
LINK_OR_CODE = re.compile(rf"`[^`\n]*`|{LINK.pattern}")
IMAGE_TAG = re.compile(r'<img src="([^"]+)" alt="([^"]*)">')
SUMMARY = re.compile(r"<details><summary>(?:<a[^>]*>)?([^<]*)(?:</a>)?</summary>")


def slug(heading: str) -> str:
    """Returns the anchor of a heading as hosts of repositories make it."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


@dataclass(frozen=True)
class Line:
    text: str
    is_code: bool


def lines_of(text: str) -> list[Line]:
    """Says of each line whether it is in, or begins or ends, a block of code."""
    result = []
    inside = False
    for line in text.splitlines():
        fence = FENCE.match(line) is not None
        result.append(Line(line, inside or fence))
        inside ^= fence
    return result


def anchors(text: str) -> dict[str, str]:
    """Returns the headings of a page by their anchors. Equal ones get -1, -2, ..."""
    found: dict[str, str] = {}
    for line in lines_of(text):
        heading = HEADING.match(line.text)
        if line.is_code or not heading:
            continue
        base = name = slug(heading[2])
        count = 0
        while name in found:
            count += 1
            name = f"{base}-{count}"
        found[name] = heading[2]
    return found


def links(text: str) -> list[tuple[str, bool]]:
    """Returns the targets of all links and pictures of a page, and whether it is a picture."""
    prose = re.sub(r"`[^`\n]*`", "", "\n".join("" if l.is_code else l.text for l in lines_of(text)))
    found = [(match[3], match[1] == "!") for match in LINK.finditer(prose)]
    found += [(match[1], True) for match in IMAGE_TAG.finditer(prose)]
    return found + [(target, False) for target in re.findall(r'<a href="([^"]+)"', prose)]


def is_outside(target: str) -> bool:
    return re.match(r"[a-z]+:", target) is not None


def code_span(span: str) -> str:
    """Returns a span of code as Doxygen wants it, which looks for quotes and commands in there."""
    if not re.search(r"[\"'\\@]", span):
        return span
    text = span[1:-1].replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    text = text.replace("\\", "\\\\").replace("@", "\\@").replace("#", "\\#")
    return "<code>" + text.replace('"', "&quot;").replace("'", "&apos;") + "</code>"


def page_name(path: pathlib.PurePath) -> str:
    """Returns the label of a page: docs/design/speed.md is design_speed."""
    parts = path.with_suffix("").parts
    if parts == ("README",):
        return "project"
    return "_".join(parts[1:] if parts[0] == "docs" else parts).lower()


def source_name(path: pathlib.PurePath) -> str:
    """Returns the label of the page that shows a file or folder which is no page itself."""
    return "source_" + re.sub(r"\W", "_", str(path))


def resolve(page: pathlib.PurePath, target: str) -> tuple[pathlib.PurePath, str]:
    """Returns the file in the project that a link means, and its anchor."""
    file, _, anchor = target.partition("#")
    path = os.path.normpath(page.parent / file) if file else str(page)
    return pathlib.PurePath(path), anchor


class Converter:
    """A Converter turns pages into Doxygen's, and remembers what else they link to."""

    def __init__(self, root: pathlib.Path, pages: list[pathlib.PurePath]) -> None:
        self.root = root
        self.pages = set(pages)
        self.sources: set[pathlib.PurePath] = set()
        self.images: set[pathlib.PurePath] = set()

    def convert(self, page: pathlib.PurePath, text: str) -> str:
        name = page_name(page)
        names = iter(anchors(text))
        result = []
        prose: list[str] = []
        first = True

        def flush() -> None:
            result.append(self._prose(page, "\n".join(prose)))
            prose.clear()

        for line in lines_of(text):
            heading = None if line.is_code else HEADING.match(line.text)
            if heading:
                label = name if first else f"{name}--{next(names)}"
                if first:
                    next(names)
                title = heading[2].replace("`", "")  # Doxygen shows them as tags
                prose.append(f"{heading[1]} {title} {{#{label}}}")
                if first:
                    prose += ["", "[TOC]"]
                first = False
            elif line.is_code:
                if prose:
                    flush()
                result.append(re.sub(r"^( *```)(\w+)$", r"\1{.\2}", line.text))
            else:
                prose.append(line.text)
        flush()
        return "\n".join(result) + "\n"

    def _prose(self, page: pathlib.PurePath, text: str) -> str:
        text = re.sub(r"^<!--.*?-->$", "", text, flags=re.MULTILINE | re.DOTALL)
        text = IMAGE_TAG.sub(lambda match: self._image(page, match[1], match[2]), text)
        # What stands in backquotes is left alone; links may go over several lines.
        text = LINK_OR_CODE.sub(
            lambda m: code_span(m[0]) if m[0][0] == "`" else self._link(page, m), text
        )
        text = SUMMARY.sub(r"@htmlonly<details><summary>\1</summary>@endhtmlonly", text)
        return text.replace("</details>", "@htmlonly</details>@endhtmlonly")

    def _link(self, page: pathlib.PurePath, match: re.Match[str]) -> str:
        one_line, target = match[2].replace("\n", " "), match[3]
        if match[1]:
            return self._image(page, target, one_line.replace('"', "&quot;"))
        if is_outside(target):
            return match[0]
        path, anchor = resolve(page, target)
        if path in self.pages:
            label = page_name(path) + (f"--{anchor}" if anchor else "")
        elif path.parts[:2] == ("include", "crt") and path.suffix:
            label = path.name
        else:
            self.sources.add(path)
            label = source_name(path)
        return f"[{one_line}](@ref {label})"

    def _image(self, page: pathlib.PurePath, target: str, alt: str) -> str:
        path, _ = resolve(page, target)
        self.images.add(path)
        return f'<img src="{image_name(path)}" alt="{alt}">'


def image_name(path: pathlib.PurePath) -> str:
    """Returns where the site keeps a picture."""
    return "/".join(path.parts[1:] if path.parts[0] == "docs" else path.parts)
