"""Plans a robot's way by an RRT in numpy, on edges that Foretouch proves: plan_arm.py ROBOT.urdf
SCENE [SEED [FOLDER]]. Into the folder it writes why the way is free, for foretouch-verify."""

import sys

import numpy as np

import foretouch


class MotionValidator:
    """Asked as OMPL asks one, about states that are numpy arrays."""

    def __init__(self, edges):
        self.edges, self.asked = edges, 0

    def check_motion(self, q0, q1):
        self.asked += 1
        return bool(self.edges.answer([q0], [q1]).usable[0])


def plan(validator, lower, upper, start, goal, random, step=0.5, tries=20_000):
    """The states of a way from start to goal."""
    states, parents = [start], [-1]
    for _ in range(tries):
        towards = goal if random.random() < 0.1 else random.uniform(lower, upper)
        nearest = int(np.argmin(np.linalg.norm(np.array(states) - towards, axis=1)))
        way = towards - states[nearest]
        state = states[nearest] + min(1.0, step / max(np.linalg.norm(way), 1e-9)) * way
        if not validator.check_motion(states[nearest], state):
            continue
        states.append(state)
        parents.append(nearest)
        if validator.check_motion(state, goal):
            found, at = [goal], len(states) - 1
            while at >= 0:
                found, at = [states[at], *found], parents[at]
            return np.array(found)
    raise SystemExit("no way was found")


def main(urdf, scene, seed="1", folder=None):
    robot = foretouch.Robot.load_urdf(urdf)
    edges = foretouch.EdgeQuery(robot, foretouch.Scene.load(scene), clearance=0.005)
    validator, random = MotionValidator(edges), np.random.default_rng(int(seed))
    lower, upper = np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)
    drawn = random.uniform(lower, upper, (1000, robot.num_coordinates))
    free = [q for q in drawn if validator.check_motion(q, q)]
    if len(free) < 2:
        sys.exit(edges.answer(drawn, drawn).describe())
    way = plan(validator, lower, upper, free[0], free[1], random)
    for verdict in {str(edge.verdict) for edge in edges.answer(way[:-1], way[1:])}:
        print(f"a way of {len(way) - 1} edges, {verdict}; {validator.asked} were asked")
    if folder is not None:
        print(f"{edges.certify(way[:-1], way[1:], folder).proven.sum()} of them are proven")


if __name__ == "__main__":
    main(*sys.argv[1:])
