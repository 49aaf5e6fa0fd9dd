"""ODE worlds: one for every trial, all of the same multibody, stepped one after another.

ODE gives pointers to the pose and velocity of a body. One numpy call per step gathers those of all bodies of all worlds, so
that Python calls ODE only to collide, to push and to step.
"""

from __future__ import annotations

import ctypes
import weakref
from collections.abc import Iterable, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from levade.arrays import Array
from levade.engines.ode import library
from levade.engines.ode.library import Library
from levade.engines.ode.multibody import Multibody
from levade.engines.ode.shapes import Shape
from levade.engines.physics import Ode

CONTACTS = 8
"""Largest number of contacts of one pair of shapes. A box on a plane has four."""

_PARTS = {"position": 3, "quaternion": 4, "rotation": 9, "linear": 3, "angular": 3}
_ROTATION = [0, 1, 2, 4, 5, 6, 8, 9, 10]  # of a dMatrix3, whose rows have a fourth number


class Worlds:
    """Worlds of one multibody. Body l of a world is link l, with its centre of mass as the body's origin.

    Args:
        resisted: Hinges with a motor that resists their motion (`resist`), shape (J,).
    """

    def __init__(
        self, ode: Library, multibody: Multibody, settings: Ode, timestep: float, resisted: NDArray[np.bool_]
    ) -> None:
        self._ode, self._multibody, self._settings, self._timestep = ode, multibody, settings, timestep
        self._resisted = [int(j) for j in np.flatnonzero(resisted)]
        self._step = ode.dWorldQuickStep if settings.solver == "quick" else ode.dWorldStep
        hinges = multibody.hinges
        limited = np.isfinite(hinges.lower) & np.isfinite(hinges.upper)
        self._middle = hinges.zero.copy()
        self._middle[limited] = (hinges.lower[limited] + hinges.upper[limited]) / 2
        self._keep: list[object] = []
        self._worlds: list[int] = []
        self._bodies: list[list[int]] = []
        self._hinges: list[list[int]] = []
        self._motors: list[list[int]] = []
        self._sides: list[list[tuple[int, int, int, int]]] = []
        self._static = {i: self._geom(shape) for i, shape in enumerate(multibody.shapes) if shape.link < 0}
        self._friction = [float(mu) for mu in multibody.friction]
        self._contacts = (ode.contact * CONTACTS)()
        for contact in self._contacts:
            contact.surface.mode = library.APPROXIMATE_PYRAMID
        size, start = ctypes.sizeof(ode.contact), ctypes.addressof(self._contacts)
        self._contact_at = [start + i * size for i in range(CONTACTS)]
        self._geom_at = start + ode.contact.geom.offset
        self._skip = size
        offset = ode.contact.surface.offset + type(self._contacts[0].surface).mu.offset
        self._mu = np.ndarray(CONTACTS, ode.dtype, self._contacts, offset, (size,))
        self._group = ode.dJointGroupCreate(0)
        self._feedback = np.zeros((64, 16), ode.dtype)
        self._geoms = list(self._static.values())
        weakref.finalize(self, _free, ode, self._worlds, self._geoms, self._group)

    def __len__(self) -> int:
        return len(self._worlds)

    def grow(self, n: int) -> None:
        """Make worlds until there are at least n.

        Args:
            n: Least number of worlds.
        """
        if len(self) >= n:
            return
        data = mujoco.MjData(self._multibody.model)
        data.qpos[self._multibody.hinges.qpos] = self._middle
        mujoco.mj_kinematics(self._multibody.model, data)
        while len(self) < n:
            self._add(data)
        ode = self._ode
        ends = ("Position", "Quaternion", "Rotation", "LinearVel", "AngularVel")
        getters = [getattr(ode, f"dBodyGet{end}") for end in ends]
        at = np.array([[[get(body) for get in getters] for body in bodies] for bodies in self._bodies], dtype=np.int64)
        base, size = int(at.min()), ode.dtype.itemsize
        self._memory = _memory(base, (int(at.max()) - base) // size + 12, ode.dtype)
        at = (at - base) // size
        columns = [at[:, :, i, None] + (_ROTATION if i == 2 else np.arange(3 + (i == 1))) for i in range(len(getters))]
        self._where = np.concatenate(columns, axis=2)

    def place(self, which: Iterable[int], position: Array, quaternion: Array, linear: Array, angular: Array) -> None:
        """Place the links of some worlds: centres of mass, frames, velocities, in world axes.

        Args:
            which: Indices of the worlds. All get the same values.
            position: Centres of mass of the L links [m], shape (L, 3).
            quaternion: Orientations of the links' frames, w-x-y-z, shape (L, 4).
            linear: Velocities of the centres of mass [m/s], shape (L, 3).
            angular: Angular velocities [rad/s], shape (L, 3).
        """
        ode = self._ode
        ode.dJointGroupEmpty(self._group)  # what a run that was interrupted in the middle of a step left behind
        turned = [ode.vector(*values) for values in quaternion]
        for world in which:
            for link, body in enumerate(self._bodies[world]):
                ode.dBodySetPosition(body, *position[link])
                ode.dBodySetQuaternion(body, turned[link])
                ode.dBodySetLinearVel(body, *linear[link])
                ode.dBodySetAngularVel(body, *angular[link])
                ode.dBodySetForce(body, 0.0, 0.0, 0.0)
                ode.dBodySetTorque(body, 0.0, 0.0, 0.0)

    def read(self, n: int) -> dict[str, Array]:
        """Read the links of the first n worlds, in world axes.

        Args:
            n: Number of worlds to read.

        Returns:
            Position of the centre of mass, quaternion, rotation (row by row), linear and angular velocity, by name;
            shape (n, L, ...).
        """
        row = self._memory.take(self._where[:n]).astype(float, copy=False)
        parts, start = {}, 0
        for name, width in _PARTS.items():
            parts[name] = row[..., start : start + width]
            start += width
        return parts

    def resist(self, world: int, target: Array, resistance: Array) -> None:
        """Set the resisting torques of a world's hinges.

        A hinge gets ``resistance * (target - speed)`` at the speed after the step.
        Hinges without such a motor ignore theirs.

        Args:
            world: Index of the world.
            target: Speed at which each hinge has no resistance [rad/s], shape (J,).
            resistance: Resistance of each hinge, above zero [Nm s/rad], shape (J,).
        """
        set_param, vel, cfm = self._ode.dJointSetAMotorParam, library.VELOCITY, library.CFM
        for motor, j in zip(self._motors[world], self._resisted, strict=True):
            set_param(motor, vel, target[j])
            set_param(motor, cfm, 1.0 / resistance[j])

    def advance(
        self,
        world: int,
        torque: Sequence[float],
        pairs: Sequence[int],
        seed: int,
        touching: list[tuple[int, int]] | None,
    ) -> None:
        """Advance a world by one step under torques on its hinges, with contacts of those of ``pairs`` that touch.

        Args:
            world: Index of the world.
            torque: Torque on each hinge [Nm].
            pairs: Indices of the pairs of shapes that may touch.
            seed: Seed of the solver's random order.
            touching: If not None, takes (world, pair) of every contact; row i of `forces` is then contact i's.
        """
        ode, at = self._ode, self._contact_at
        collide, create, attach = ode.dCollide, ode.dJointCreateContact, ode.dJointAttach
        push, mu, group, here = ode.dJointAddHingeTorque, self._mu, self._group, self._worlds[world]
        for hinge, value in zip(self._hinges[world], torque, strict=True):
            push(hinge, value)
        sides = self._sides[world]
        for pair in pairs:
            one, other, body, second = sides[pair]
            count = collide(one, other, CONTACTS, self._geom_at, self._skip)
            if count:
                mu[:count] = self._friction[pair]
                for i in range(count):
                    joint = create(here, group, at[i])
                    attach(joint, body, second)
                    if touching is not None:
                        ode.dJointSetFeedback(joint, self._feedback_at(len(touching)))
                        touching.append((world, pair))
        ode.dRandSetSeed(seed)
        self._step(here, self._timestep)
        ode.dJointGroupEmpty(group)

    def forces(self, count: int) -> Array:
        """Return the forces on the first shape of each reported contact, in world axes.

        Args:
            count: Number of reported contacts, the length of ``touching`` in `advance`.

        Returns:
            Forces [N], shape (count, 3).
        """
        return self._feedback[:count, :3].astype(float)

    def _feedback_at(self, row: int) -> int:
        return self._feedback.ctypes.data + row * self._feedback.strides[0]

    def make_room(self, contacts: int) -> None:
        """Allocate memory for the forces of this many contacts.

        Call it before the step, because joints keep the addresses.

        Args:
            contacts: Least number of contacts.
        """
        if len(self._feedback) < contacts:
            self._feedback = np.zeros((contacts, 16), self._ode.dtype)

    def _add(self, data: mujoco.MjData) -> None:
        ode, s, settings = self._ode, self._multibody, self._settings
        world = ode.dWorldCreate()
        ode.dWorldSetGravity(world, *s.gravity)
        ode.dWorldSetERP(world, settings.erp)
        ode.dWorldSetCFM(world, settings.cfm)
        ode.dWorldSetQuickStepNumIterations(world, settings.iterations)
        ode.dWorldSetQuickStepW(world, settings.relaxation)
        ode.dWorldSetContactMaxCorrectingVel(world, settings.max_correcting_velocity)
        ode.dWorldSetContactSurfaceLayer(world, settings.surface_layer)
        bodies = []
        for link, root in enumerate(s.body):
            body = ode.dBodyCreate(world)
            mass, i = ode.mass(), s.inertia[link]
            moments = (i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2])
            ode.dMassSetParameters(ctypes.byref(mass), s.mass[link], 0, 0, 0, *moments)
            ode.dBodySetMass(body, ctypes.byref(mass))
            rotation = data.xmat[root].reshape(3, 3)
            ode.dBodySetPosition(body, *(data.xpos[root] + rotation @ s.com[link]))
            ode.dBodySetQuaternion(body, ode.vector(*data.xquat[root]))
            ode.dBodySetAutoDisableFlag(body, 0)
            bodies.append(body)
        hinges = [self._hinge(world, bodies, j, data) for j in range(len(s.hinges.names))]
        motors = [self._motor(world, bodies, j, data, np.inf) for j in self._resisted]
        for j in np.flatnonzero(s.hinges.friction):
            self._motor(world, bodies, int(j), data, float(s.hinges.friction[j]))
        geoms = [
            self._static[i] if shape.link < 0 else self._geom(shape, bodies[shape.link])
            for i, shape in enumerate(s.shapes)
        ]
        self._geoms += [geom for geom, shape in zip(geoms, s.shapes, strict=True) if shape.link >= 0]
        links = [shape.link for shape in s.shapes]
        owner = [0 if link < 0 else bodies[link] for link in links]
        self._sides.append([(geoms[i], geoms[j], owner[i], owner[j]) for i, j in s.pairs])
        self._worlds.append(world)
        self._bodies.append(bodies)
        self._hinges.append(hinges)
        self._motors.append(motors)

    def _hinge(self, world: int, bodies: list[int], j: int, data: mujoco.MjData) -> int:
        ode, hinges = self._ode, self._multibody.hinges
        root = self._multibody.body[j + 1]
        rotation = data.xmat[root].reshape(3, 3)
        hinge = ode.dJointCreateHinge(world, None)
        ode.dJointAttach(hinge, bodies[j + 1], bodies[hinges.parent[j]])
        ode.dJointSetHingeAnchor(hinge, *(data.xpos[root] + rotation @ hinges.anchor[j]))
        ode.dJointSetHingeAxis(hinge, *(rotation @ hinges.axis[j]))
        # ODE knows angles within half a turn of where it was put together; a stop beyond is none
        lower, upper = hinges.lower[j] - self._middle[j], hinges.upper[j] - self._middle[j]
        for stop, value in ((library.HI_STOP, upper), (library.LO_STOP, lower), (library.HI_STOP, upper)):
            if abs(value) < np.pi:
                ode.dJointSetHingeParam(hinge, stop, value)
        return hinge

    def _motor(self, world: int, bodies: list[int], j: int, data: mujoco.MjData, torque: float) -> int:
        """Make a motor about a hinge's axis that brings it to rest, with at most this torque."""
        ode, hinges = self._ode, self._multibody.hinges
        motor = ode.dJointCreateAMotor(world, None)
        ode.dJointAttach(motor, bodies[j + 1], bodies[hinges.parent[j]])
        ode.dJointSetAMotorNumAxes(motor, 1)
        rotation = data.xmat[self._multibody.body[j + 1]].reshape(3, 3)
        ode.dJointSetAMotorAxis(motor, 0, 1, *(rotation @ hinges.axis[j]))
        ode.dJointSetAMotorParam(motor, library.VELOCITY, 0.0)
        ode.dJointSetAMotorParam(motor, library.MAX_FORCE, torque)
        return motor

    def _geom(self, shape: Shape, body: int | None = None) -> int:
        ode, size = self._ode, shape.size
        quaternion = np.empty(4)
        mujoco.mju_mat2Quat(quaternion, shape.rotation.ravel())
        if shape.kind == "plane":
            normal = shape.rotation[:, 2]
            return ode.dCreatePlane(None, *normal, float(normal @ shape.position))
        if shape.kind == "sphere":
            geom = ode.dCreateSphere(None, size[0])
        elif shape.kind == "box":
            geom = ode.dCreateBox(None, *(2.0 * size))
        elif shape.kind in ("capsule", "cylinder"):
            create = ode.dCreateCapsule if shape.kind == "capsule" else ode.dCreateCylinder
            geom = create(None, size[0], 2.0 * size[1])
        else:
            geom = self._convex(shape)
        if body is None:
            ode.dGeomSetPosition(geom, *shape.position)
            ode.dGeomSetQuaternion(geom, ode.vector(*quaternion))
        else:
            ode.dGeomSetBody(geom, body)
            ode.dGeomSetOffsetPosition(geom, *(shape.position - self._multibody.com[shape.link]))
            ode.dGeomSetOffsetQuaternion(geom, ode.vector(*quaternion))
        return geom

    def _convex(self, shape: Shape) -> int:
        hull = shape.hull
        assert hull is not None
        # ODE keeps the addresses, not the numbers
        planes, points = (np.ascontiguousarray(a, dtype=self._ode.dtype) for a in (hull.planes, hull.points))
        polygons = np.ascontiguousarray(hull.polygons, dtype=np.uint32)
        self._keep += [planes, points, polygons]
        at = [array.ctypes.data for array in (planes, points, polygons)]
        return self._ode.dCreateConvex(None, at[0], len(planes), at[1], len(points), at[2])


def _free(ode: Library, worlds: list[int], geoms: list[int], group: int) -> None:
    for geom in geoms:  # before their bodies, which they take leave of
        ode.dGeomDestroy(geom)
    for world in worlds:
        ode.dWorldDestroy(world)
    ode.dJointGroupDestroy(group)


def _memory(address: int, count: int, dtype: np.dtype) -> NDArray:
    """Return ``count`` numbers from an address on as an array. Only valid memory may be read."""

    class View:
        __array_interface__ = {  # noqa: RUF012
            "data": (address, False),
            "shape": (count,),
            "typestr": dtype.str,
            "version": 3,
        }

    return np.asarray(View())
