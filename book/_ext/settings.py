"""_config.yml as it is written: in both languages, with the lines of this edition."""

import functools
from pathlib import Path

import yaml

CONFIG = Path(__file__).resolve().parent.parent.parent / "_config.yml"


@functools.cache
def settings():
    """Read once a process; whoever takes a part of it changes a copy."""
    return yaml.safe_load(CONFIG.read_text(encoding="utf-8"))


def about_edition():
    """{address, repository, version, date, newest, solutions}"""
    return settings()["sphinx"]["config"]["book_edition"]
