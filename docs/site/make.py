#!/usr/bin/env python3
"""Makes the documentation's site: ./dev docs runs it from the top of the project.

    docs/site/make.py FOLDER

Pages of docs/ and the reference of the Python package become pages for Doxygen in FOLDER/pages.
Doxygen then makes FOLDER/html of them and of the public headers. Its navigation has the parts of
docs/README.md. What Doxygen objects to is an error.
"""

import pathlib
import re
import shutil
import subprocess
import sys

import markdown
import python_reference

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYTHON_PACKAGES = ["python/crt", "examples/python/crt"]  # the first that exists

# What a user can see and nothing explains is a fault, but a plain field needs no comment of its
# own, as its struct's often says all. Nor does a default comparison.
UNDOCUMENTED = re.compile(r"(\(variable\) of struct|operator==.*=default) .*is not documented")


def page_files() -> list[pathlib.PurePath]:
    files = [*ROOT.glob("docs/*.md"), *ROOT.glob("docs/*/*.md"), *ROOT.glob("*.md")]
    return sorted(pathlib.PurePath(file.relative_to(ROOT)) for file in files)


def source_page(converter: markdown.Converter, path: pathlib.PurePath) -> str:
    """Returns the page that shows a file, or lists a folder's."""
    file = ROOT / path
    lines = [f"# {path} {{#{markdown.source_name(path)}}}", ""]
    if file.is_dir():
        for item in sorted(file.iterdir()):
            inner = path / item.name
            if item.is_file() and item.suffix in {".c", ".cpp", ".py", ".rs", ".crt", ".hpp"}:
                converter.sources.add(inner)
                lines.append(f"- [{item.name}](@ref {markdown.source_name(inner)})")
    else:
        language = path.suffix if path.suffix in {".c", ".cpp", ".hpp", ".py"} else ".txt"
        lines += [f"~~~~{{{language}}}", file.read_text().rstrip("\n"), "~~~~"]
    return "\n".join(lines) + "\n"


def write_pages(folder: pathlib.Path) -> markdown.Converter:
    converter = markdown.Converter(ROOT, page_files())
    for page in page_files():
        text = converter.convert(page, (ROOT / page).read_text())
        (folder / f"{markdown.page_name(page)}.md").write_text(text)
    package = next(path for path in PYTHON_PACKAGES if (ROOT / path / "__init__.py").exists())
    (folder / "python_api.md").write_text(python_reference.reference(ROOT / package))
    done: set[pathlib.PurePath] = set()
    while converter.sources - done:
        for path in sorted(converter.sources - done):
            page_path = folder / f"{markdown.source_name(path)}.md"
            page_path.write_text(source_page(converter, path))
            done.add(path)
    return converter


def navigation() -> str:
    """Returns the navigation: the parts and links of docs/README.md, in its order."""
    readme = pathlib.PurePath("docs/README.md")
    text = (ROOT / readme).read_text()
    parts: list[tuple[str, list[str]]] = []
    for line in text.splitlines():
        heading = re.match(r"## (.*)|\*\*(.*?)\*\*", line)
        if heading:
            parts.append((heading[1] or heading[2], []))
        for target in re.findall(r"^- \[[^\]]*\]\(([^)#]+)\)", line):
            path, _ = markdown.resolve(readme, target)
            title = markdown.HEADING.match((ROOT / path).read_text().splitlines()[0])
            parts[-1][1].append(tab(title[2] if title else target, markdown.page_name(path)))
    groups = [
        f'<tab type="usergroup" visible="yes" title="{title}">{"".join(tabs)}</tab>'
        for title, tabs in parts
        if tabs
    ]
    code = (
        '<tab type="usergroup" visible="yes" title="C++, C and Python">'
        + tab("The C++ API", "api")
        + '<tab type="modules" visible="yes" title="The C API, by subject" intro=""/>'
        + tab("The Python API", "python_api")
        + '<tab type="classlist" visible="yes" title="Types" intro=""/>'
        + tab("Functions and values", "crt")
        + '<tab type="filelist" visible="yes" title="Headers" intro=""/></tab>'
    )
    return (
        '<navindex><tab type="mainpage" visible="yes" title="CRT"/>'
        + "".join(groups[:2]) + code + "".join(groups[2:]) + "</navindex>"
    )


PYTHON_NAME = re.compile(r'<a class="[^"]*" href="[^"]*"[^>]*>(crt\.(\w+)[^<]*)</a>')


def lead_python_names_home(folder: pathlib.Path) -> None:
    """Makes links by names as crt.Image, which Doxygen takes for crt::Image, lead to Python's."""
    anchors = set(re.findall(r'id="(python_api--\w+)"', (folder / "python_api.html").read_text()))

    def link(match: re.Match[str]) -> str:
        anchor = f"python_api--{match[2]}"
        if anchor not in anchors:
            return match[1]
        return f'<a class="el" href="python_api.html#{anchor}">{match[1]}</a>'

    for file in folder.glob("*.html"):
        text = file.read_text()
        changed = PYTHON_NAME.sub(link, text)
        if changed != text:
            file.write_text(changed)


def tab(title: str, label: str) -> str:
    plain = re.sub(r"[`*]", "", title).replace("&", "&amp;")
    return f'<tab type="user" visible="yes" url="@ref {label}" title="{plain}"/>'


def write_layout(file: pathlib.Path) -> None:
    subprocess.run(["doxygen", "-l", file], check=True, stdout=subprocess.DEVNULL)
    before, rest = file.read_text().split("<navindex>")
    file.write_text(before + navigation() + rest.split("</navindex>")[1])


def main(folder: pathlib.Path) -> int:
    shutil.rmtree(folder, ignore_errors=True)
    pages = folder / "pages"
    pages.mkdir(parents=True)
    converter = write_pages(pages)
    write_layout(folder / "layout.xml")
    settings = (ROOT / "docs/Doxyfile").read_text().replace("build/docs", str(folder))
    subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True)
    lead_python_names_home(folder / "html")
    missing = [image for image in sorted(converter.images) if not (ROOT / image).is_file()]
    for image in converter.images - set(missing):
        target = folder / "html" / markdown.image_name(image)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / image, target)
    warnings = (folder / "warnings").read_text().splitlines()
    objections = [line for line in warnings if not UNDOCUMENTED.search(line)]
    objections += [f"there is no picture {image}" for image in missing]
    print("".join(f"{line}\n" for line in objections), end="", file=sys.stderr)
    if objections:
        print("docs: the above is not as Doxygen understands it", file=sys.stderr)
    return 1 if objections else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
