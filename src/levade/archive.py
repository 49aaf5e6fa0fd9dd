"""Read and write archives of arrays (numpy's .npz), such as motion files. Sizes are checked before anything is unpacked.

    arrays = unpack(Path("motion.npz"))         # name -> array
    content = packed(arrays)                    # equal arrays give equal bytes

A file can claim any size: 2 MB of zeros unpack to 2 GB. Nothing in it is a pickle, and nothing is executed.
"""

from __future__ import annotations

import io
import math
import warnings
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from tokenize import TokenError
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.errors import LevadeError

LARGEST = 256_000_000
"""Largest size of all arrays together, and of the file [bytes]. A motion of 10 s on a robot with meshes takes a tenth of it."""

_DIRECTORY = 1_000_000
"""Largest size of the archive's table of contents [bytes]."""

_END, _LOCATOR = 22, 20
"""Sizes of the record at the end of an archive without a comment, and of the one before it in archives of 4 GB [bytes]."""

# what numpy and zipfile raise for files that are damaged, or something else
_UNREADABLE = (
    *(OSError, ValueError, EOFError, AttributeError, TypeError, LookupError, RuntimeError, MemoryError, SyntaxError),
    *(ArithmeticError, TokenError, Warning, zipfile.BadZipFile, zlib.error),
)


def unpack(path: Path) -> dict[str, Array]:
    """Read all arrays of an archive.

    Args:
        path: The file.

    Returns:
        Name -> array.

    Raises:
        LevadeError: If the file is missing, damaged, something else, or larger than `LARGEST`.
    """
    if path.is_dir():
        raise LevadeError(f"{path}: is a directory; give the motion.npz in it: {path / 'motion.npz'}")
    try:
        with path.open("rb") as file:
            _check_size(path, file.seek(0, 2))
            _check_directory(file)
            with zipfile.ZipFile(file) as archive:
                members = archive.infolist()
                _check_size(path, sum(member.file_size for member in members))
                _check_members(members)
                return {member.filename.removesuffix(".npy"): _array(archive, member) for member in members}
    except FileNotFoundError:
        raise LevadeError(f"{path}: no such file; give the motion.npz that levade solve wrote") from None
    except _UNREADABLE:
        raise LevadeError(f"{path}: cannot be read as a motion; damaged, or not a motion.npz of levade solve") from None


def _check_size(path: Path, size: int) -> None:
    if size > LARGEST:
        raise LevadeError(
            f"{path}: unfolds to {size / 1e6:.0f} MB, a motion to at most {LARGEST / 1e6:.0f} MB; not made by levade solve"
        )


def _check_directory(file: IO[bytes]) -> None:
    """Raise ValueError for a long table of contents, because zipfile reads all of it.

    numpy writes no comment at the end, so the last bytes are the record that zipfile looks for first.
    """
    size = file.seek(0, 2)
    file.seek(max(0, size - _END - _LOCATOR))
    last = file.read()
    end = last[-_END:]
    if not (end.startswith(b"PK\5\6") and end.endswith(b"\0\0")) or last.startswith(b"PK\6\7"):
        raise ValueError
    if int.from_bytes(end[12:16], "little") > _DIRECTORY:
        raise ValueError
    file.seek(0)


def _check_members(members: list[zipfile.ZipInfo]) -> None:
    """Raise ValueError for members that numpy does not write: duplicate names, other files, other compressions."""
    names = [member.filename for member in members]
    kinds = {member.compress_type for member in members}
    if len(set(names)) < len(names) or not all(name.endswith(".npy") for name in names):
        raise ValueError
    if not kinds <= {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}:
        raise ValueError


def _array(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> Array:
    """Read one array, after its header has been compared with the size of what follows. Raises ValueError."""
    with archive.open(member) as file:
        version = np.lib.format.read_magic(file)
        read_header = {
            (1, 0): np.lib.format.read_array_header_1_0,
            (2, 0): np.lib.format.read_array_header_2_0,
        }[version]
        with warnings.catch_warnings(action="error"):  # of headers as Python 2 wrote them
            shape, fortran, dtype = read_header(file)
        size = math.prod(shape) * dtype.itemsize
        if dtype.hasobject or not dtype.itemsize or min(shape, default=0) < 0 or size != member.file_size - file.tell():
            raise ValueError
        data = bytearray(file.read())
    if len(data) != size:
        raise ValueError
    return np.frombuffer(data, dtype).reshape(shape, order="F" if fortran else "C")


def packed(arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Pack arrays into an npz file; equal arrays give equal bytes.

    Args:
        arrays: Arrays by name.

    Returns:
        Content of the file.
    """
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as file:
        for name, values in arrays.items():
            one = io.BytesIO()
            np.save(one, values, allow_pickle=False)
            file.writestr(zipfile.ZipInfo(f"{name}.npy"), one.getvalue(), zipfile.ZIP_DEFLATED)
    return content.getvalue()
