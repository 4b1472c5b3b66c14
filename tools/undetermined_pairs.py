# SPDX-License-Identifier: BSD-3-Clause
"""Makes pairs of scans whose motion the data do not determine, with their true motion.

Worlds of planes and cylinders without an end, seen by the rays of a lidar of 64 rings that turns, or
as points scattered over the same surfaces. The lidar stands at the origin of each scan. Ranges have
white noise of 1 to 2 cm and, where asked for, constant errors per ring, the same in both scans.
"""
import math
import zlib

import numpy as np

FLOOR_M = 1.7  # Height of the lidar.
FARTHEST_M = 80.0
RINGS = 64

# What the world leaves free: names of axes of the world, whose x runs along the walls.
FREE = {
    "corridor": ("x",),
    "corridor, scattered points": ("x",),
    "corridor, turned": ("x",),
    "plane": ("yaw", "x", "y"),
    "plane, scattered points": ("yaw", "x", "y"),
    "flat scan": ("yaw", "x", "y"),
    "tunnel": ("roll", "x"),
}
AXES = ("roll", "pitch", "yaw", "x", "y", "z")


def turn(axis, angle):
    """4x4 of a turn about an axis of the frame, 0 to 2."""
    T = np.eye(4)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    T[i, i] = T[j, j] = math.cos(angle)
    T[j, i] = math.sin(angle)
    T[i, j] = -T[j, i]
    return T


def plane_range(origins, directions, normal, distance):
    """Ranges to the plane normal . x = distance; inf where a ray misses it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ranges = (distance - origins @ normal) / (directions @ normal)
    return np.where(ranges > 0, ranges, np.inf)


def cylinder_range(origin, directions, axis, center, radius, inside):
    """Ranges to a cylinder about the line through `center` along axis 0 to 2 of the world."""
    flat = [k for k in range(3) if k != axis]
    offset, heading = (origin - center)[flat], directions[:, flat]
    a = np.sum(heading**2, axis=1)
    b = heading @ offset
    root = np.sqrt(np.maximum(b**2 - a * (offset @ offset - radius**2), 0))
    hit = b**2 > a * (offset @ offset - radius**2)
    ranges = (-b + (root if inside else -root)) / a
    return np.where(hit & (ranges > 0), ranges, np.inf)


class World:
    """Surfaces in a frame of its own, with x along the walls; `poles` are (x, y, radius)."""

    def __init__(self, kind, rng, poles=0):
        self.kind = kind.split(",")[0]
        self.half_width = rng.uniform(1.5, 6)
        self.radius = rng.uniform(2.5, 5)
        side = np.where(rng.random(poles) < 0.5, -1, 1)
        self.poles = np.column_stack([rng.uniform(-30, 30, poles),
                                      side * (self.half_width - rng.uniform(0.3, 0.8, poles)),
                                      rng.uniform(0.05, 0.15, poles)])
        self.room = rng.uniform(2, 6, 4)  # Of the flat scan: distances of its four walls.

    def ranges(self, origin, directions):
        """To the nearest surface, inf where there is none."""
        y, z = np.eye(3)[1:]
        if self.kind == "tunnel":
            return cylinder_range(origin, directions, 0, np.zeros(3), self.radius, True)
        if self.kind == "flat scan":
            walls = [(n, d) for n, d in zip((np.eye(3)[0], -np.eye(3)[0], y, -y), self.room)]
        else:
            walls = [(-z, FLOOR_M)]
            if self.kind == "corridor":
                walls += [(y, self.half_width), (-y, self.half_width)]
        found = [plane_range(origin, directions, *wall) for wall in walls]
        found += [cylinder_range(origin, directions, 2, np.array([px, py, 0]), radius, False)
                  for px, py, radius in self.poles]
        return np.min(found, axis=0)

    def scattered(self, rng, count):
        """Points spread evenly over 40 m of the surfaces."""
        x, across = rng.uniform(-20, 20, count), rng.uniform(-20, 20, count)
        if self.kind == "corridor":
            height = rng.uniform(-FLOOR_M, 2, count)
            points = np.column_stack([x, rng.choice([-1, 1], count) * self.half_width, height])
            on_floor = rng.random(count) < 0.4
            points[on_floor, 1] = rng.uniform(-self.half_width, self.half_width, on_floor.sum())
            points[on_floor, 2] = -FLOOR_M
        else:
            points = np.column_stack([x, across, np.full(count, -FLOOR_M)])
        return points


def fire(kind, rng, azimuth_step_deg):
    """Directions of one turn of the lidar and the ring of each."""
    lowest, highest = {"tunnel": (-15, 15)}.get(kind, (-24.8, 2))
    elevations = np.radians([0] if kind == "flat scan" else np.linspace(lowest, highest, RINGS))
    azimuths = np.radians(np.arange(0, 360, azimuth_step_deg) + rng.uniform(0, azimuth_step_deg))
    ring, azimuth = np.divmod(np.arange(len(elevations) * len(azimuths)), len(azimuths))
    up, around = elevations[ring], azimuths[azimuth]
    return np.column_stack([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around),
                            np.sin(up)]), ring


def motion(kind, rng):
    """4x4 of a short drive in the world's frame, mostly along x."""
    T = turn(2, math.radians(rng.uniform(-1, 1)))
    if kind == "tunnel":
        T = turn(0, math.radians(rng.uniform(-1, 1))) @ T
    T[:2, 3] = rng.uniform(0.3, 1), rng.uniform(-0.1, 0.1)
    return T


def make_pair(kind, seed, poles=0, ring_bias_m=0.0):
    """Source, target (n x 3 points each), T_target_source and the free directions: unit vectors of
    six components, rotation first, in the axes of the source."""
    rng = np.random.default_rng([seed, poles, zlib.crc32(kind.encode())])
    world = World(kind, rng, poles)
    # The lidar's own axes, seen from the world.
    mounting = turn(2, math.radians(rng.uniform(20, 70)) if kind.endswith("turned") else 0)
    noise_m = rng.uniform(0.01, 0.02)
    azimuth_step_deg = rng.choice([0.4, 0.8])
    biases = ring_bias_m * rng.standard_normal(RINGS)
    T_world = [mounting, motion(kind, rng) @ mounting]
    clouds = []
    for T in T_world:
        if kind.endswith("scattered points"):
            # Both scans see the same 40 m about the lidar; the surfaces go on along x.
            points = world.scattered(rng, 20000)
            points[:, 0] += T[0, 3]
            points = (points - T[:3, 3]) @ T[:3, :3]
            points += noise_m * rng.standard_normal(points.shape)
        else:
            directions, ring = fire(kind, rng, azimuth_step_deg)
            ranges = world.ranges(T[:3, 3], directions @ T[:3, :3].T)
            seen = ranges < FARTHEST_M
            ranges = ranges + noise_m * rng.standard_normal(len(ranges)) + biases[ring]
            points = (ranges[:, None] * directions)[seen]
        clouds.append(points)
    free = []
    for name in FREE[kind] if poles == 0 else ():
        axis = np.zeros(6)
        axis[AXES.index(name)] = 1
        free.append(np.concatenate([T_world[1][:3, :3].T @ axis[:3],
                                    T_world[1][:3, :3].T @ axis[3:]]))
    return clouds[1], clouds[0], np.linalg.inv(T_world[0]) @ T_world[1], free


def write_ply(path, points):
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {len(points)}\nproperty float x\nproperty float y\n"
              "property float z\nend_header\n")
    path.write_bytes(header.encode() + points.astype("<f4").tobytes())
