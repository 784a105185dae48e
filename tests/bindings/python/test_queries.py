"""What queries answer, against closed forms; their arrays, options and counters."""

import unittest

import numpy as np

import foretouch
from foretouch import Verdict
from support import arm, bent, example, swing, wall


class Swing(unittest.TestCase):
    """A rod of 60 cm with a ball of 4 cm turns from +X to -Z, towards a wall at z = -0.3: its tip
    touches where 0.6 sin(pi/2 t) + 0.04 = 0.3."""

    TRUE_TOI = np.arcsin((0.3 - 0.04) / 0.6) / (np.pi / 2)

    def test_is_sound_and_tight(self):
        avatar, scene = arm(), wall()
        for tolerance in [1e-2, 1e-3, 1e-6, 1e-9]:
            step = foretouch.first_contacts(avatar, swing(avatar), scene, tolerance)
            fore = step["fore"]
            self.assertEqual(fore.verdict, Verdict.CONTACT)
            self.assertLessEqual(fore.toi, self.TRUE_TOI)
            gap = 0.3 - 0.04 - 0.6 * np.sin(np.pi / 2 * fore.toi)
            self.assertLessEqual(gap, tolerance * (1 + 1e-6))
            self.assertLessEqual(fore.separation, tolerance)

    def test_says_where(self):
        avatar, scene = arm(), wall(name="plaster")
        motion = swing(avatar)
        step = foretouch.first_contacts(avatar, motion, scene)
        contact = step.contacts[0]
        self.assertEqual((contact.link, contact.object, contact.object_id), ("fore", "plaster", 0))
        np.testing.assert_allclose(contact.normal, [0, 0, 1], atol=1e-9)
        np.testing.assert_allclose(contact.point[2], -0.3, atol=1e-12)
        np.testing.assert_allclose(contact.on_link - contact.point,
                                   contact.separation * contact.normal, atol=1e-9)
        self.assertIn("fore meets plaster at t=", repr(contact))
        self.assertIn("not clear", repr(step))

    def test_is_missed_by_a_discrete_check_through_a_thin_pole(self):
        avatar = arm()
        pole = foretouch.Scene.from_arrays([[0.2, 0, -0.2], [0.2, 2, -0.2], [0.21, 1, -0.21]],
                                           [[0, 1, 2]])
        motion = swing(avatar)
        self.assertFalse(foretouch.touches_at(avatar, motion, pole, [0.0, 1.0]).any())
        self.assertTrue(foretouch.touches_at(avatar, motion, pole, 0.5)[0])
        self.assertFalse(foretouch.first_contacts(avatar, motion, pole).is_clear)


class Steps(unittest.TestCase):
    def setUp(self):
        self.avatar, self.scene, clip = example()
        poses = clip.poses(self.avatar)
        self.motion = foretouch.Motion(self.avatar, poses[60], poses[66])
        self.step = foretouch.first_contacts(self.avatar, self.motion, self.scene)

    def test_arrays_are_the_contacts(self):
        step = self.step
        self.assertEqual(len(step), self.avatar.num_links)
        self.assertEqual(step.link_names, self.avatar.names)
        self.assertGreater(len(step.contacts), 3)
        for contact in step.contacts:
            i = contact.link_id
            self.assertEqual(step.verdicts[i], contact.verdict)
            self.assertEqual(step.toi[i], contact.toi)
            self.assertEqual(step.free_until[i], contact.free_until)
            self.assertEqual(step.separation[i], contact.separation)
            self.assertEqual(step.penetration[i], contact.penetration)
            self.assertEqual(step.triangles[i], contact.triangle)
            np.testing.assert_array_equal(step.points[i], contact.point)
            np.testing.assert_array_equal(step.points_on_link[i], contact.on_link)
            np.testing.assert_array_equal(step.normals[i], contact.normal)
        self.assertEqual(step.free_prefix, step.free_until.min())
        self.assertEqual((step.verdicts != Verdict.CLEAR).sum(), len(step.contacts))

    def test_arrays_cannot_be_written_to(self):
        for name in ["verdicts", "toi", "points", "triangles", "normals"]:
            with self.subTest(name), self.assertRaises(ValueError):
                getattr(self.step, name)[0] = 1

    def test_contacts_come_earliest_first(self):
        times = [c.toi if c.toi is not None else c.free_until for c in self.step.contacts]
        self.assertEqual(times, sorted(times))

    def test_clear_links_say_so(self):
        clear = self.step[int(np.argmax(self.step.verdicts == Verdict.CLEAR))]
        self.assertEqual((clear.verdict, clear.free_until), (Verdict.CLEAR, 1.0))
        for name in ["toi", "separation", "point", "normal", "triangle", "object", "reason"]:
            self.assertIsNone(getattr(clear, name))
        self.assertIn("is clear", repr(clear))


class Options(unittest.TestCase):
    def setUp(self):
        self.avatar, self.scene = arm(), wall()
        self.motion = swing(self.avatar)

    def ask(self, **options):
        return foretouch.first_contacts(self.avatar, self.motion, self.scene, **options)

    def test_ignored_links_and_objects_are_not_reported(self):
        self.assertTrue(self.ask(ignore=["upper", "fore"]).is_clear)
        self.assertTrue(self.ask(ignore=[0, ("fore", "wall")]).is_clear)
        self.assertTrue(self.ask(ignore=[(0, 0), [1, 0]]).is_clear)
        self.assertFalse(self.ask(ignore={"upper"}).is_clear)

    def test_a_name_of_several_objects_stands_for_all(self):
        corners = [[-5, -5, -0.3], [5, -5, -0.3], [5, 5, -0.3], [-5, 5, -0.3]]
        scene = foretouch.Scene.from_arrays(corners, [[0, 1, 2], [0, 2, 3]], [0, 1], ["w", "w"])
        ask = lambda ignore: foretouch.first_contacts(self.avatar, self.motion, scene, ignore=ignore)
        self.assertTrue(ask([("upper", "w"), ("fore", "w")]).is_clear)
        self.assertFalse(ask([("upper", 0), ("fore", 0)]).is_clear)

    def test_a_budget_leaves_links_undecided(self):
        step = self.ask(work_budget=0)
        self.assertEqual(step["fore"].verdict, Verdict.UNDECIDED)
        self.assertEqual(step["fore"].reason, "work-budget")
        self.assertLessEqual(step["fore"].free_until, Swing.TRUE_TOI)
        self.assertIn("undecided", repr(step["fore"]))
        self.assertIsNone(step["fore"].toi)
        self.assertEqual(self.ask(deadline_us=0)["fore"].verdict, Verdict.UNDECIDED)

    def test_policies_set_a_links_own_tolerance(self):
        coarse = self.ask(tolerance=1e-2)
        mixed = self.ask(tolerance=1e-2, policies={"fore": {"tolerance": 1e-7}})
        self.assertLess(mixed["fore"].separation, 2e-7)
        self.assertGreater(coarse["fore"].separation, 1e-6)

    def test_policies_of_a_link_and_an_object(self):
        without = self.ask(policies={("fore", "wall"): {"ignore": True}})
        self.assertEqual(without["fore"].verdict, Verdict.CLEAR)
        again = {"fore": {"ignore": True}, ("fore", 0): {"ignore": False, "tolerance": 1e-7}}
        fine = self.ask(tolerance=1e-2, policies=again)
        self.assertEqual(fine["fore"].toi, self.ask(tolerance=1e-7)["fore"].toi)
        # A pair that is ignored has no say in the link's tolerance.
        free = self.ask(tolerance=1e-2, ignore=[("fore", "wall")],
                        policies={("fore", "wall"): {"tolerance": 1e-7}})
        self.assertEqual(free["fore"].verdict, Verdict.CLEAR)

    def test_the_scope_of_the_avatar_reports_the_first_alone(self):
        step = self.ask(scope="avatar")
        self.assertEqual(step["upper"].reason, "after-first")
        self.assertEqual(step.free_prefix, step["fore"].toi)

    def test_exact_fidelity_asks_the_triangles(self):
        # A plate in the middle of the forearm: it is there where the LSS is not yet.
        plate = [[[0, 0, 0], [0.3, 0, 0], [0.3, 0.01, 0]]]
        surface = foretouch.Surface.from_triangles(self.avatar, [None, plate])
        self.assertIs(surface.avatar, self.avatar)
        self.assertEqual(surface.num_triangles, 1)
        self.assertEqual(surface.triangles("fore").shape, (1, 3, 3))
        exact = self.ask(fidelity="exact", surface=surface)["fore"]
        true_toi = np.arcsin(0.3 / 0.6) / (np.pi / 2)
        self.assertLessEqual(exact.toi, true_toi)
        self.assertLess(true_toi - exact.toi, 2e-3)
        self.assertGreater(exact.toi, self.ask()["fore"].toi)
        self.assertIn(exact.link_feature, ["vertex", "edge", "face"])
        self.assertEqual(exact.link_triangle, 0)
        policies = {"fore": {"fidelity": "exact"}}
        self.assertEqual(self.ask(policies=policies, surface=surface)["fore"].toi, exact.toi)

    def test_the_depth_of_triangles_is_not_known(self):
        # It goes through the wall from the start.
        plate = [[[0, 0, -0.03], [0.3, 0, -0.03], [0.3, 0, 0.03]]]
        surface = foretouch.Surface.from_triangles(self.avatar, [None, plate])
        step = foretouch.first_contacts(self.avatar, self.motion, wall(0.0), surface=surface,
                                        policies={"fore": {"fidelity": "exact"}})
        self.assertEqual(step["fore"].verdict, Verdict.STARTS_IN_CONTACT)
        self.assertIsNone(step["fore"].penetration)
        self.assertEqual(step["upper"].penetration, 0.04)
        np.testing.assert_array_equal(step.penetration, [0.04, np.nan])
        with self.assertRaises(ValueError):
            step.penetration[1] = 0.0

    def test_counters_count(self):
        counters = self.ask().counters
        self.assertGreater(counters["nodes"], 0)
        self.assertTrue(all(isinstance(value, int) for value in counters.values()))


class Kept(unittest.TestCase):
    def test_a_query_answers_as_the_function_does(self):
        avatar, scene, clip = example()
        poses = clip.poses(avatar)[::30]
        query = foretouch.Query(avatar, scene)
        self.assertIs(query.avatar, avatar)
        self.assertIs(query.scene, scene)
        for start, end in zip(poses, poses[1:]):
            motion = foretouch.Motion(avatar, start, end)
            kept = query.first_contacts(motion)
            once = foretouch.first_contacts(avatar, motion, scene)
            np.testing.assert_array_equal(kept.toi, once.toi)
            np.testing.assert_array_equal(kept.points, once.points)

    def test_touches_at_has_the_shape_of_t(self):
        avatar = arm()
        query = foretouch.Query(avatar, wall())
        motion = swing(avatar)
        self.assertEqual(query.touches_at(motion, 1).tolist(), [True, True])
        found = query.touches_at(motion, np.linspace(0, 1, 11))
        self.assertEqual((found.shape, found.dtype), ((11, 2), np.dtype(bool)))
        touched = found[:, 1]
        self.assertEqual(touched.tolist(), [t >= Swing.TRUE_TOI for t in np.linspace(0, 1, 11)])


if __name__ == "__main__":
    unittest.main()
