"""A plugin of pytest: where a test looks at one file, paper or page after the other, the toy stays.

The others are the same files as in the book itself, whose own run of these tests looks at them.
"""

TOY = ("toy", "[8.", "-8.")  # its files and pages, its exercises


def pytest_collection_modifyitems(config, items):
    kept = [item for item in items if not hasattr(item, "callspec") or is_toy(item.name)]
    left_out = [item for item in items if item not in kept]
    config.hook.pytest_deselected(items=left_out)
    items[:] = kept


def is_toy(name):
    return any(mark in name for mark in TOY)
