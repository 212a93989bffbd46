"""The live explorers compute what Python computes: the same z and u give the same numbers.

Papers are found in kalman_lib.papers; none is listed here.
"""

import contextlib
import dataclasses
import importlib
import inspect
import itertools
import json
import shutil
import subprocess

import explorers as explorers_to_bundle
import numpy as np
import offline
import pytest
from explorer_cases import cases
from explorer_helpers import PAPERS, SETS, SOURCES, close, listed

from kalman_lib import kalman_filter, nees, nis, rmse, rts_smooth
from kalman_lib.papers import describe

OWN_MOTION = {
    "quadrotor"
}  # simulate is a flight, not the model's own noise: see test_explorer_quadrotor.py

RUN = """text => {
  const { papers, metrics } = KalmanExplorers;
  const numbers = list => list && Float64Array.from(list, value => value === null ? NaN : value);
  return JSON.stringify(JSON.parse(text).map(({ paper, p, z, u, x }) => {
    const { model, run, twins = {} } = papers[paper];
    const data = { z: numbers(z), u: numbers(u), x: numbers(x) }, { n, m } = model(p);
    data.T = data.z.length / m;
    const result = run(p, data), smooth = papers.ship.rtsSmooth(result), out = {};
    for (const name of ["x_pred", "P_pred", "x", "P", "y", "S",
      "K"]) out[name] = Array.from(result[name]);
    Object.assign(out, { x_smooth: Array.from(smooth.x), P_smooth: Array.from(smooth.P),
      rmse: Array.from(metrics.rmse(data.x, result.x, n)), nees: Array.from(metrics.nees(data.x,
        result.x, result.P, n)),
      nis: Array.from(metrics.nis(result.y, result.S, m)) });
    out.twins = Object.fromEntries(Object.entries(twins).map(([name, call]) => [name, [call(p,
      data, result)].flatMap(value => typeof value === "number" ? [value] : Array.from(value))]));
    return out;
  }));
}"""


def python_numbers(module, name, p, trajectory, result):
    """What the Python function `name` says; its parameters are found by their names (x: all
    states where P is wanted, too, else the first). A complex number counts as two; NaN alone:
    the function refuses."""
    function = getattr(module, name)
    wanted = [
        parameter.name
        for parameter in inspect.signature(function).parameters.values()
        if parameter.default is parameter.empty
    ]
    known = {
        "p": p,
        "z": trajectory.z[:, 0],
        "truth": trajectory.x[:, 0],
        "result": result,
        "K": result.K[0, 0, 0],
        **dict.fromkeys(("flight", "walk", "run", "trajectory"), trajectory),
        **dataclasses.asdict(p),
        "x": result.x if "P" in wanted else result.x[:, 0],
        "P": result.P,
    }
    try:
        parts = [
            np.ravel(part) for part in np.atleast_1d(function(*(known[word] for word in wanted)))
        ]
    except ValueError:
        return np.array([np.nan])
    values = np.concatenate(parts)
    return values.view(float) if np.iscomplexobj(values) else values


def well_conditioned(P):
    sigma = np.sqrt(np.einsum("kii->ki", P))
    return (sigma > 0).all() and np.linalg.cond(
        P / (sigma[:, :, None] * sigma[:, None, :])
    ).max() < 1e4


def in_python(module, p, t, twins):
    """What Python computes: key -> (array, columns); no inverse of a covariance that has none
    worth the name."""
    with np.errstate(all="ignore"):
        result = kalman_filter(module.model(p), t.z, t.u)
        n, m = t.x.shape[1], t.z.shape[1]
        numbers = {
            key: (getattr(result, key), size)
            for key, size in dict(
                x_pred=n, P_pred=n * n, x=n, P=n * n, y=m, S=m * m, K=n * m
            ).items()
        }
        numbers["rmse"] = rmse(t.x, result.x), n
        with contextlib.suppress(ValueError):  # two sensors without noise are refused
            numbers["nis"] = nis(result.y, result.S), 1
        if well_conditioned(result.P):
            numbers["nees"] = nees(t.x, result.x, result.P), 1
        if well_conditioned(result.P_pred):
            smooth = rts_smooth(result)
            numbers |= {"x_smooth": (smooth.x, n), "P_smooth": (smooth.P, n * n)}
        for key in twins:
            values = python_numbers(module, key, p, t, result)
            numbers[key] = values, len(values)
    return numbers


def doubts(module, p, t, twins, numbers):
    """How much Python's numbers change when z and p change in their last digit, times 100: key
    -> array. Where a filter is chaotic (the beetle's, far from the truth) or subtracts huge
    numbers (a ship at 10^7 m/s), this is far more than 10^-9."""
    rng, moved = np.random.default_rng(0), {}
    for _ in range(3):
        z = t.z * (1 + 4.5e-16 * rng.choice([-1, 1], size=t.z.shape))
        near = {
            name: value * (1 + 4.5e-16 * rng.choice([-1, 1]))
            for name, value in dataclasses.asdict(p).items()
            if isinstance(value, float)
        }
        ends = describe(type(p))
        q = dataclasses.replace(
            p,
            **{
                name: min(max(value, ends[name]["min"]), ends[name]["max"])
                for name, value in near.items()
            },
        )
        for key, (values, columns) in in_python(
            module, q, dataclasses.replace(t, z=z), twins
        ).items():
            if key in numbers and np.size(values) == np.size(numbers[key][0]):
                change = np.nan_to_num(
                    np.abs(
                        np.reshape(values, (-1, columns))
                        - np.reshape(numbers[key][0], (-1, columns))
                    )
                )
                moved[key] = np.maximum(moved.get(key, 0), change)
    return {
        key: 100 * (change.max(axis=0) if "smooth" in key else np.maximum.accumulate(change))
        for key, change in moved.items()
    }


def differences(name, page):
    """Where JavaScript and Python disagree on one paper, one sentence after the other."""
    module, all_cases = importlib.import_module(f"kalman_lib.papers.{name}"), cases(name)
    assert len(all_cases) > 2 * len(describe(module.Params)) + SETS
    question = [
        {
            "paper": name,
            "p": dataclasses.asdict(p),
            "z": listed(t.z),
            "u": listed(t.u),
            "x": listed(t.x),
        }
        for p, t in all_cases
    ]
    answers = json.loads(page.evaluate(RUN, json.dumps(question)))
    compared = set()
    for number, ((p, t), answer) in enumerate(zip(all_cases, answers)):
        twins = answer.pop("twins")
        numbers, answer = in_python(module, p, t, twins), answer | twins
        compared |= set(numbers)
        wrong = {
            key for key, (theirs, columns) in numbers.items() if close(answer[key], theirs, columns)
        }
        doubt = (
            doubts(module, p, t, twins, numbers) if wrong and number > 0 else {}
        )  # the default case has no excuse
        for key in sorted(wrong):
            if trouble := close(answer[key], *numbers[key], doubt.get(key, 0)):
                yield f"{key}: {trouble} ({p})"
    assert {"x", "P", "K", "rmse", "nis", "nees", "x_smooth", "P_smooth"} <= compared


@pytest.mark.parametrize("name", PAPERS)
def test_the_page_computes_what_python_computes(name, bundle):
    assert bundle.evaluate("name => name in KalmanExplorers.papers", name), (
        f"book/explorers/papers/{name} is missing"
    )
    assert list(itertools.islice(differences(name, bundle), 3)) == []


# Where the first p.name of model(p) stands in a file, and which name it is
FIRST_PARAMETER = """
import { readFileSync } from "node:fs";
import { parse } from "acorn";

const tree = parse(readFileSync(process.argv[1], "utf8"), { ecmaVersion: 2023,
  sourceType: "module" });
const model = tree.body.map(({ declaration }) => declaration).find((found) =>
  found?.id?.name === "model");
const found = [];
const visit = (node) => {
  if (node.type === "MemberExpression" && node.object.name === "p") {
    found.push({ start: node.start, end: node.end, name: node.property.name });
  }
  for (const child of Object.values(node).flat()) {
    if (child?.type) {
      visit(child);
    }
  }
};
visit(model);
console.log(JSON.stringify(found.sort((a, b) => a.start - b.start)[0]));
"""


def with_a_wrong_sign(file):
    """The text of a model.js in which the first parameter that model(p) uses is wrong.

    A minus alone would not show where it is squared.
    """
    command = [str(offline.node_binary()), "--input-type=module", "-e", FIRST_PARAMETER, str(file)]
    made = subprocess.run(
        command, cwd=offline.BOOK, capture_output=True, check=True, encoding="utf-8"
    )
    place = json.loads(made.stdout)
    text = file.read_text(encoding="utf-8").encode("utf-16-le")  # acorn counts as JavaScript does
    start, end = 2 * place["start"], 2 * place["end"]
    changed = text[:start] + f"(-1.5 * p.{place['name']})".encode("utf-16-le") + text[end:]
    return changed.decode("utf-16-le")


@pytest.mark.parametrize("name", PAPERS)
def test_one_wrong_sign_is_found(name, tmp_path, chromium):
    """The comparison itself is tested: the first parameter in the JavaScript model is wrong."""
    sources = tmp_path / "explorers"
    shutil.copytree(SOURCES, sources)
    file = sources / "papers" / name / "model.js"
    file.write_text(with_a_wrong_sign(file), encoding="utf-8")
    explorers_to_bundle.bundle(tmp_path, "en", sources)
    page = chromium.new_page()
    with_smoother = dict.fromkeys([name, "ship"])  # which has it for all
    for script in explorers_to_bundle.scripts(with_smoother):
        page.add_script_tag(path=tmp_path / f"{script}.js")
    assert next(differences(name, page), None) is not None
    page.close()


def test_a_wrong_sign_leaves_valid_javascript(tmp_path):
    """Whatever the parameter stands in: -p.T ** 2 would be none."""
    file = tmp_path / "model.js"
    file.write_text(
        '// "é" and "𝄞"\nexport function model(p) {\n  return { Q: p.T ** 2 };\n}\n',
        encoding="utf-8",
    )
    assert "Q: (-1.5 * p.T) ** 2" in with_a_wrong_sign(file)


@pytest.mark.parametrize("name", sorted(set(PAPERS) - OWN_MOTION))
def test_the_noise_of_the_page_is_that_of_the_model(name, bundle):
    mean = bundle.evaluate(
        """name => {
      const { papers, tables, random, metrics } = KalmanExplorers, { model, simulate,
        run } = papers[name];
      const p = Object.fromEntries(Object.entries(tables[name]).map(([key, field]) => [key,
        field.default]));
      const means = Array.from({ length: 100 }, (_, seed) => {
        const data = simulate(p, random.generator(seed)), result = run(p, data);
        return metrics.mean(metrics.nis(result.y, result.S, result.m)) / result.m;
      });
      return metrics.mean(means);
    }""",
        name,
    )
    assert 0.93 < mean < 1.07
