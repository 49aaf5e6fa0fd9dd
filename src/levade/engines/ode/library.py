"""The Open Dynamics Engine's C library, found on the system and called through ctypes.

    ode = load()
    world = ode.dWorldCreate()

Every ``d...`` name is the C function of ODE's manual; objects are addresses. Two libraries will do: the system's own
``libode.so.8`` (Debian: ``apt install libode8``; double precision), and the one inside the wheel ``panda3d`` (the extra
``ode``; single precision). The system's comes first.

Not used: the binding ``ode-python``, which finds only the system's library, prints and changes the environment when it
is imported, and has typed pointers for every handle, which cost as much again as the call.
"""

from __future__ import annotations

import ctypes
import importlib.util
from ctypes import c_int, c_uint, c_ulong, c_void_p
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from levade.errors import LevadeError

P, R, I = c_void_p, "real", c_int  # noqa: E741 - as in ODE's signatures
"""Pointer, dReal, int."""

_SIGNATURES: dict[str, tuple[Any, ...]] = {  # name -> result, arguments
    "dInitODE2": (I, c_uint),
    "dAllocateODEDataForThread": (I, c_uint),
    "dGetConfiguration": (ctypes.c_char_p,),
    "dSetMessageHandler": (None, P),
    "dRandSetSeed": (None, c_ulong),
    "dWorldCreate": (P,),
    "dWorldDestroy": (None, P),
    "dWorldSetGravity": (None, P, R, R, R),
    "dWorldSetERP": (None, P, R),
    "dWorldSetCFM": (None, P, R),
    "dWorldSetQuickStepNumIterations": (None, P, I),
    "dWorldSetQuickStepW": (None, P, R),
    "dWorldSetContactMaxCorrectingVel": (None, P, R),
    "dWorldSetContactSurfaceLayer": (None, P, R),
    "dWorldQuickStep": (I, P, R),
    "dWorldStep": (I, P, R),
    "dBodyCreate": (P, P),
    "dBodySetMass": (None, P, P),
    "dBodySetPosition": (None, P, R, R, R),
    "dBodySetQuaternion": (None, P, P),
    "dBodySetLinearVel": (None, P, R, R, R),
    "dBodySetAngularVel": (None, P, R, R, R),
    "dBodySetForce": (None, P, R, R, R),
    "dBodySetTorque": (None, P, R, R, R),
    "dBodySetAutoDisableFlag": (None, P, I),
    "dBodyGetPosition": (P, P),
    "dBodyGetQuaternion": (P, P),
    "dBodyGetRotation": (P, P),
    "dBodyGetLinearVel": (P, P),
    "dBodyGetAngularVel": (P, P),
    "dMassSetParameters": (None, P, *[R] * 10),
    "dJointCreateHinge": (P, P, P),
    "dJointCreateAMotor": (P, P, P),
    "dJointCreateContact": (P, P, P, P),
    "dJointAttach": (None, P, P, P),
    "dJointSetFeedback": (None, P, P),
    "dJointSetHingeAnchor": (None, P, R, R, R),
    "dJointSetHingeAxis": (None, P, R, R, R),
    "dJointSetHingeParam": (None, P, I, R),
    "dJointAddHingeTorque": (None, P, R),
    "dJointSetAMotorNumAxes": (None, P, I),
    "dJointSetAMotorAxis": (None, P, I, I, R, R, R),
    "dJointSetAMotorParam": (None, P, I, R),
    "dJointGroupCreate": (P, I),
    "dJointGroupDestroy": (None, P),
    "dJointGroupEmpty": (I, P),
    "dCreateSphere": (P, P, R),
    "dCreateBox": (P, P, R, R, R),
    "dCreateCapsule": (P, P, R, R),
    "dCreateCylinder": (P, P, R, R),
    "dCreatePlane": (P, P, R, R, R, R),
    "dCreateConvex": (P, P, P, c_uint, P, c_uint, P),
    "dGeomDestroy": (None, P),
    "dGeomSetBody": (None, P, P),
    "dGeomSetPosition": (None, P, R, R, R),
    "dGeomSetQuaternion": (None, P, P),
    "dGeomSetOffsetPosition": (None, P, R, R, R),
    "dGeomSetOffsetQuaternion": (None, P, P),
    "dCollide": (I, P, P, I, P, I),
}

LO_STOP, HI_STOP, VELOCITY, MAX_FORCE, CFM, STOP_ERP, STOP_CFM = 0, 1, 2, 5, 8, 9, 10
"""Parameters of joints: ``dParamLoStop`` and so on."""

APPROXIMATE_PYRAMID = 0x7000
"""``dContactApprox1``: friction bounded by mu times the normal force, along two directions."""

_SYSTEM, _WHEEL = "libode.so.8", "libpandaode.so*"
_ALL_DATA = 0xFFFFFFFF


class Library:
    """ODE's functions as attributes, and the types that depend on its precision.

    Attributes:
        real: C type of ``dReal``.
        dtype: The same type in numpy.
        contact: Structure ``dContact``.
        mass: Structure ``dMass``.
        feedback: Structure ``dJointFeedback``.
        name: File and precision, which decide the bits.
    """

    def __init__(self, path: str) -> None:
        dll = ctypes.CDLL(path)
        dll.dGetConfiguration.restype = ctypes.c_char_p
        double = b"ODE_double_precision" in dll.dGetConfiguration()
        self.real: Any = ctypes.c_double if double else ctypes.c_float
        self.dtype = np.dtype(self.real)
        for name, (result, *arguments) in _SIGNATURES.items():
            function = getattr(dll, name)
            function.restype = result
            function.argtypes = [self.real if kind is R else kind for kind in arguments]
            setattr(self, name, function)
        self.contact, self.mass, self.feedback = _structures(self.real)
        self.name = f"{_loaded_file(path)} {'double' if double else 'single'}"
        self._quiet = ctypes.CFUNCTYPE(None, c_int, ctypes.c_char_p, c_void_p)(lambda *_: None)
        self.dInitODE2(0)
        self.dAllocateODEDataForThread(_ALL_DATA)
        self.dSetMessageHandler(self._quiet)

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(name)  # functions are set one by one; this tells the type checker

    def vector(self, *values: float) -> Any:
        """Return a C array of ``dReal``."""
        return (self.real * len(values))(*values)


@cache
def load() -> Library:
    """Load the library.

    Returns:
        The library.

    Raises:
        LevadeError: If there is none. The message says what to install.
    """
    tried = [_SYSTEM]
    spec = importlib.util.find_spec("panda3d")
    for folder in (spec.submodule_search_locations or []) if spec else []:
        tried += sorted(str(path) for path in Path(folder).glob(_WHEEL))
    for path in tried:
        try:
            return Library(path)
        except (OSError, AttributeError):  # not there; there, but without the functions
            continue
    raise LevadeError(
        "the engine ode needs the library of the Open Dynamics Engine, which is not installed; on Debian and Ubuntu:"
        " apt install libode8 (double precision); with pip: pip install 'levade[ode]' (single precision)"
    )


def _structures(real: Any) -> tuple[Any, Any, Any]:
    vector, matrix = real * 4, real * 12

    class Surface(ctypes.Structure):
        _fields_ = [
            ("mode", c_int),
            *((name, real) for name in ("mu", "mu2", "rho", "rho2", "rhoN", "bounce", "bounce_vel", "soft_erp")),
            *((name, real) for name in ("soft_cfm", "motion1", "motion2", "motionN", "slip1", "slip2")),
        ]

    class Geom(ctypes.Structure):
        _fields_ = [
            *(("pos", vector), ("normal", vector), ("depth", real)),
            *(("g1", P), ("g2", P), ("side1", c_int), ("side2", c_int)),
        ]

    class Contact(ctypes.Structure):
        _fields_ = [("surface", Surface), ("geom", Geom), ("fdir1", vector)]

    class Mass(ctypes.Structure):
        _fields_ = [("mass", real), ("c", vector), ("I", matrix)]

    class Feedback(ctypes.Structure):
        _fields_ = [("f1", vector), ("t1", vector), ("f2", vector), ("t2", vector)]

    return Contact, Mass, Feedback


def _loaded_file(path: str) -> str:
    """Return the file's name with its full version, such as libode.so.8.0.2, if the system knows which file was loaded."""
    name = Path(path).name
    try:
        for line in Path("/proc/self/maps").read_text().splitlines():
            file = line.rpartition(" ")[2]
            if Path(file).name.startswith(name):
                return Path(file).resolve().name
    except OSError:
        pass
    return name
