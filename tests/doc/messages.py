# SPDX-License-Identifier: GPL-2.0-or-later
"""The messages of the sources: the literal parts of what a person may be told when something cannot be."""
import ast
import glob
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LEAST = 12      # characters of a part that counts: shorter ones are names and units
NAMES = re.compile(r"const char\* name\b|Ogden of two")     # of laws, which are no messages
CPP = r'"((?:[^"\\]|\\.)*)"'


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8", errors="replace") as file:
        return file.read()


def files(*patterns):
    return sorted(os.path.relpath(path, ROOT) for pattern in patterns for path in glob.glob(os.path.join(ROOT, pattern)))


def statements():
    """Of each statement with a message: (file, its parts of some length)."""
    found = [(path, parts) for path in files("pkg/core/*/*.[ch]pp", "pkg/yade/*.[ch]pp") for parts in _of_cpp(read(path))]
    found += [(path, parts) for path in files("py/*.py", "examples/*.py") for parts in _of_python(read(path))]
    return [(path, _long(parts)) for path, parts in found if _long(parts)]


def literals():
    """All strings of the sources that a message could hold, those of names aside."""
    cpp = files("pkg/*/*/*.[ch]pp", "pkg/yade/*.[ch]pp", "pkg/abi/lib/*/*.hpp")
    found = [part for path in cpp for parts in _of_cpp(read(path)) for part in parts]
    found += [node.value for path in files("py/*.py", "examples/*.py") for node in ast.walk(ast.parse(read(path)))
              if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    return set(_long(found))


def page():
    """The messages that doc/troubleshooting.md explains: all code in its lists, and that with which a point begins."""
    points = re.findall(r"^- (.*(?:\n  .*)*)", read("doc/troubleshooting.md"), re.M)
    codes = [["".join(two) for two in re.findall(r"``(.+?)``|`([^`]+)`", point)] for point in points]
    return [code for of_point in codes for code in of_point], [of_point[0] for of_point in codes]


def _long(parts):
    """Those that count."""
    return [part.strip() for part in parts if len(part.strip()) >= LEAST and " " in part.strip()]


def _of_cpp(text):
    """The string literals of each statement, those beside each other as one, outside docstrings of classes."""
    text = re.sub(r"^\s*(//|#).*$", "", text, flags=re.M)
    text = re.sub(r"static_assert\(.*?\);|YADE_CLASS_BASE_DOC.*?\);\n(?=\s*REGISTER|\n|\s*private|\};)", "", text, flags=re.S)
    for statement in re.findall(r'(?:"(?:[^"\\]|\\.)*"|[^;{}"])+', text):
        groups = re.findall(r'"(?:[^"\\]|\\.)*"(?:\s*"(?:[^"\\]|\\.)*")*', statement)
        if groups and not NAMES.search(statement):
            yield ["".join(re.findall(CPP, group)).replace('\\"', '"') for group in groups]


def _of_python(text):
    """The strings of each raise and sys.exit; a KeyError is for who writes code."""
    for node in ast.walk(ast.parse(text)):
        raised = isinstance(node, ast.Raise) and "KeyError" not in ast.unparse(node)
        if raised or isinstance(node, ast.Call) and ast.unparse(node.func) == "sys.exit":
            yield [text for part in ast.walk(node) if isinstance(part, ast.Constant) and isinstance(part.value, str)
                   for text in part.value.split("{}")]
