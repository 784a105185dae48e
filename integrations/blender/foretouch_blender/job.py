"""An operator that works in slices: with a progress bar and Esc in a window, at once in a script."""

import time

from . import library
from .told import Told

SLICE_S = 0.05
"""So that the window redraws and hears Esc twenty times a second."""


class Job:
    """A mixin. `steps(context)` yields the share that is done, writes nothing into the file before its
    last part, and returns what is reported. Closing it half-way leaves nothing behind."""

    def execute(self, context):
        self.work = self.guarded(context)
        for _ in self.work:
            pass
        return self.outcome

    def invoke(self, context, _):
        self.work = self.guarded(context)
        manager = context.window_manager
        self.timer = manager.event_timer_add(SLICE_S / 5, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.work.close()
            self.report({"WARNING"}, "Cancelled: nothing was changed")
            return self.end(context, {"CANCELLED"})
        if event.type == "TIMER":
            until = time.monotonic() + SLICE_S
            while time.monotonic() < until:
                try:
                    share = next(self.work, None)
                except BaseException:  # a mistake of ours: the window must not keep waiting
                    self.end(context, {"CANCELLED"})
                    raise
                if share is None:
                    return self.end(context, self.outcome)
            self.tell(context, share)
        return {"RUNNING_MODAL"}  # whatever else the user does waits: the scene must not change

    def guarded(self, context):
        self.outcome = {"CANCELLED"}
        try:
            message = yield from self.steps(context)
            self.report({"INFO"}, message)
            self.outcome = {"FINISHED"}
        except Told as told:
            self.report({"ERROR"}, str(told))
        except (ValueError, OSError) as error:  # foretouch.Error is one of them
            if not isinstance(error, library.package().Error):
                raise
            self.report({"ERROR"}, f"Foretouch: {error}")

    def tell(self, context, share):
        manager = context.window_manager
        manager.progress_update(100 * share)
        manager.foretouch_progress = 100 * share
        context.workspace.status_text_set(f"Foretouch: {100 * share:.0f} %, Esc cancels")
        redraw(context)

    def end(self, context, outcome):
        manager = context.window_manager
        manager.event_timer_remove(self.timer)
        manager.progress_end()
        manager.foretouch_progress = -1
        context.workspace.status_text_set(None)
        redraw(context)
        return outcome


def redraw(context):
    for area in context.screen.areas:
        area.tag_redraw()


def scaled(steps, begin, end):
    """A part of the work, that takes the bar from `begin` to `end`."""
    while True:
        try:
            share = next(steps)
        except StopIteration as stop:
            return stop.value
        yield begin + (end - begin) * share
