/* Empty on purpose: tests/prototypes.py declares the types itself. */
