# SPDX-License-Identifier: MIT
"""Modules use only the modules that the table in docs/architecture.md lets them use.

The table stands between two markers. A row names a module and what it may include: whole modules,
or single headers of one. Rows go from the lowest module to the highest.
"""

import re
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = re.compile(r"<!-- module-table:begin -->(.*)<!-- module-table:end -->", re.DOTALL)
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
MODULE = re.compile(r"gmsim_module\(\s*(\w+)(.*?)\)", re.DOTALL)
SOURCES = ("*.h", "*.cpp", "*.def", "*.ll", "*.yy")


def read_table(root):
    """{module: names it may include}, lowest module first."""
    text = TABLE.search((root / "docs/architecture.md").read_text()).group(1)
    rows = [line.split("|")[1:-1] for line in text.splitlines() if line.startswith("| `")]
    return {re.findall(r"`([^`]+)`", row[0])[0]: re.findall(r"`([^`]+)`", row[1]) for row in rows}


def module_of(name):
    return name.split("/")[0]


def order_complaints(table):
    seen = set()
    for module, allowed in table.items():
        for name in allowed:
            if module_of(name) not in seen:
                yield f"table: {module} -> {name}, which is not below it"
        seen.add(module)


def sources(root, module):
    folders = [root / "interpreter" / module]
    if module == "syntax":
        folders.append(root / "grammar")  # the lexer and the parser belong to it
    for folder in folders:
        for pattern in SOURCES:
            yield from sorted(folder.rglob(pattern))


def include_complaints(root, table):
    for module, allowed in table.items():
        for file in sources(root, module):
            for header in INCLUDE.findall(file.read_text()):
                place = file.relative_to(root)
                target = module_of(header)
                if target in table:
                    if target != module and not {target, header} & set(allowed):
                        yield f"{place}: {module} must not include {header}"
                elif (file.parent / header).exists():  # else it is generated
                    yield f"{place}: name {header} with its module"


def link_complaints(root, table):
    for module, allowed in table.items():
        if not any(sources(root, module)):
            continue  # nothing of it is written yet
        cmake = root / "interpreter" / module / "CMakeLists.txt"
        found = dict(MODULE.findall(cmake.read_text() if cmake.exists() else ""))
        if module not in found:
            yield f"{cmake.relative_to(root)}: no gmsim_module({module} ...)"
            continue
        words = found[module].split()
        linked = set()
        if "DEPENDS" in words:
            for word in words[words.index("DEPENDS") + 1 :]:
                if word.isupper():
                    break
                linked.add(word)
        wanted = {module_of(name) for name in allowed}
        if linked != wanted:
            yield f"{cmake.relative_to(root)}: DEPENDS {sorted(linked)}, the table says {sorted(wanted)}"


def folder_complaints(root, table):
    for folder in sorted((root / "interpreter").iterdir()):
        if folder.is_dir() and folder.name not in table:
            yield f"interpreter/{folder.name}: not in the table"


def complaints(root):
    table = read_table(root)
    return [
        *order_complaints(table),
        *folder_complaints(root, table),
        *include_complaints(root, table),
        *link_complaints(root, table),
    ]


class Arrows(unittest.TestCase):
    def test_this_tree(self):
        self.assertGreater(len(read_table(ROOT)), 5)
        found = complaints(ROOT)
        if found:
            self.fail("\n  ".join(["", *found]))


class ArrowsAreNoticed(unittest.TestCase):
    """A small tree of two modules, broken in one way at a time."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.table("| `low` | | x |", "| `high` | `low/public.h` | x |")
        self.write("interpreter/low/CMakeLists.txt", "gmsim_module(low SOURCES a.cpp LINK fmt)")
        self.write("interpreter/low/a.cpp", '#include "low/a.h"\n#include <vector>\n')
        self.write("interpreter/high/CMakeLists.txt", "gmsim_module(high\n  SOURCES b.cpp\n  DEPENDS low)")
        self.write("interpreter/high/b.cpp", '#include "low/public.h"\n')

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def table(self, *rows):
        lines = ["<!-- module-table:begin -->", *rows, "<!-- module-table:end -->"]
        self.write("docs/architecture.md", "\n".join(lines))

    def assert_one(self, part):
        found = complaints(self.root)
        self.assertEqual(len(found), 1, found)
        self.assertIn(part, found[0])

    def test_a_tree_that_follows_its_table(self):
        self.assertEqual(complaints(self.root), [])

    def test_an_upward_include(self):
        self.write("interpreter/low/a.cpp", '#include "high/b.h"\n')
        self.assert_one("low must not include high/b.h")

    def test_a_private_header_of_a_lower_module(self):
        self.write("interpreter/high/b.cpp", '  #  include "low/a.h"\n')
        self.assert_one("high must not include low/a.h")

    def test_a_header_without_its_module(self):
        self.write("interpreter/low/a.h", "")
        self.write("interpreter/low/a.cpp", '#include "a.h"\n#include "generated.h"\n')
        self.assert_one("name a.h with its module")

    def test_a_link_too_many(self):
        self.write("interpreter/low/CMakeLists.txt", "gmsim_module(low DEPENDS high LINK fmt)")
        self.assert_one("DEPENDS ['high']")

    def test_a_link_too_few(self):
        self.write("interpreter/high/CMakeLists.txt", "gmsim_module(high SOURCES b.cpp)")
        self.assert_one("the table says ['low']")

    def test_a_module_that_is_nowhere(self):
        self.write("interpreter/other/c.cpp", "")
        self.assert_one("interpreter/other: not in the table")

    def test_a_table_with_a_cycle(self):
        self.table("| `low` | `high` | x |", "| `high` | `low` | x |")
        self.write("interpreter/low/CMakeLists.txt", "gmsim_module(low DEPENDS high)")
        self.assert_one("low -> high")


if __name__ == "__main__":
    unittest.main()
