"""The workflows of the host: few permissions, pinned actions, nothing that does not run here."""

import re

import pytest
import yaml
from conftest import ROOT

WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
PINNED = re.compile(r"uses: [\w-]+/[\w-]+@[0-9a-f]{40} # v\d+(\.\d+)*$")
BY_HAND = ("gh release create", "python tests/package_tests.py")


def read(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def steps_of(workflow):
    return [step for job in workflow["jobs"].values() for step in job["steps"]]


def test_there_are_workflows_to_test_publish_release_and_look_again():
    names = [path.stem for path in WORKFLOWS]
    assert names == ["monthly", "publish", "release", "test"]


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_actions_are_pinned(path):
    used = [line.strip(" -") for line in path.read_text().splitlines() if "uses:" in line]
    assert used and all(PINNED.match(line) for line in used), used


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_permissions_are_few(path):
    workflow = read(path)
    assert workflow["permissions"] == {"contents": "read"}
    allowed = {"deploy": {"pages": "write", "id-token": "write"}, "release": {"contents": "write"}}
    allowed["notebooks"] = {"contents": "write"}
    for name, job in workflow["jobs"].items():
        assert job.get("permissions") == allowed.get(name), name


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_every_step_is_a_target_of_make(path):
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z-]+):.*##", makefile, re.MULTILINE))
    commands = [step["run"] for step in steps_of(read(path)) if "run" in step]
    for command in commands:
        target = command.removeprefix("make ")
        assert target in targets or command.startswith(BY_HAND), command


def test_the_tests_of_the_package_exist():
    import package_tests

    assert all((ROOT / f"tests/test_{room}.py").exists() for room in package_tests.ROOMS)
