# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT
"""Figures of a simulation, as tuples with names. Vectors are float64 arrays of shape (3,)."""
from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]


class ColliderLoad(NamedTuple):
    """The load of particles on a collider at one instant."""

    force: Vector  #: N
    torque: Vector  #: about its pivot, N m
    contacts: int


class ColliderPose(NamedTuple):
    """Where a collider is."""

    pivot: Vector  #: m
    axes: npt.NDArray[np.float64]  #: (3, 3): where the shape's x, y and z axes point, a row each
    velocity: Vector  #: of the pivot, m/s
    angular_velocity: Vector  #: rad/s


class Measurements(NamedTuple):
    """Figures of one instant."""

    particles: int
    contacts: int  #: touching pairs of particles
    wall_contacts: int
    kinetic_energy: float  #: J
    potential_energy: float  #: of gravity, J
    elastic_energy: float  #: in contacts between particles, J
    wall_elastic_energy: float  #: in contacts with walls, J
    collider_elastic_energy: float  #: in contacts with colliders, J
    springs: int  #: that hold
    spring_energy: float  #: in them, J
    attraction_energy: float  #: J, <= 0
    momentum: Vector  #: kg m/s
    centre_of_mass: Vector  #: m
    max_speed: float  #: m/s
    max_overlap_ratio: float  #: of the deepest contact, over the sum of its radii
    mean_overlap_ratio: float  #: over touching pairs
    min: Vector  #: of the box around the centres, m
    max: Vector  #: m
    wall_force: Vector  #: by walls on particles, N
    colliders: dict[str, ColliderLoad]  #: by name


class Ledger(NamedTuple):
    """Sums over all steps so far. Causes: contact_spring, contact_shear, contact_damping, contact_friction, wall,
    collider, drag, gravity, hold, springs, field, attraction, external."""

    work: dict[str, float]  #: by cause, on particles, J
    impulse: dict[str, Vector]  #: by cause, given to particles, N s
    dissipated: float  #: by contacts between particles and by drag, J
    removed: int  #: particles that left through open faces
    removed_momentum: Vector  #: taken along by those that left, expired or sank, kg m/s
    removed_energy: float  #: kinetic and potential, likewise, J
    removed_elastic: float  #: in their contacts and springs, less that in contacts of newborns, J
    born: int  #: particles, by emitters
    expired: int  #: particles whose life ended
    sunk: int  #: particles taken away by sinks
    born_energy: float  #: kinetic and potential, brought along by those born, J
    born_momentum: Vector  #: kg m/s
    broken_springs: int


class Contacts(NamedTuple):
    """Every contact of one instant once. Arrays of one entry, or row, a contact."""

    a: npt.NDArray[np.uint64]  #: id of the particle
    b: npt.NDArray[np.uint64]  #: id of its partner; 0 where that is no particle
    kind: npt.NDArray[np.uint8]  #: of the partner: 0 a particle, 1 a wall, 2 a collider
    #: The wall: 0 to 5 for x-min, x-max, y-min, y-max, z-min, z-max; the collider's index; -1 for a particle.
    partner: npt.NDArray[np.int32]
    overlap: npt.NDArray[np.float64]  #: m; not above 0 where cohesion acts across a gap
    force: npt.NDArray[np.float64]  #: (n, 3): on a, N
    point: npt.NDArray[np.float64]  #: (n, 3): on the surface of a wall or a collider, nearest to a, m
