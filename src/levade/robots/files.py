"""Files: what kind of file a robot's is, by what it holds rather than by its name, and its text, whatever its encoding."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from levade.errors import LevadeError

_LFS = b"version https://git-lfs"
_BOMS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_DECLARATION = re.compile(rb"""^\s*<\?xml[^>]*\bencoding\s*=\s*["']([\w.:-]{1,40})["']""")
_PARTS = re.compile(r"""<(include|model)\b[^>]*?\bfile\s*=\s*["']([^"']+)["']""")
_LARGEST = 50_000_000
"""[bytes], of a robot's XML; meshes are in files of their own."""


def is_pointer(content: bytes) -> bool:
    """Whether a file is only a git-lfs pointer to what it should hold."""
    return content.startswith(_LFS)


def pointer_problem(name: str) -> str:
    """What a message says of a git-lfs pointer, with the remedy."""
    return f"{name} is a git-lfs pointer, not the file itself: git lfs pull fetches it"


def is_model(path: Path) -> bool:
    """Whether a file holds XML, so that it is a robot's model and no description, whatever its name is."""
    try:
        with path.open("rb") as file:
            head = file.read(4096)
    except OSError:
        return False
    for mark, _ in _BOMS:
        head = head.removeprefix(mark)
    return head.replace(b"\0", b"").lstrip().startswith(b"<")


def read_xml(path: Path) -> str:
    """The text of an XML file, without a byte order mark and without the encoding that it declares.

    UTF-8 is tried before what it declares: files that were saved again often declare what they were.

    Raises:
        LevadeError: If it cannot be read, or is no text.
    """
    try:
        if path.stat().st_size > _LARGEST:
            raise LevadeError(f"{path}: has {path.stat().st_size / 1e6:.0f} MB; an MJCF or URDF is text of far less")
        content = path.read_bytes()
    except OSError as error:
        raise LevadeError(f"{path}: cannot be read ({error.strerror})") from None
    if is_pointer(content):
        raise LevadeError(f"{path}: {pointer_problem('it')}")
    return _decode(path, content)


def _decode(path: Path, content: bytes) -> str:
    declared = _DECLARATION.match(content)
    marked = [encoding for mark, encoding in _BOMS if content.startswith(mark)]
    unmarked = [name for name, start in (("utf-16-le", b"<\0"), ("utf-16-be", b"\0<")) if content.startswith(start)]
    named = [declared[1].decode("ascii")] if declared else []
    last = ["latin-1"] if content.lstrip().startswith(b"<") else []  # most often a letter in a comment
    for encoding in marked or unmarked or ["utf-8", *named, *last]:
        try:
            text = content.decode(encoding)
        except (UnicodeError, LookupError, ValueError):
            continue
        if "\0" not in text:
            return re.sub(r"^\s*<\?xml[^>]*\?>", "<?xml version='1.0'?>", text, count=1)
    raise LevadeError(f"{path}: not a text file; give an MJCF or URDF")


def parts(path: Path, text: str) -> Iterator[tuple[str, Path, str]]:
    """Files that an MJCF includes or attaches, and those that they name.

    Args:
        path: Of the MJCF; MuJoCo looks for what it includes beside it.
        text: What it holds.

    Yields:
        How the file is named, where it is, and its text; files that are not there are left out.
    """
    seen: set[str] = set()
    waiting = [(path.parent, text)]
    while waiting:
        folder, within = waiting.pop()
        for kind, name in _PARTS.findall(re.sub(r"<!--.*?-->", "", within, flags=re.DOTALL)):
            place = folder / PurePosixPath(name.replace("\\", "/"))
            if name in seen or not place.is_file():
                continue
            seen.add(name)
            inside = read_xml(place)
            yield name, place, inside
            waiting.append((place.parent if kind == "model" else folder, inside))
