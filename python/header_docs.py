"""Writes the comments of functions and classes in C++ headers as a table of docstrings: header_docs.py OUT.h HEADER..."""

import re
import sys

# Matches a block of unindented comment lines before the declaration of a function or a class.
BLOCK = re.compile(r"((?:^//.*\n)+)^(?:class|struct)?[^\n(;]*?\b(\w+)(?: final)?(?:\(| \{)", re.MULTILINE)


def docs(text):
    """Yields the name and the comment of each documented declaration of a header."""
    for match in BLOCK.finditer(text):
        lines = [line[2:].removeprefix(" ") for line in match[1].splitlines()]
        yield match[2], "\n".join(lines).strip()


def main():
    out, *headers = sys.argv[1:]
    rows, known = [], set()
    for header in headers:
        with open(header, encoding="utf-8") as file:
            for name, comment in docs(file.read()):
                if name not in known:
                    rows.append(f'    {{"{name}", R"doc({comment})doc"}},\n')
                known.add(name)
    with open(out, "w", encoding="utf-8") as file:
        file.write("// Made by header_docs.py.\n#pragma once\n\nstruct HeaderDoc {\n  const char *name, *text;\n};\n\n")
        file.write("inline constexpr HeaderDoc header_docs[] = {\n" + "".join(rows) + "};\n")


main()
