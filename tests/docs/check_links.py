#!/usr/bin/env python3
"""check_links.py ROOT: every relative link, image and #anchor of the project's Markdown pages leads somewhere."""
import re
import sys
from pathlib import Path
from urllib.parse import unquote

from pages import markdown_pages, without_blocks

LINK = re.compile(r"!?\[[^\]]*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*\s*$")
ELSEWHERE = re.compile(r"^(https?|mailto):")


def anchors_of(page: Path) -> set[str]:
    """The names that GitHub gives to headings."""
    found: set[str] = set()
    for line in without_blocks(page.read_text(encoding="utf-8")).splitlines():
        heading = HEADING.match(line)
        if not heading:
            continue
        shown = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1))
        name = re.sub(r"[^\w\- ]", "", shown.lower()).replace(" ", "-")
        unique, again = name, 0
        while unique in found:
            again += 1
            unique = f"{name}-{again}"
        found.add(unique)
    return found


def faults_of(page: Path) -> list[str]:
    faults = []
    for number, line in enumerate(without_blocks(page.read_text(encoding="utf-8")).splitlines(), 1):
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            if ELSEWHERE.match(target):
                continue
            path, _, anchor = unquote(target).partition("#")
            file = page.parent / path if path else page
            if not file.exists():
                faults.append(f"{page}:{number}: there is no {target}")
            elif anchor and (file.suffix != ".md" or anchor not in anchors_of(file)):
                faults.append(f"{page}:{number}: {file} has no heading #{anchor}")
    return faults


def main() -> int:
    pages = markdown_pages(Path(sys.argv[1]))
    faults = [fault for page in pages for fault in faults_of(page)]
    print("\n".join(faults) if faults else f"the links of {len(pages)} pages lead somewhere")
    return 1 if faults or not pages else 0


sys.exit(main())
