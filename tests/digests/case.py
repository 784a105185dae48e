"""A case: what is run, and which of the files that it leaves are compared.

Command lines are words with blanks between them; {data} is the folder of real recordings,
{examples} that of the bundled example, the rest is in running.py. A case runs in an empty folder of
its own.
"""
from dataclasses import dataclass, field
from typing import NamedTuple, Optional

ROOM = "--scene {examples}/room.obj"


class Run(NamedTuple):
    """A program that is run: its words, where its standard output goes, and with which exit code it
    should end. Where that is None, any will do, and is the last line of the output."""

    words: list
    out: str = ""
    exit: Optional[int] = 0


@dataclass(frozen=True)
class Case:
    name: str
    steps: list  # of Run, and of functions that are given the case's folder
    outputs: dict  # a file: how it is normalised
    data: list = field(default_factory=list)  # files of the data folder that it needs
    tools: list = field(default_factory=list)  # what else it needs: see World.TOOLS
    short: bool = False  # also in the short form, which runs with every test
    everyWidth: bool = False  # at every width of vectors that the processor has


def run(command, out="", status=0):
    return Run(command.split(), out, status)


def foretouch(command, out="", status=0):
    return run("{foretouch} " + command, out, status)


def text(name, content):
    """A step that writes a file."""
    def write(folder):
        (folder / name).write_text(content, encoding="utf-8")
    return write
