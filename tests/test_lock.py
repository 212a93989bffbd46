"""The locks: every package in one exact version with its hashes, for every Python and system."""

import re
import tomllib

import pytest
from conftest import ROOT
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

LOCKS = (
    "requirements.lock",
    ".binder/requirements.txt",
    "tests/package-needs.lock",
    "book/lite/needs.lock",
)
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
SYSTEMS = {"linux": ("Linux", "posix"), "win32": ("Windows", "nt"), "darwin": ("Darwin", "posix")}
HASH = re.compile(r"--hash=sha256:[0-9a-f]{64}")
INSTALL = re.compile(r"pip.? install\b.*")
each_lock = pytest.mark.parametrize("name", LOCKS)


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def entries(name):
    """[(Requirement, number of its hashes), ...] of a lock."""
    joined = text_of(name).replace("\\\n", " ")
    lines = [line for line in joined.splitlines() if line.strip()]
    return [(Requirement(HASH.sub("", line).strip()), len(HASH.findall(line))) for line in lines]


def places():
    """The environments of all Pythons and systems, as the markers of a lock see them."""
    for python in PYTHONS:
        for system, (name, os_name) in SYSTEMS.items():
            yield {
                "python_version": python,
                "python_full_version": f"{python}.0",
                "sys_platform": system,
                "platform_system": name,
                "os_name": os_name,
                "platform_machine": "x86_64",
                "platform_python_implementation": "CPython",
                "implementation_name": "cpython",
            }


def chosen(name, place):
    """{package: version} that this lock installs there."""
    found = {}
    for requirement, _ in entries(name):
        if requirement.marker is None or requirement.marker.evaluate(place):
            package = canonicalize_name(requirement.name)
            assert package not in found, (package, place)
            (pin,) = requirement.specifier
            found[package] = pin.version
    return found


def direct(name):
    """What a lock is made from."""
    about = tomllib.loads(text_of("pyproject.toml"))["project"]
    extras = about["optional-dependencies"]
    package = [*about["dependencies"], *extras["chapters"]]
    wanted = {
        "requirements.lock": without_comments("requirements.txt"),
        ".binder/requirements.txt": [*package, *extras["notebook"], "setuptools"],
        "tests/package-needs.lock": [*package, *without_comments("tests/package-needs.txt")],
        "book/lite/needs.lock": without_comments("book/lite/needs.txt"),
    }[name]
    found = [Requirement(line) for line in wanted]
    return [requirement for requirement in found if requirement.name != about["name"]]


def without_comments(name):
    lines = [line.partition("#")[0].strip() for line in text_of(name).splitlines()]
    return [line for line in lines if line]


@each_lock
def test_every_package_is_pinned_and_has_its_hashes(name):
    for requirement, hashes in entries(name):
        (pin,) = requirement.specifier
        assert pin.operator == "==" and "*" not in pin.version, requirement
        assert hashes > 0 and requirement.url is None, requirement


@each_lock
def test_it_names_no_place_to_fetch_from(name):
    assert not re.search(r"https?:|file:|--(index|extra|find)|@ ", text_of(name))


@each_lock
def test_one_version_of_all_that_is_asked_for_on_every_python_and_system(name):
    for place in places():
        versions = chosen(name, place)
        for requirement in direct(name):
            version = versions[canonicalize_name(requirement.name)]
            assert requirement.specifier.contains(version), (requirement, place)


@pytest.mark.parametrize("name", LOCKS[1:])
def test_a_smaller_lock_says_the_same(name):
    """A package in both has one version."""
    for place in places():
        whole = chosen("requirements.lock", place)
        for package, version in chosen(name, place).items():
            assert whole.get(package, version) == version, package


def commands():
    """Every command that installs from a lock: [(file, line), ...]."""
    folders = [ROOT / ".github" / "workflows", ROOT / ".ci", ROOT / ".binder"]
    files = [path for folder in folders for path in folder.iterdir() if path.suffix != ".txt"]
    files.append(ROOT / "Makefile")
    found = []
    for path in files:
        for line in path.read_text(encoding="utf-8").splitlines():
            call = INSTALL.search(line)
            if call and not line.lstrip().startswith("#"):
                found.append((path.name, call[0]))
    return found


def test_what_installs_a_lock_asks_for_hashes():
    checked = 0
    for name, line in commands():
        if any(f"-r {lock}" in line for lock in LOCKS):
            assert "--require-hashes" in line, (name, line)
            checked += 1
        assert "-c requirements.lock" not in line, (name, line)  # pip refuses a folder then
    assert checked > 0


def test_npm_runs_no_script_of_a_package():
    sources = [*(ROOT / "book").rglob("*.py"), *(ROOT / "tests").rglob("*.py")]
    sources += [ROOT / "Makefile", *(ROOT / ".github" / "workflows").iterdir()]
    sources += [*(ROOT / ".ci").iterdir(), *(ROOT / ".binder").iterdir()]
    called = []
    for path in sources:
        if "node_modules" in path.parts or path.name == "test_lock.py":
            continue
        for line in path.read_text(encoding="utf-8").splitlines():
            if re.search(r'npm (ci|install|i)\b|\["ci"', line):
                called.append((path.name, "--ignore-scripts" in line))
    assert called and all(silent for _, silent in called), called
