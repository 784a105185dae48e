"""python3 smpl_oracle.py FOLDER: a small body model and a motion as numpy saves them, and where the
joints are by Rodrigues' formula and matrices: a line per frame and joint."""

import sys

import numpy as np

folder = sys.argv[1]
random = np.random.default_rng(1)
JOINTS, VERTICES, SHAPES, FRAMES = 24, 40, 3, 5
parents = np.array([-1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 12, 13, 14, 16, 17, 18, 19, 20, 21])
vertices = random.normal(size=(VERTICES, 3))
regressor = random.random((JOINTS, VERTICES))
regressor /= regressor.sum(axis=1, keepdims=True)
shapes = random.normal(size=(VERTICES, 3, SHAPES)) * 0.1
betas = np.array([0.5, -1.0, 0.25, 0.75])  # one more than the model has
poses = random.normal(size=(FRAMES, 3 * JOINTS))
poses[0, :6] = 0.0  # no turn at all
trans = random.normal(size=(FRAMES, 3))

tree = np.stack([parents, np.arange(JOINTS)]).astype(np.uint32)  # the root's parent is 2^32 - 1
body = dict(v_template=vertices, J_regressor=regressor, shapedirs=shapes, kintree_table=tree)
np.savez(folder + "/body.npz", **body)
np.savez(folder + "/flat.npz", **{k: v for k, v in body.items() if k != "shapedirs"})
np.savez(folder + "/wide.npz", **dict(body, v_template=vertices[:-1]))
np.savez(folder + "/late.npz", **dict(body, kintree_table=tree[:, ::-1].astype(np.int64)))
motion = dict(poses=poses, trans=trans, betas=betas, mocap_framerate=np.array(120.0),
              gender=np.array("neutral"))
np.savez_compressed(folder + "/motion.npz", **motion)
np.savez(folder + "/unrated.npz", poses=poses, trans=trans)
np.savez(folder + "/hands.npz", **dict(motion, poses=np.zeros((FRAMES, 156))))
np.savez(folder + "/short.npz", **dict(motion, trans=trans[:-1]))
np.savez(folder + "/still.npz", **dict(motion, betas=np.zeros(10)))


def turn(v):
    angle = np.linalg.norm(v)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = v / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)


rest = regressor @ (vertices + shapes @ betas[:SHAPES])
with open(folder + "/expected.txt", "w") as out:
    for f in range(FRAMES):
        turns, places = [], []
        for j in range(JOINTS):
            local = turn(poses[f, 3 * j:3 * j + 3])
            if j == 0:
                turns.append(local)
                places.append(rest[0] + trans[f])
            else:
                p = parents[j]
                turns.append(turns[p] @ local)
                places.append(places[p] + turns[p] @ (rest[j] - rest[p]))
            out.write("%.17g %.17g %.17g\n" % tuple(places[-1]))
