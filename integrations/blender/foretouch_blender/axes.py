"""From Blender's world to Foretouch's and back: z up to y up, Blender units to metres.

Axes are only swapped, so no digit of a coordinate is lost but by the unit. Matrices are numpy's,
(..., 4, 4), of columns; a pose's quaternions have the order w, x, y, z.
"""

import numpy as np

TO_Y_UP = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])


class Axes:
    """`unit`: metres per Blender unit."""

    def __init__(self, unit):
        self.unit = unit

    @staticmethod
    def of(scene):
        units = scene.unit_settings
        return Axes(1.0 if units.system == "NONE" else units.scale_length)

    def points(self, blender):
        """(..., 3)"""
        x, y, z = np.moveaxis(np.asarray(blender, dtype=np.float64), -1, 0)
        return np.stack([x, z, -y], axis=-1) * self.unit

    def points_back(self, metres):
        x, y, z = np.moveaxis(np.asarray(metres, dtype=np.float64), -1, 0)
        return np.stack([x, -z, y], axis=-1) / self.unit

    @staticmethod
    def directions_back(directions):
        return Axes(1.0).points_back(directions)

    def frames(self, blender):
        """Frames whose own axes stay as they are: of a bone, of a link. (..., 4, 4)"""
        placed = np.array(blender, dtype=np.float64)
        placed[..., :3, :3] = TO_Y_UP @ placed[..., :3, :3]
        placed[..., :3, 3] = self.points(placed[..., :3, 3])
        return placed

    def moves(self, blender):
        """Transforms of the world itself. (..., 4, 4)"""
        moved = self.frames(blender)
        moved[..., :3, :3] = moved[..., :3, :3] @ TO_Y_UP.T
        return moved

    def moves_back(self, moves):
        """The inverse of moves()."""
        back = np.array(moves, dtype=np.float64)
        back[..., :3, :3] = TO_Y_UP.T @ back[..., :3, :3] @ TO_Y_UP
        back[..., :3, 3] = self.points_back(back[..., :3, 3])
        return back


NEARLY_RIGID = 1e-4
"""Strain below which one step of Newton's iteration finds the nearest rotation to 1e-8."""


def strain(moves):
    """(...,): no length grows or shrinks by a larger share; about 0 of what is rigid.

    |s - 1| <= |s^2 - 1| of each singular value s >= 0, and no eigenvalue exceeds the Frobenius norm;
    where that is not small, the singular values themselves.
    """
    linear = np.asarray(moves)[..., :3, :3]
    most = np.linalg.norm(np.swapaxes(linear, -1, -2) @ linear - np.eye(3), axis=(-1, -2))
    bent = np.isfinite(most) & (most > NEARLY_RIGID)
    if np.any(bent):
        values = np.linalg.svd(linear[bent], compute_uv=False)
        most = np.array(most)
        most[bent] = np.abs(values - 1.0).max(axis=-1) + SVD_ROUNDING
    return most


SVD_ROUNDING = 1e-12
"""More than numpy's singular values of a matrix of some units are off."""


def nearest_rotations(linear):
    """(..., 3, 3)"""
    linear = np.asarray(linear, dtype=np.float64)
    squares = np.swapaxes(linear, -1, -2) @ linear
    rotations = linear @ (1.5 * np.eye(3) - 0.5 * squares)
    bent = np.linalg.norm(squares - np.eye(3), axis=(-1, -2)) > NEARLY_RIGID
    if np.any(bent):
        u, _, vt = np.linalg.svd(linear[bent])
        rotations[bent] = u @ vt
    return rotations


def quaternions(rotations):
    """(..., 3, 3) to (..., 4), unit: w, x, y, z."""
    m = rotations
    trace = np.trace(m, axis1=-2, axis2=-1)[..., None]
    diagonal = np.diagonal(m, axis1=-2, axis2=-1)
    # Four times the products of each two parts: of q q^T, every row is the quaternion but for its
    # length, and the one with the largest square loses no digits.
    ww, (xx, yy, zz) = 1.0 + trace[..., 0], np.moveaxis(1.0 - trace + 2.0 * diagonal, -1, 0)
    wx, wy, wz = m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1]
    xy, xz, yz = m[..., 1, 0] + m[..., 0, 1], m[..., 2, 0] + m[..., 0, 2], m[..., 2, 1] + m[..., 1, 2]
    rows = np.stack([np.stack(row, axis=-1) for row in (
        (ww, wx, wy, wz), (wx, xx, xy, xz), (wy, xy, yy, yz), (wz, xz, yz, zz))], axis=-2)
    largest = np.argmax(np.stack([ww, xx, yy, zz], axis=-1), axis=-1)
    found = np.take_along_axis(rows, largest[..., None, None], axis=-2)[..., 0, :]
    return found / np.linalg.norm(found, axis=-1, keepdims=True)


def rotations_of(quaternions_):
    """(..., 4) to (..., 3, 3)"""
    w, x, y, z = np.moveaxis(np.asarray(quaternions_, dtype=np.float64), -1, 0)
    return np.stack([
        np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], axis=-1),
        np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], axis=-1),
        np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=-1)],
        axis=-2)


def inverted(rigid):
    """Of rigid frames."""
    turned = np.swapaxes(rigid[..., :3, :3], -1, -2)
    back = np.zeros_like(rigid)
    back[..., :3, :3] = turned
    back[..., :3, 3] = -(turned @ rigid[..., :3, 3:])[..., 0]
    back[..., 3, 3] = 1.0
    return back


def rigid_frames(rotations, places):
    frames = np.zeros((*rotations.shape[:-2], 4, 4))
    frames[..., :3, :3] = rotations
    frames[..., :3, 3] = places
    frames[..., 3, 3] = 1.0
    return frames


def poses_of(frames, parents):
    """World frames (k, n, 4, 4) of links as rotations (k, n, 4) and translations (k, n, 3), each
    relative to its parent."""
    relative = frames.copy()
    inverse = inverted(frames)
    for link, parent in enumerate(parents):
        if parent >= 0:
            relative[:, link] = inverse[:, parent] @ frames[:, link]
    return quaternions(relative[..., :3, :3]), relative[..., :3, 3].copy()


def frames_of(rotations, translations, parents):
    """The inverse of poses_of(), of parents that stand before their children."""
    frames = rigid_frames(rotations_of(rotations), np.asarray(translations, dtype=np.float64))
    for link, parent in enumerate(parents):
        if parent >= 0:
            frames[..., link, :, :] = frames[..., parent, :, :] @ frames[..., link, :, :]
    return frames
