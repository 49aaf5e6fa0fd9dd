"""Motions for other tools and for robots: files in their formats, made from a motion file.

    motion = Motion.load("rearing/motion.npz")
    exported = export(motion, "csv", Path("rearing/motion-csv"))
    exported.written, exported.notes

docs/export.md has every format's files, columns, units and frames.
"""

from levade.exports.export import FORMATS, Exported, Format, export

__all__ = ["FORMATS", "Exported", "Format", "export"]
