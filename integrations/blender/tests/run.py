"""Runs the tests inside Blender: blender -b --factory-startup --python-exit-code 1 --python run.py -- NAME..."""

import os
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
names = sys.argv[sys.argv.index("--") + 1:]
result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromNames(names))
sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)
