"""Write the files of a directory all together, or none of them."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import mkdtemp

from levade.errors import LevadeError
from levade.writing import check_replaceable


@contextmanager
def filling(directory: Path) -> Iterator[Path]:
    """Give a place to write files. At the end they move into the directory; after an error they are removed.

    Files of the same names are replaced, others stay. The directory is created if it does not exist.

    Args:
        directory: The directory.

    Yields:
        A directory for the new files.

    Raises:
        LevadeError: If it cannot be written, before any work is done.
    """
    made = [path for path in (directory.parent, *directory.parent.parents) if not path.exists()]
    try:
        if not next(path for path in (directory, *directory.absolute().parents) if path.exists()).is_dir():
            raise NotADirectoryError(20, "Not a directory")
        directory.parent.mkdir(parents=True, exist_ok=True)
        near = directory if directory.exists() else directory.parent  # on one file system with it: files move at once
        partial = Path(mkdtemp(prefix=f".{directory.name}.", suffix=".partial", dir=near))
    except OSError as error:
        raise LevadeError(f"{directory}: cannot be written ({error.strerror}); give a directory that can") from None
    try:
        yield partial
        files = sorted(path for path in partial.rglob("*") if path.is_file())
        places = [directory / file.relative_to(partial) for file in files]
        for place in places:
            try:
                check_replaceable(place)
            except OSError as error:
                raise LevadeError(
                    f"{place}: {str(error.strerror).lower()}, and a file of that name is to be written; move it away"
                ) from None
            place.parent.mkdir(parents=True, exist_ok=True)
        for file, place in zip(files, places, strict=True):
            file.replace(place)
    except OSError as error:
        raise LevadeError(
            f"{directory}: cannot be written ({error.strerror or error}); make room, then again"
        ) from None
    finally:
        shutil.rmtree(partial, ignore_errors=True)
        if not directory.exists():
            for path in made:
                with suppress(OSError):
                    path.rmdir()
