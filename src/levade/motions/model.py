"""Check and compile the model of a motion file. It must stand alone, and be no larger than a robot with its scene.

    check_text(xml, assets)                 # before MuJoCo reads it
    model = compile_text(xml, assets)

MuJoCo reads files that are not among the assets from the disk, and expands a few words into any number of bodies. levade writes
neither, so such a text comes from elsewhere.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Collection, Mapping

import mujoco
import numpy as np

from levade.document import hides
from levade.errors import LevadeError

_EXPANDED = ("include", "attach", "model", "replicate", "composite", "flexcomp")
"""Elements that MuJoCo expands."""

_MOST = {"hfield": 1e7, "texture": 1e8}
"""Largest number of values in one element: rows times columns, width times height."""

_MOST_MEMORY = 4e9
"""Largest memory [bytes], or numbers, that ``<size>`` may require."""

_SUFFIXES = {"K": 2**10, "M": 2**20, "G": 2**30, "T": 2**40, "P": 2**50, "E": 2**60}


def check_text(text: str, assets: Collection[str]) -> None:
    """Check a model's text without compiling it.

    Args:
        text: MJCF.
        assets: Names of the files that it may use.

    Raises:
        LevadeError: If it is not MJCF, uses other files, or would grow beyond a robot and its scene.
    """
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise LevadeError("model_xml: declares a document type, which no model needs")
    try:
        root = ET.fromstring(text)
    except (ET.ParseError, ValueError, RecursionError):
        raise LevadeError("model_xml: is no XML") from None
    if root.tag != "mujoco":
        raise LevadeError(f"model_xml: begins with <{root.tag[:40]}>; should begin with <mujoco>")
    known = {name.lower() for name in assets}
    for element in root.iter():
        if element.tag.lower() in _EXPANDED:
            raise LevadeError(f"model_xml: has <{element.tag}>; a motion's model stands alone")
        if element.tag == "mesh" and "builtin" in element.attrib:
            raise LevadeError("model_xml: has a mesh that MuJoCo makes; a motion's model holds its meshes")
        for key, name in element.attrib.items():
            if key.startswith("file") and not _is_there(name, known):
                raise LevadeError(
                    f"model_xml: <{element.tag}> needs the file {name[:80]!r}, which is not in the motion"
                )
        if element.tag in ("hfield", "texture", "size"):
            _check_size(element)


def compile_text(text: str, assets: Mapping[str, bytes]) -> mujoco.MjModel:
    """Compile a model's text.

    Args:
        text: MJCF.
        assets: Files that it uses, by name.

    Returns:
        The model.

    Raises:
        LevadeError: If MuJoCo refuses it, a name has control characters, or a value is not finite.
    """
    try:
        model = mujoco.MjModel.from_xml_string(text, dict(assets))
    except (ValueError, mujoco.FatalError) as error:
        what = " ".join(str(error).split())
        raise LevadeError(
            f"motion: MuJoCo {mujoco.__version__} does not take its model: {what}; the file is damaged"
        ) from None
    if hides(model.names.decode(errors="replace").replace("\0", " ")):
        raise LevadeError("motion: names in its model hold control characters; the file is damaged")
    for part in (model, model.opt):
        for name in dir(part):
            values = getattr(part, name) if name[0] != "_" else None
            if isinstance(values, np.ndarray) and values.dtype.kind == "f" and np.isnan(values).any():
                raise LevadeError(f"motion: {name} of its model has values that are no numbers; the file is damaged")
    return model


def _is_there(name: str, assets: Collection[str]) -> bool:
    """Tell whether MuJoCo finds a file among the assets: by its path or by its name, in upper or lower case."""
    path = name.replace("\\", "/").lower()
    return not name or path in assets or path.rpartition("/")[2] in assets


def _check_size(element: ET.Element) -> None:
    numbers = {key: _number(value) for key, value in element.attrib.items()}
    if element.tag == "size":
        asked, most = max(numbers.values(), default=0.0), _MOST_MEMORY
    else:
        rows, columns = ("nrow", "ncol") if element.tag == "hfield" else ("width", "height")
        asked, most = numbers.get(rows, 1.0) * numbers.get(columns, 1.0), _MOST[element.tag]
    if asked > most:
        raise LevadeError(f"model_xml: <{element.tag}> asks for {asked:.3g} numbers, more than {most:.0g}")


def _number(text: str) -> float:
    """Return the value of a whole number such as ``-1``, ``128`` or ``16M``; 0 for anything else."""
    match = re.fullmatch(r"\s*[-+]?(\d{1,30})([KMGTPE]?)\s*", text.upper())
    return float(match[1]) * _SUFFIXES.get(match[2], 1) if match else 0.0
