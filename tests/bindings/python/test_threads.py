"""Real threads on shared objects: the same answers as alone, and the GIL is not held."""

import multiprocessing
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import foretouch
from support import arm, example, swing, wall

THREADS = 8


class Threads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        avatar, scene, clip = example()
        poses = clip.poses(avatar)[::6]
        cls.query = foretouch.Query(avatar, scene)
        cls.motions = [foretouch.Motion(avatar, a, b) for a, b in zip(poses, poses[1:])]
        cls.poses = poses
        cls.expected = [cls.query.first_contacts(m).toi.copy() for m in cls.motions]

    def in_threads(self, work):
        with ThreadPoolExecutor(THREADS) as pool:
            return [future.result() for future in [pool.submit(work, i) for i in range(THREADS)]]

    def test_share_one_query(self):
        def work(_):
            return [self.query.first_contacts(motion).toi for motion in self.motions]

        for found in self.in_threads(work):
            np.testing.assert_array_equal(found, self.expected)

    def test_share_a_query_among_all_its_methods(self):
        alone = self.query.touches_at(self.motions[10], np.linspace(0, 1, 50))

        def work(i):
            if i % 3 == 0:
                return np.array_equal(
                    self.query.first_contacts_many(self.poses, threads=2).toi, self.expected)
            if i % 3 == 1:
                found = self.query.touches_at(self.motions[10], np.linspace(0, 1, 50))
                return np.array_equal(found, alone)
            return all(np.array_equal(self.query.first_contacts(m).toi, toi)
                       for m, toi in zip(self.motions, self.expected))

        self.assertTrue(all(self.in_threads(work)))

    def test_share_one_step(self):
        step = self.query.first_contacts(self.motions[10])
        expected = [repr(c) for c in step.contacts]

        def work(_):
            for _ in range(200):
                assert [repr(c) for c in step.contacts] == expected
                assert step.toi.sum() == self.expected[10].sum()
            return True

        self.assertTrue(all(self.in_threads(work)))

    def test_make_and_drop_their_own(self):
        def work(i):
            for _ in range(30):
                avatar = arm()
                scene = wall(name=str(i))
                step = foretouch.first_contacts(avatar, swing(avatar), scene)
                assert step["fore"].object == str(i)
            return True

        self.assertTrue(all(self.in_threads(work)))

    def test_forked_children_may_ask(self):
        def work(connection):
            steps = self.query.first_contacts_many(self.poses, threads=2)
            connection.send(steps.toi.copy())

        context = multiprocessing.get_context("fork")
        ours, theirs = context.Pipe()
        child = context.Process(target=work, args=(theirs,))
        child.start()
        try:
            self.assertTrue(ours.poll(60))
            np.testing.assert_array_equal(ours.recv(), self.expected)
        finally:
            child.kill()
            child.join()
            ours.close()
            theirs.close()

    def test_python_runs_on_while_a_batch_is_asked(self):
        poses = foretouch.Poses(np.tile(self.poses.rotations, (60, 1, 1)),
                                np.tile(self.poses.translations, (60, 1, 1)))
        ticks = []
        done = threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.0005)

        ticker = threading.Thread(target=tick)
        ticker.start()
        began = time.monotonic()
        self.query.first_contacts_many(poses, threads=1)
        ended = time.monotonic()
        done.set()
        ticker.join()
        during = [t for t in ticks if began < t < ended]
        self.assertGreater(len(during), 5, f"in {ended - began:.3f} s")


if __name__ == "__main__":
    unittest.main()
