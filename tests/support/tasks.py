"""A module of child processes for tests of pools: python -m app.start tests.support.tasks"""

import os
import subprocess
import sys
import time

from app.processes.parent import answer_tasks


def answer(task, report):
    """What a task asks for: its own length, a print, a long time with a report, or memory."""
    word = bytes(task)
    if word == b"print":
        os.write(1, b"straight to the file descriptor\n")
        print("by Python", flush=True)
    elif word == b"sleep":
        child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
        report(b"%d" % child.pid)
        time.sleep(600.0)
    elif word == b"memory":
        len(b"x" * 300_000_000)
    return b"%d %d" % (os.getpid(), len(task))


def main():
    answer_tasks(answer)
