"""Where Foretouch's Python package is. Without it the add-on loads, and says how to install it."""

import importlib
import os
import sys
from pathlib import Path

import bpy

from .told import Told

VARIABLE = "FORETOUCH_PACKAGES"
"""The environment variable that names the folder, as of a test."""


def package():
    """The module `foretouch`, or Told."""
    try:
        return importlib.import_module("foretouch")
    except ImportError as error:
        reason = str(error)
    for folder in _folders():
        if not (folder / "foretouch" / "__init__.py").is_file():
            continue
        sys.path.append(str(folder))
        importlib.invalidate_caches()
        try:
            return importlib.import_module("foretouch")
        except ImportError as error:
            reason = f"{folder}: {error}"
            sys.path.remove(str(folder))
    raise Told(missing(reason))


def program():
    """The path of the program `foretouch` of the same installation, or Told."""
    from foretouch import ResourceError
    from foretouch._feet import _program  # the package's own answer to where its program is

    try:
        return _program()
    except ResourceError as error:
        raise Told(f"Foretouch's program is missing, which fits capsules to a mesh: {error}") from error


def missing(reason):
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    return (f"Blender's Python {version} does not find Foretouch ({reason}). Type into a terminal: "
            f"{install_line()} and restart Blender, or name its folder in the add-on's preferences")


def install_line():
    """Into a folder where Blender looks, whatever else its Python forbids."""
    modules = bpy.utils.user_resource("SCRIPTS", path="modules")
    return f"'{sys.executable}' -m pip install --no-deps --target '{modules}' foretouch-*.whl"


def _folders():
    named = [os.environ.get(VARIABLE, ""), _preferred()]
    return [Path(bpy.path.abspath(name)) for name in named if name] + [
        Path("/usr/lib/python3/dist-packages")]


def _preferred():
    addon = bpy.context.preferences.addons.get(__package__)
    return addon.preferences.folder if addon else ""
