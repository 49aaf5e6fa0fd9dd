"""Files: tell the kind of a robot's file by its content rather than its name, and read its text in any encoding."""

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
"""Largest size of a robot's XML [bytes]; meshes are in other files."""


def is_pointer(content: bytes) -> bool:
    """Tell whether a file is only a git-lfs pointer to its content.

    Args:
        content: Content of the file, or its beginning.

    Returns:
        True for a pointer.
    """
    return content.startswith(_LFS)


def pointer_problem(name: str) -> str:
    """Describe a git-lfs pointer for a message, with the remedy.

    Args:
        name: Name of the file in the message.

    Returns:
        The message, on one line.
    """
    return f"{name} is a git-lfs pointer, not the file itself: git lfs pull fetches it"


def is_model(path: Path) -> bool:
    """Tell whether a file holds XML, and so is a robot's model rather than a description, whatever its name.

    Args:
        path: The file.

    Returns:
        True if it begins with XML. False for other files, and for files that cannot be read.
    """
    try:
        with path.open("rb") as file:
            head = file.read(4096)
    except OSError:
        return False
    for mark, _ in _BOMS:
        head = head.removeprefix(mark)
    return head.replace(b"\0", b"").lstrip().startswith(b"<")


def is_other_text(path: Path) -> bool:
    """Tell whether a file is a text without ``model:``, which every description has, and so is about something else.

    Args:
        path: The file.

    Returns:
        True for a text in UTF-8 without that key. False for other files, and for files that cannot be read.
    """
    try:
        content = path.read_bytes()[:_LARGEST]
        content.decode("utf-8")
    except (OSError, UnicodeError):
        return False
    return (
        b"\0" not in content and not is_pointer(content) and re.search(rb"^\W*model\W*:", content, re.MULTILINE) is None
    )


def read_xml(path: Path) -> str:
    """Read an XML file.

    UTF-8 is tried before the declared encoding, since files that were saved again often declare their former one.

    Args:
        path: Path of the file.

    Returns:
        The text, without byte order mark and declared encoding.

    Raises:
        LevadeError: If the file cannot be read, or is not text.
    """
    try:
        if path.stat().st_size > _LARGEST:
            raise LevadeError(
                f"{path}: has {path.stat().st_size / 1e6:.0f} MB; an MJCF or URDF is far smaller; give one"
            )
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
    last = ["latin-1"] if content.lstrip().startswith(b"<") else []  # usually because of a letter in a comment
    for encoding in marked or unmarked or ["utf-8", *named, *last]:
        try:
            text = content.decode(encoding)
        except (UnicodeError, LookupError, ValueError):
            continue
        if "\0" not in text:
            return re.sub(r"^\s*<\?xml[^>]*\?>", "<?xml version='1.0'?>", text, count=1)
    raise LevadeError(f"{path}: not a text file; give an MJCF or URDF")


def parts(path: Path, text: str) -> Iterator[tuple[str, Path, str]]:
    """Find the files that an MJCF includes or attaches, and those that they name in turn.

    Args:
        path: Path of the MJCF. MuJoCo looks for included files next to it.
        text: Content of the MJCF.

    Yields:
        Name by which the file is included, its path, and its text. Missing files are left out.
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
