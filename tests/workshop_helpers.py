"""What the tests of the workshop share: cases of filters, and what the page makes of them."""

import numpy as np

from kalman_lib.papers import workshop

nan = np.nan
OWN = workshop.OWN

# The state of the builder as a reader would have set it, before any click
START = """
  const { papers, tables } = KalmanExplorers;
  const view = papers.workshop.views.builder;
  const start = { seed: 2 };
  for (const [name, field] of Object.entries(tables.workshop)) start[name] = field.default;
  for (const { name, default: first } of view.controls) if (name) start[name] ??= first ?? null;
  Object.assign(start, view.start);
"""
SHOWN = (
    "changes => {"
    + START
    + """
  const { papers: { workshop: _ }, speaker: { speaker } } = KalmanExplorers;
  const floats = m => ({ ...m, t: Float64Array.from(m.t), acc: Float64Array.from(m.acc),
    gyr: Float64Array.from(m.gyr) });
  if (changes.motion) changes.motion = floats(changes.motion);
  const s = { ...start, ...changes }, r = view.compute(s, {}), t = speaker('en');
  if (changes.likely || changes.search) for (const step of view.refine(r, s));
  const plain = values => Array.from(values, v => Number.isNaN(v) ? null : v);
  const { n, m, x, P, y, S } = r.result;
  return { n, m, t: plain(r.data.t), note: r.data.note.en,
    x: plain(x), P: plain(P), y: plain(y), S: plain(S), found: r.found?.values ?? null,
    gated: Array.from(r.result.gated), verdict: view.outcome(r, s, t), nis: r.judged.nis,
    white: r.judged.white.map(w => ({ ...w, correlation: plain(w.correlation) })),
    kalman: _.kalmanCode(r, s, t), filterpy: _.filterpyCode(r, s, t), csv: _.csvText(r) };
}"""
)


def shown(page, **changes):
    """What the builder shows for a state; its lists are arrays."""
    answer = page.evaluate(SHOWN, changes)
    n, m = answer["n"], answer["m"]
    shapes = {"x": (-1, n), "P": (-1, n, n), "y": (-1, m), "S": (-1, m, m), "gated": (-1, m)}
    arrays = {
        name: np.array(answer[name], dtype=float).reshape(shape) for name, shape in shapes.items()
    }
    return {**answer, **arrays}


def own_data(p, seed=1, uneven=False, gaps=False, outliers=False, steps=60):
    """A pasted table of made-up data: t, z, w where there is a second column, v where a third."""
    rng = np.random.default_rng(seed)
    made = workshop.simulate(p, rng, steps)
    t = np.cumsum(rng.uniform(0.4, 2.5, steps)) if uneven else 5 + p.dt * np.arange(steps)
    z = made.z.copy()
    if gaps:
        z[3::7] = nan
        z[10:14, 0] = nan
    if outliers:
        z[20::13, 0] += 40 * np.sqrt(p.R)
    columns = {"t": t, "z": z[:, 0]}
    more = [z[:, 1]] if z.shape[1] > 1 else []
    more += [] if made.u is None else [made.u[:, 0]]
    return columns | dict(zip("wv", more))


def as_text(columns):
    """The table as it is pasted: every digit, gaps empty."""
    rows = zip(*(values.tolist() for values in columns.values()))
    cells = [["" if value != value else repr(value) for value in row] for row in rows]
    return "\n".join([";".join(columns), *(";".join(row) for row in cells)])


def pasted(columns):
    """The state of a reader who pasted it and took the columns by their names."""
    names = {"time": "t", "value": "z"}
    names |= {f"value{k}": name for k, name in ((2, "w"), (3, "v")) if name in columns}
    return {"text": as_text(columns), **names}
