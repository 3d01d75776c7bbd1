#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One order of includes: own header, C++ and C, third party, ours; a blank line between groups, each sorted.

    tests/style/includes.py [--fix] [FILE ...]      default: all sources that git knows or would take

Only the first run of includes of a file is looked at; what stands after other code (or inside #if) has its reasons.
Exit status 1 when a file is not in order, or was not.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDERS = ("coxeter", "perturbation", "whitney", "tests", "bench", "examples", "python")
SYSTEM = re.compile(r"<([a-z_0-9]+|(sys/[a-z]+|unistd|fcntl|signal|immintrin|fenv|cxxabi|execinfo|dlfcn|malloc|time|math)\.h)>$")
OURS = re.compile(r'<(coxeter|perturbation|whitney)/|"')
INCLUDE = re.compile(r"#include\s+(\S+)(.*)")


def own_headers(path):
    """The headers that a source may call its own."""
    if path.suffix != ".cc":
        return ()
    stem = path.with_suffix("")
    if stem.parts[0] == "tests":
        stem = pathlib.Path(*stem.parts[1:])
        stem = stem.with_name(re.sub("_test$", "", stem.name))
    return (f"<{stem}.h>", f'"{stem.name}.h"')


def group_of(header, own):
    if header in own:
        return 0
    if SYSTEM.match(header):
        return 1
    return 3 if OURS.match(header) else 2


def in_order(path, text):
    """The text with its first run of includes in order."""
    lines = text.split("\n")
    first = next((i for i, line in enumerate(lines) if INCLUDE.match(line)), None)
    if first is None:
        return text
    last = i = first
    while i < len(lines) and (INCLUDE.match(lines[i]) or not lines[i].strip()):
        if lines[i].strip():
            last = i
        i += 1
    own = own_headers(path)
    groups = ([], [], [], [])
    for line in dict.fromkeys(line for line in lines[first : last + 1] if line.strip()):
        header, rest = INCLUDE.match(line).groups()
        groups[group_of(header, own)].append(header + rest)
    blocks = ["\n".join("#include " + header for header in sorted(group, key=lambda h: (h[0] == '"', h))) for group in groups if group]
    return "\n".join([*lines[:first], "\n\n".join(blocks), *lines[last + 1 :]])


def sources():
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split("\n")
    return [pathlib.Path(f) for f in listed if f.endswith((".h", ".cc")) and f.split("/")[0] in FOLDERS and (ROOT / f).is_file()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fix", action="store_true")
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    files = [pathlib.Path(os.path.relpath(f, ROOT)) for f in arguments.files] or sources()
    status = 0
    for file in files:
        text = (ROOT / file).read_text()
        wanted = in_order(file, text)
        if wanted == text:
            continue
        status = 1
        print(f"{file}: includes are not in order" + (" (mended)" if arguments.fix else ""))
        if arguments.fix:
            (ROOT / file).write_text(wanted)
    return status


if __name__ == "__main__":
    sys.exit(main())
