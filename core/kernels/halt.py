"""How much a question may still do, and a flag by which another thread ends it: what loops look at as they go."""


class Halt:
    """left: work, see constants.py [1]; stopped: has anybody asked the loops to end?

    A loop that finds itself stopped ends at once, as one that gave up; whoever started it looks at the flag too, and
    takes nothing from what that loop found.
    """

    def __init__(self, left):
        self.left = left
        self.stopped = False

    def spend(self, work):
        """Take work from what is left; True where the loop has to end."""
        self.left -= work
        return self.stopped or self.left <= 0.0
