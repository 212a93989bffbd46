"""The package alone, on any system: python tests/package_tests.py

Installs kalman_lib with the locked versions of what it needs into the Python that runs this, and
runs the tests that ask neither for a browser nor for the book.
"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LOCK = "tests/package-needs.lock"
ROOMS = (
    "arguments beetle checks checks_functions covariances discretise fast fast_adversaries "
    "fast_contract fast_runs filters filters_runs fit gate gyro jacobians log_likelihood metrics "
    "models precision quadrotor quadrotor_filter results ship silent_sensors smoother theory tuning"
).split()


def main():
    install = [sys.executable, "-m", "pip", "install", "--disable-pip-version-check"]
    locked = ["--require-hashes", "-r", LOCK]
    package = ["--no-deps", "--no-build-isolation", "-e", "."]  # pip knows no hash of a folder
    for what in (locked, package):
        subprocess.run([*install, *what], cwd=ROOT, check=True)
    tests = [f"tests/test_{room}.py" for room in ROOMS]
    sys.exit(subprocess.run([sys.executable, "-m", "pytest", "-q", *tests], cwd=ROOT).returncode)


if __name__ == "__main__":
    main()
