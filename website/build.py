"""Build the documentation site, offline: python website/build.py, then open build/website/site/index.html.

The pages are those of docs/, the README as the first page, and the project's other documents. The references of the command
line, of task files and of the Python names are written from the code. A link to a file that is no page becomes the file's
path. A link to nothing ends the build, and so does any warning of the generator.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE), str(ROOT / "src")]

import tomllib  # noqa: E402

from reference import api_pages, command_line, task_file  # noqa: E402

PROJECT = ("CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "CODE_OF_CONDUCT.md")
SCRIPTS = "examples/scripts.md"
ELSEWHERE = {name: name for name in PROJECT} | {
    "examples/README.md": SCRIPTS,
    "benchmarks/README.md": "benchmarks/scripts.md",
    "benchmarks/peers/README.md": "benchmarks/peers/scripts.md",
    "benchmarks/peers/SETTINGS.md": "benchmarks/peers/settings.md",
}
"""Documents outside docs/, and their places on the site; README.md would be the index of its section."""
SHIM = "https://unpkg.com/iframe-worker/shim"
"""What the theme's search takes from elsewhere where a page is a file; the copy in assets/ stands in for it."""
EXTERNAL = re.compile(r"""<(?:script|link|img|iframe)[^>]*(?:src|href)="?(https?://[^" >]+)""")
NOTEBOOKS = ROOT / "examples" / "notebooks"
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
FENCE = re.compile(r"(^```.*?^```[^\n]*$)", re.DOTALL | re.MULTILINE)
CODE = re.compile(r"(`[^`]+`)")
TIGHT_LIST = re.compile(r"^((?![-*] |[#|\s]|\d+\. ).+\n)(?=- |1\. )", re.MULTILINE)
"""A list right after a paragraph: a forge shows a list, the generator only after an empty line."""

MATHS = re.compile(r"^\$\$\n(.*?)\n\$\$$", re.DOTALL | re.MULTILINE)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "website", help="directory to write")
    out = parser.parse_args().out.resolve()
    write_pages(out)
    command = [
        sys.executable,
        "-m",
        "zensical",
        "build",
        "--strict",
        "--clean",
        "--config-file",
        str(out / "zensical.toml"),
    ]
    done = subprocess.run(command, cwd=out, check=False)
    if done.returncode:
        sys.exit(done.returncode)
    keep_offline(out / "site")
    size = sum(path.stat().st_size for path in (out / "site").rglob("*") if path.is_file())
    print(f"{out / 'site' / 'index.html'}: {len(list((out / 'site').rglob('*.html')))} pages, {size / 1e6:.1f} MB")


def keep_offline(site: Path) -> None:
    """Let pages take the search's script from the site; end the build if one takes anything from elsewhere."""
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        text = text.replace(SHIM, os.path.relpath(site / "assets" / "iframe-worker.js", page.parent))
        if found := EXTERNAL.search(text):
            raise SystemExit(f"{page.relative_to(site)}: takes {found.group(1)} from elsewhere")
        page.write_text(text, encoding="utf-8")


def write_pages(out: Path) -> None:
    """Write everything that the generator reads."""
    shutil.rmtree(out, ignore_errors=True)
    pages = out / "pages"
    shutil.copytree(ROOT / "docs", pages, ignore=shutil.ignore_patterns("*.md", "__pycache__"))
    shutil.copytree(HERE / "assets", pages / "assets")
    sources = {ROOT / "README.md": "index.md"}
    sources |= {path: path.relative_to(ROOT / "docs").as_posix() for path in sorted((ROOT / "docs").rglob("*.md"))}
    sources |= {ROOT / name: place for name, place in ELSEWHERE.items()}
    sources |= {path: f"examples/notebooks/{path.stem}.md" for path in sorted(NOTEBOOKS.glob("*.ipynb"))}
    for source, place in sources.items():
        text = notebook(source) if source.suffix == ".ipynb" else source.read_text(encoding="utf-8")
        if place == SCRIPTS:
            text += scripts()
        put(pages / place, prepared(text, source, place, sources))
    put(pages / "reference" / "cli.md", command_line())
    put(pages / "reference" / "task.md", task_file())
    api = api_pages()
    for name, text in api.items():
        put(pages / "reference" / "api" / f"{name}.md", text)
    configure(out, api, [place for source, place in sources.items() if source.is_relative_to(ROOT / "docs")])


def put(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def configure(out: Path, api: dict[str, str], pages: list[str]) -> None:
    """Write the generator's settings: the navigation with the pages of the Python reference, and pages that are new."""
    text = (HERE / "zensical.toml").read_text(encoding="utf-8").replace("@source", str(ROOT / "src"))
    listed = set(_places(tomllib.loads(text)["project"]["nav"]))
    more = [page for page in pages if page not in listed]
    if more:
        print(f"Pages in no section of website/zensical.toml: {', '.join(more)}")
    made = ", ".join(f'{{ "{name}" = "reference/api/{name}.md" }}' for name in api)
    text = text.replace('"@api"', f"[{made}]")
    kept = ", ".join(f'"{page}"' for page in more)
    text = text.replace('  { "More" = "@more" },\n', f'  {{ "More" = [{kept}] }},\n' if more else "")
    put(out / "zensical.toml", text)


def _places(nav: list[Any]) -> Iterator[str]:
    for entry in nav:
        for value in entry.values() if isinstance(entry, dict) else [entry]:
            yield from _places(value) if isinstance(value, list) else [value]


def prepared(text: str, source: Path, place: str, sources: dict[Path, str]) -> str:
    """A page's text, with links that hold on the site, mathematics as MathML, and fences without notes to tests."""
    text = re.sub(r"^(```\w+) \w+$", r"\1", MATHS.sub(_mathml, text), flags=re.MULTILINE)
    text = re.sub(
        r"^\|.*$",
        lambda row: CODE.sub(lambda code: code.group().replace("\\|", "|"), row.group()),
        text,
        flags=re.MULTILINE,
    )
    return outside_code(
        text, lambda part: TIGHT_LIST.sub(r"\1\n", LINK.sub(lambda m: _link(m, source, place, sources), part))
    )


def outside_code(text: str, change: Callable[[str], str]) -> str:
    """Apply a change to all of a text but its code."""
    parts = FENCE.split(text)
    for i in range(0, len(parts), 2):
        inline = CODE.split(parts[i])
        joined = "".join(piece if k % 2 == 0 else f"\0{k // 2}\0" for k, piece in enumerate(inline))
        pieces = re.split("\0(\\d+)\0", change(joined))
        parts[i] = "".join(piece if k % 2 == 0 else inline[2 * int(piece) + 1] for k, piece in enumerate(pieces))
    return "".join(parts)


def _link(match: re.Match[str], source: Path, place: str, sources: dict[Path, str]) -> str:
    """A link as it has to be on the site."""
    picture, words, target = match.groups()
    if re.match(r"[a-z]+:", target) or target.startswith("#"):
        return match.group()
    path, _, anchor = target.partition("#")
    file = (source.parent / path).resolve()
    if not file.exists():
        raise SystemExit(f"{source.relative_to(ROOT)}: there is no {target}")
    if file == NOTEBOOKS:
        file = sorted(NOTEBOOKS.glob("*.ipynb"))[0]
    if file in sources:
        there = sources[file]
    elif file.is_relative_to(ROOT / "docs"):
        there = file.relative_to(ROOT / "docs").as_posix()
    elif file.parent == ROOT / "examples" and file.suffix == ".py":
        there, anchor = SCRIPTS, file.name.replace(".", "")
    elif picture:
        raise SystemExit(f"{source.relative_to(ROOT)}: the picture {target} is not in docs/")
    else:
        return f"{words} (`{file.relative_to(ROOT)}`)" if words != file.name else f"`{file.relative_to(ROOT)}`"
    if not picture and words.strip("`") in (file.name, path):  # a page has its title on the site, not its file's name
        words = title(file)
    relative = os.path.relpath(there, Path(place).parent or ".")
    return f"{picture}[{words}]({relative}{'#' + anchor if anchor else ''})"


def title(page: Path) -> str:
    """The first heading of a page; a file's name where there is none."""
    found = re.search(r"^# (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE) if page.suffix == ".md" else None
    return found.group(1) if found else page.name


def _mathml(match: re.Match[str]) -> str:
    from latex2mathml.converter import convert

    return convert(match.group(1), display="block").replace("\n", " ")


def scripts() -> str:
    """The examples' code, a heading for each."""
    found = sorted((ROOT / "examples").glob("*.py"))
    return "".join(f"\n## {path.name}\n\n```python\n{path.read_text(encoding='utf-8')}```\n" for path in found)


def notebook(path: Path) -> str:
    """A notebook's text and code, without outputs."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    texts = ["".join(cell["source"]) for cell in cells]
    shown = [
        text if cell["cell_type"] == "markdown" else f"```python\n{text}\n```"
        for cell, text in zip(cells, texts, strict=True)
    ]
    return "\n\n".join([*shown, f"This is `{path.relative_to(ROOT)}`, without what its cells print."]) + "\n"


if __name__ == "__main__":
    main()
