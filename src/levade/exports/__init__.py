"""Export motions for robots and other tools, in their formats.

    motion = Motion.load("rearing/motion.npz")
    exported = export(motion, "csv", Path("rearing/motion-csv"))
    exported.written, exported.notes

docs/export.md describes the files, columns, units and frames of every format.
"""

from levade.exports.export import FORMATS, Exported, Format, export

__all__ = ["FORMATS", "Exported", "Format", "export"]
