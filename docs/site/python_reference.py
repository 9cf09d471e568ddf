"""This module writes the reference of the Python package from its source, without running it.

Doxygen reads Python, too, but would mix the package crt with C++'s namespace crt, and knows nothing
of what __init__.py makes public. So what `__all__` lists becomes a page of Markdown.
"""

import ast
import pathlib


class Package:
    """A Package is the parsed modules of a package."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.modules = {}
        for path in sorted(folder.glob("*.py")):
            self.modules[path.stem] = ast.parse(path.read_text(), str(path))
        for path in sorted(folder.glob("*.pyi")):  # a stub knows what a module makes as it runs
            self.modules[path.stem] = ast.parse(path.read_text(), str(path))

    def public_names(self) -> list[str]:
        for node in self.modules["__init__"].body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
                return sorted(ast.literal_eval(node.value), key=str.lower)
        raise SystemExit("the Python package has no __all__")

    def find(self, name: str) -> ast.stmt | None:
        """Finds the class, function or value of that name, wherever it is from."""
        for module in self.modules.values():
            for node in module.body:
                if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name == name:
                    return node
                targets = node.targets if isinstance(node, ast.Assign) else []
                if isinstance(node, ast.AnnAssign):
                    targets = [node.target]
                if any(ast.unparse(target) == name for target in targets):
                    return node
        return None

    def is_public(self, name: str) -> bool:
        return not name.startswith("_") or name == "__init__"


def escaped(text: str) -> str:
    """Keeps Doxygen from taking names in prose for its commands."""
    return text.replace("@", "\\@").replace("<", "&lt;").replace("#", "\\#")


def docs_of(node: ast.AST) -> str:
    text = ast.get_docstring(node) if isinstance(node, ast.ClassDef | ast.FunctionDef) else None
    return escaped(text or "")


def code(text: str) -> list[str]:
    return ["```{.py}", text, "```", ""]


def signature(name: str, node: ast.FunctionDef, is_method: bool) -> str:
    arguments = node.args
    is_static = any(ast.unparse(d) == "staticmethod" for d in node.decorator_list)
    if is_method and not is_static and arguments.args:
        arguments.args = arguments.args[1:]
    is_maker = node.name == "__init__"
    result = f" -> {ast.unparse(node.returns)}" if node.returns and not is_maker else ""
    line = f"{name}({ast.unparse(arguments)}){result}"
    if len(line) <= 88:
        return line
    parts = split_arguments(ast.unparse(arguments))
    return name + "(\n" + "".join(f"    {part},\n" for part in parts) + ")" + result


def split_arguments(text: str) -> list[str]:
    parts, depth = [""], 0
    for character in text:
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [part.strip() for part in parts]


def class_lines(package: Package, node: ast.ClassDef) -> list[str]:
    lines = [docs_of(node), ""]
    fields = [
        ast.unparse(item)
        for item in node.body
        if isinstance(item, ast.AnnAssign | ast.Assign)
        and package.is_public(ast.unparse(item).split(":")[0].split(" ")[0])
        and not ast.unparse(item).startswith("reserved")
    ]
    for item in node.body:
        if isinstance(item, ast.FunctionDef) and item.name == "__init__" and len(item.args.args):
            lines += code(signature(node.name, item, True)) + [docs_of(item), ""]
    if fields:
        lines += code("\n".join(fields))
    for item in node.body:
        if not isinstance(item, ast.FunctionDef) or item.name.startswith("_"):
            continue
        decorators = [ast.unparse(decorator) for decorator in item.decorator_list]
        if any(d.endswith((".setter", "overload")) for d in decorators):
            continue
        name = f"{node.name}.{item.name}"
        if "property" in decorators:
            returns = f": {ast.unparse(item.returns)}" if item.returns else ""
            lines += code(name + returns)
        else:
            lines += code(signature(name, item, True))
        lines += [docs_of(item), ""]
    return lines


def reference(folder: pathlib.Path) -> str:
    """Returns the page."""
    package = Package(folder)
    lines = ["# The Python API {#python_api}", "", "[TOC]", ""]
    lines += [escaped(ast.get_docstring(package.modules["__init__"]) or ""), ""]
    for name in package.public_names():
        node = package.find(name)
        if node is None:
            continue
        lines += [f"## {name} {{#python_api--{name}}}", ""]
        if isinstance(node, ast.ClassDef):
            lines += class_lines(package, node)
        elif isinstance(node, ast.FunctionDef):
            lines += code(signature(name, node, False)) + [docs_of(node), ""]
        else:
            lines += code(ast.unparse(node))
    return "\n".join(lines) + "\n"
