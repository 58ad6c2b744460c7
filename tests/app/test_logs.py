"""Lines of the log: a fault that repeats is one line, and another one with its number when it is over."""

import logging

from app.logs import Faults


def test_a_fault_that_repeats_is_logged_once_and_counted(caplog):
    faults = Faults(logging.getLogger("faults"), "The store failed: %s")
    for fault in ("full", "gone", "full", "full"):
        faults.log(fault)
    assert caplog.messages == ["The store failed: full", "The store failed: gone"]
    faults.over()
    assert caplog.messages[2:] == ["The store failed: full (3 times; it is over)"]
    faults.over()
    faults.log("full")
    assert caplog.messages[3:] == ["The store failed: full"]
