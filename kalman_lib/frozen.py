"""Nothing is changed once it is made: the arrays of models and results are read-only."""

from dataclasses import fields


class ReadOnly:
    """A dataclass of arrays, each of them a read-only view, also once it is copied or unpickled."""

    def __post_init__(self):
        for part in fields(self):
            array = getattr(self, part.name)
            if array is not None:
                array = array.view()
                array.setflags(write=False)
                object.__setattr__(self, part.name, array)

    def __setstate__(self, state):
        self.__dict__.update(state)
        ReadOnly.__post_init__(self)


def freeze(model, **arrays):
    """Put the checked arrays into a frozen dataclass, read-only."""
    for name, array in arrays.items():
        if array is not None:
            array.setflags(write=False)
        object.__setattr__(model, name, array)
