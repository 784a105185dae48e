"""What a notebook shows: a table of a step, a picture of many. matplotlib is asked for only here."""

from __future__ import annotations

from html import escape
from importlib import import_module
from typing import Any, Optional

import numpy as np

from foretouch._foretouch import Contact, Step, Steps, Verdict

_HEADINGS = ["link", "verdict", "t", "meets", "apart, mm"]


def step_html(step: Step) -> str:
    """The links that are not clear, earliest first, as a table."""
    if step.is_clear:
        return f"<p>All {len(step)} links are proven clear.</p>"
    met: list[Contact] = [*step.contacts, *(step.pairs or [])]
    head = "".join(f"<th>{heading}</th>" for heading in _HEADINGS)
    rows = "".join(f"<tr>{_cells(contact)}</tr>" for contact in met)
    return (f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
            f"<p>Nothing at all is touched before t = {step.free_prefix:.6g}; "
            f"{len(step) - len(step.contacts)} of {len(step)} links are proven clear.</p>")


def _cells(contact: Contact) -> str:
    if contact.toi is None:
        shown = [contact.link, f"undecided ({contact.reason})",
                 f"free until {contact.free_until:.6g}", "", ""]
    else:
        # For two own links, the other takes the place of the scene's object.
        other = getattr(contact, "other", None) or contact.object or ""
        apart = -contact.penetration if contact.penetration else contact.separation
        shown = [contact.link, _words(contact.verdict), f"{contact.toi:.6g}", other,
                 f"{1e3 * (apart or 0.0):.3g}"]
    return "".join(f"<td>{escape(text)}</td>" for text in shown)


def plot_steps(steps: Steps, axes: Optional[Any] = None, *,
               seconds_per_step: Optional[float] = None) -> Any:
    """Over time, a row per link that is not always clear: see Steps.plot()."""
    axes = _new_axes() if axes is None else axes
    verdicts = np.asarray(steps.verdicts)
    rows = np.flatnonzero((verdicts != Verdict.CLEAR).any(axis=0))
    length = 1.0 if seconds_per_step is None else float(seconds_per_step)
    for row, link in enumerate(rows):
        for verdict, colour in [(Verdict.STARTS_IN_CONTACT, "tab:gray"),
                                (Verdict.CONTACT, "tab:orange"), (Verdict.UNDECIDED, "tab:purple")]:
            found = np.flatnonzero(verdicts[:, link] == verdict)
            # From where it is met, or no longer known to be free, to the step's end.
            free = np.asarray(steps.free_until)[found, link]
            spans = [((i + f) * length, (1.0 - f) * length) for i, f in zip(found, free)]
            axes.broken_barh(spans, (row - 0.4, 0.8), color=colour, alpha=0.6,
                             label=_words(verdict) if link == _first(verdicts, verdict) else None)
            if verdict == Verdict.CONTACT:
                axes.plot([start for start, _ in spans], [row] * len(spans), "k|")
    axes.set_yticks(range(len(rows)), labels=[steps.link_names[link] for link in rows])
    axes.set_ylim(max(len(rows), 1) - 0.5, -0.5)
    axes.set_xlim(0.0, len(steps) * length)
    axes.set_xlabel("step" if seconds_per_step is None else "seconds")
    if len(rows) > 0:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return axes


def _words(verdict: Verdict) -> str:
    return verdict.name.lower().replace("_", " ")


def _first(verdicts: Any, verdict: Verdict) -> int:
    """The first link that has it in any step; -1 if none has."""
    links = np.flatnonzero((verdicts == verdict).any(axis=0))
    return int(links[0]) if len(links) > 0 else -1


def _new_axes() -> Any:
    try:
        pyplot: Any = import_module("matplotlib.pyplot")
    except ImportError as missing:
        raise ImportError("Steps.plot() draws with matplotlib, which is not installed "
                          "(Debian: python3-matplotlib)") from missing
    return pyplot.subplots(layout="constrained")[1]
