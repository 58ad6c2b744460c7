"""Work that a question may still do, and a flag by which another thread ends it: every loop checks both as it runs."""


class Halt:
    """left: work that remains, see constants.py [1]; stopped: whether another thread asked the loops to end.

    A loop that finds the flag set ends at once, like one that gave up. Its caller checks the flag too, and uses nothing
    that a stopped loop found.
    """

    def __init__(self, left):
        self.left = left
        self.stopped = False

    def spend(self, work):
        """Subtract work from what is left; True if the loop has to end."""
        self.left -= work
        return self.stopped or self.left <= 0.0
