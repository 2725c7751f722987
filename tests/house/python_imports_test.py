"""No module of the Python package imports itself through others, and half of its modules have 90 lines or more.

Usage: python_imports_test.py SOURCE_FOLDER
"""

import ast
import pathlib
import statistics
import sys
import tempfile
import unittest

import house

PACKAGE = pathlib.Path(sys.argv[1]) / "clients/python/src/albtpu"
GENERATED = "albtpu.v1"
MEDIAN_LINES = 90


def modules_in(package):
    """The files of a package by the full names of their modules."""
    return {".".join(path.relative_to(package.parent).with_suffix("").parts).removesuffix(".__init__"): path
            for path in sorted(package.rglob("*.py"))}


def imports_of(name, path, modules):
    """The modules of the package that a module names anywhere: at its top, in functions, under TYPE_CHECKING."""
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in modules)
        elif isinstance(node, ast.ImportFrom):
            above = package.rsplit(".", node.level - 1)[0] if node.level else ""
            base = ".".join(filter(None, (above, node.module)))
            for alias in node.names:
                yield from [found for found in (f"{base}.{alias.name}", base) if found in modules][:1]


def circle_in(package):
    """Modules of which each is imported by the next, and the first is the last; None if there are none."""
    modules = modules_in(package)
    return house.circle_in({name: set(imports_of(name, path, modules)) for name, path in modules.items()})


class Imports(unittest.TestCase):
    def test_have_no_circle(self):
        self.assertIsNone(circle_in(PACKAGE))

    def test_have_a_circle_where_one_is_planted(self):
        for files, circle in (
                ({"a.py": "from .b import x", "b.py": "def f():\n    from . import a"}, {"p.a", "p.b"}),
                ({"a.py": "if TYPE_CHECKING:\n    from p.inside.b import x", "inside/b.py": "from ..c import x",
                  "c.py": "import p.a"}, {"p.a", "p.inside.b", "p.c"}),
                ({"__init__.py": "from .a import x", "a.py": "from . import x"}, {"p", "p.a"}),
                ({"__init__.py": "from .a import x", "a.py": "from . import b", "b.py": "import os, numpy.c"}, None)):
            with tempfile.TemporaryDirectory() as folder:
                for name, text in files.items():
                    path = pathlib.Path(folder, "p", name)
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_text(text)
                found = circle_in(pathlib.Path(folder, "p"))
                self.assertEqual(found and set(found), circle, files)


class Modules(unittest.TestCase):
    def test_are_no_slivers(self):
        lines = {name: len(path.read_text(encoding="utf-8").splitlines()) for name, path in modules_in(PACKAGE).items()
                 if not name.startswith(GENERATED)}
        self.assertGreaterEqual(statistics.median(lines.values()), MEDIAN_LINES, lines)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
