"""What the tests of the documentation share: the project's Markdown pages and their fenced blocks."""
import re
from dataclasses import dataclass
from pathlib import Path

FENCE = re.compile(r"^\s*```(\w*)\s*$")


def markdown_pages(root: Path) -> list[Path]:
    skipped = re.compile(r"^(build.*|results|\..*)$")
    return sorted(
        page
        for page in root.rglob("*.md")
        if not any(skipped.match(part) for part in page.relative_to(root).parts[:-1])
    )


@dataclass
class Block:
    language: str
    text: str
    line: int  # of its fence
    before: str  # last line before the fence that is not empty


def fenced_blocks(text: str) -> list[Block]:
    blocks: list[Block] = []
    last, inside = "", None
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if inside is not None:
            if fence:
                blocks.append(inside)
                inside, last = None, "```"
            else:
                inside.text += line + "\n"
        elif fence:
            inside = Block(fence.group(1), "", number, last)
        elif line.strip():
            last = line.strip()
    if inside is not None:
        raise ValueError(f"the block that begins in line {inside.line} has no end")
    return blocks


def without_blocks(text: str) -> str:
    """The text with fenced blocks as empty lines."""
    lines, inside = [], False
    for line in text.splitlines():
        fence = FENCE.match(line)
        lines.append("" if inside or fence else line)
        if fence:
            inside = not inside
    return "\n".join(lines)
