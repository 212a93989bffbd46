"""The notebooks as they are taken home, for a branch of the repository: Colab and Binder open them
there. The branch holds nothing else, and every push replaces it.

    python book/_make/branch.py           writes _build/branch
    python book/_make/branch.py --push    and puts it into the branch `notebooks` of origin
"""

import os
import shutil
import subprocess
import sys

from places import BUILD, ROOT

sys.path.insert(0, str(ROOT / "book" / "_ext"))
from downloads import notebooks_in
from edition import edition
from first_cell import NOTEBOOKS, in_branch
from texts import LANGUAGES
from wheel import write_wheel

BRANCH = BUILD / "branch"
BINDER = ".binder"
README = """\
# {id} · {en}

Buku catatan semua bab, seperti yang diunduh dari bukunya; cabang ini dibuat oleh `make branch`.

The notebooks of all chapters as they are downloaded from the book; `make branch` makes this branch.
"""


def write_branch():
    """Both languages, each with its data and the wheel, and what Binder needs."""
    about = edition()
    shutil.rmtree(BRANCH, ignore_errors=True)
    wheel = write_wheel()
    for language in LANGUAGES:
        folder = BRANCH / language
        shutil.copytree(ROOT / "notebooks" / "data", folder / "data")
        shutil.copy(wheel, folder)
        for name, text in notebooks_in(language, about["version"], in_branch(about, language)):
            (folder / name).write_text(text, encoding="utf-8")
    shutil.copytree(ROOT / BINDER, BRANCH / BINDER)
    shutil.copy(ROOT / "LICENSE", BRANCH)
    (BRANCH / "README.md").write_text(README.format(**about["title"]), encoding="utf-8")
    return BRANCH


def push(remote="origin"):
    """One commit without a past, so that old outputs do not pile up."""
    index = {**os.environ, "GIT_INDEX_FILE": str(BUILD / "branch-index")}
    (BUILD / "branch-index").unlink(missing_ok=True)
    git("--work-tree", str(BRANCH), "add", "--force", "--all", ".", cwd=BRANCH, env=index)
    tree = git("write-tree", env=index)
    who = ["-c", f"user.name={edition()['title']['en']}", "-c", "user.email=book@localhost"]
    commit = git(*who, "commit-tree", tree, "-m", f"Edition {edition()['version']}")
    git("push", "--force", remote, f"{commit}:refs/heads/{NOTEBOOKS}")


def git(*arguments, cwd=ROOT, env=None):
    folder = subprocess.run(
        ["git", "rev-parse", "--absolute-git-dir"], cwd=ROOT, capture_output=True, text=True
    )
    command = ["git", "--git-dir", folder.stdout.strip(), *arguments]
    done = subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"git {' '.join(arguments)}\n{done.stderr}")
    return done.stdout.strip()


if __name__ == "__main__":
    print(write_branch())
    if "--push" in sys.argv[1:]:
        push()
