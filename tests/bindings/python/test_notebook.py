"""What a notebook shows of answers: tables, and pictures where matplotlib is installed."""

import importlib.util
import re
import sys
import unittest
from unittest import mock

import numpy as np

import foretouch
from foretouch import Verdict
from support import arm, example, swing, wall


class Recorder:
    """Stands for matplotlib's axes, and keeps what is drawn on it."""

    def __init__(self):
        self.calls = []

    def __getattr__(self, name):
        return lambda *arguments, **keywords: self.calls.append((name, arguments, keywords))

    def of(self, name):
        return [(arguments, keywords) for called, arguments, keywords in self.calls if called == name]


def swung(scene, **options):
    avatar = arm()
    return foretouch.first_contacts(avatar, swing(avatar), scene, **options)


class Tables(unittest.TestCase):
    def test_show_what_is_met_and_escape_names(self):
        step = swung(wall(name="<b>wall</b>"))
        text = step._repr_html_()
        self.assertEqual(text.count("<tr>"), 1 + len(step.contacts))
        self.assertIn("&lt;b&gt;wall", text)
        self.assertNotIn("<b>wall", text)
        self.assertIn(f"<td>{step.contacts[0].toi:.6g}</td>", text)

    def test_of_a_free_step_say_that_it_is_proven(self):
        step = swung(wall(z=5))
        self.assertIn("All 2 links are proven clear", step._repr_html_())

    def test_of_what_is_undecided_say_why(self):
        step = swung(wall(), work_budget=0)
        self.assertIn("undecided (work-budget)", step._repr_html_())


class Plots(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        avatar, scene, clip = example()
        cls.steps = foretouch.first_contacts_many(avatar, clip.poses(avatar)[::6], scene)

    def test_have_a_bar_for_each_contact_where_it_is_made(self):
        axes = Recorder()
        self.assertIs(self.steps.plot(axes, seconds_per_step=0.1), axes)
        spans = [span for (given, _), keywords in axes.of("broken_barh") for span in given]
        self.assertEqual(len(spans), int((self.steps.verdicts != Verdict.CLEAR).sum()))
        marks = np.concatenate([given[0] for given, _ in axes.of("plot")])
        made = np.argwhere(self.steps.verdicts == Verdict.CONTACT)
        expected = [(step + self.steps.toi[step, link]) * 0.1 for step, link in made]
        np.testing.assert_allclose(sorted(marks), sorted(expected))
        labels = axes.of("set_yticks")[0][1]["labels"]
        self.assertEqual(len(labels), len(axes.of("broken_barh")) // 3)
        self.assertIn("LeftHand", labels)

    def test_are_refused_by_name_without_matplotlib(self):
        with mock.patch.dict(sys.modules, {"matplotlib": None}):
            with self.assertRaisesRegex(ImportError, r"Steps.plot\(\) draws with matplotlib"):
                self.steps.plot()

    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "needs matplotlib")
    def test_are_drawn_by_matplotlib(self):
        from matplotlib.figure import Figure

        figure = Figure()
        axes = self.steps.plot(figure.add_subplot())
        figure.canvas.draw() if hasattr(figure.canvas, "draw") else None
        self.assertTrue(re.search("LeftHand", str([t.get_text() for t in axes.get_yticklabels()])))

    def test_importing_the_package_does_not_import_matplotlib(self):
        source = (foretouch.__path__[0] + "/_notebook.py")
        with open(source, encoding="utf-8") as file:
            top = [line for line in file if re.match(r"(import|from) ", line)]
        self.assertFalse([line for line in top if "matplotlib" in line])


if __name__ == "__main__":
    unittest.main()
