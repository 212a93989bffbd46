"""The adaptive method's witnesses: a block of innovations counts once.

Neighbouring samples of an accelerometer share the same swaying: fifty of them in a second are not
fifty witnesses. So innovations are gathered for a second, and their mean is the measurement.
"""

from collections import deque

LOOKS_BACK = 2  # blocks, from which R is estimated


class Block:
    """The innovations y of one axis since its last update, and what the latest ones tell of R."""

    def __init__(self, how, dt):
        self.how = how
        self.length = max(2, round(how.block / dt))  # samples
        self.gathered = []  # y since the last update
        recent = LOOKS_BACK * self.length
        self.squares = deque(maxlen=recent)  # y^2
        self.changes = deque(maxlen=recent)  # (y - the y before)^2 / 2
        self.latest = None

    def is_full_with(self, y):
        """Take one more innovation; True where it completes the block."""
        self.squares.append(y * y)
        if self.latest is not None:
            self.changes.append((y - self.latest) ** 2 / 2)
        self.latest = y
        self.gathered.append(y)
        return len(self.gathered) == self.length

    def witness(self, P00, R):
        """The mean of the block, and its variance R; the given R is that of one sample at rest.

        What changes from sample to sample trembles, and the mean of n samples has an n-th of it;
        the rest of the noise lasts through the block, and no mean makes it smaller."""
        noise = min(max(_mean(self.squares) - P00, R), self.how.largest * R)
        trembles = _mean(self.changes)
        lasts = max(noise - trembles, self.how.lasting * noise)
        return _mean(self.gathered), trembles / self.length + lasts

    def start_again(self, moved):
        """The next block, after the update has moved the angle: later innovations are smaller by
        as much."""
        self.latest -= moved
        self.gathered = []


def _mean(values):
    return sum(values) / len(values)
