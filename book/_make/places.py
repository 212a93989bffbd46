"""Where the build finds and leaves things."""

from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
BUILD = ROOT / "_build"
SITE = BUILD / "site"
LITE = BUILD / "lite"  # what `make lite` made of this build
CACHE = BUILD / "cache"  # executed notebooks, common to both languages
