"""The chapter of the toy paper, as small as the rules allow."""

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

SENTENCE = {
    "id": "Sebuah botol diisi di atas timbangan: satu keadaan, satu sensor.",
    "en": "A bottle is filled on a scale: one state, one sensor.",
}
TITLE = {"id": "# Botol: mainan", "en": "# The bottle: a toy"}
QUESTION = {
    "id": "Berapa isi botol setelah satu menit? Datanya sintetis.",
    "en": "How much is in the bottle after a minute? The data is synthetic.",
}
SLIDER_TEXT = {
    "id": "Geser debitnya, lalu ubah fungsinya.",
    "en": "Move the flow, then change the function.",
}
IMPORTS = """import numpy as np
from kalman_lib import kalman_filter, plots
from kalman_lib.exercises import check
from kalman_lib.explorer import explore
from kalman_lib.papers import toy"""
FILTER = """p = toy.Params()
run = toy.simulate(p, np.random.default_rng(1))
result = kalman_filter(toy.model(p), run.z, run.u)
t = np.arange(1, len(run.z) + 1)
plots.series(t, run.z[:, 0], result.x[:, 0], truth=run.x[:, 0])"""
GAIN = """plots.curve({"$K$": (t, result.K[:, 0, 0])}, "$t$ (s)", "$K$")"""
SLIDER = """from ipywidgets import interact

@interact(flow=(0.0, 0.1, 0.01))
def try_flow(flow=0.02):
    own = toy.Params(flow=flow)
    data = toy.simulate(own, np.random.default_rng(2))
    found = kalman_filter(toy.model(own), data.z, data.u)
    return plots.series(t, data.z[:, 0], found.x[:, 0])"""
FIGURE = {
    "alt": {
        "id": "Titik pengukuran di sekitar garis lurus yang naik.",
        "en": "Dots of measurements around a straight rising line.",
    },
    "caption": {
        "id": "Isi botol: pengukuran dan estimasi, data sintetis.",
        "en": "The mass of the bottle: measurements and estimate, synthetic data.",
    },
}
NEXT = {"id": "Pikirkan lagi.", "en": "Think again."}
SOLUTION = {"id": "Jawabannya ${answer}$.", "en": "The answer is ${answer}$."}


def exercise(kind, answer, wrong, **more):
    """The metadata of an exercise."""
    solution = {language: text.format(answer=answer) for language, text in SOLUTION.items()}
    mistakes = [{"answer": wrong, "hint": NEXT}]
    texts = {"hint": NEXT, "second": NEXT, "solution": solution}
    return {"kind": kind, "answer": answer, "mistakes": mistakes, **texts, **more}


def exercises():
    """[(question in both languages, metadata)]"""
    yes_no = [
        {"id": "ya", "en": "yes"},
        {"id": "tidak", "en": "no"},
        {"id": "bisa", "en": "may be"},
    ]
    choice_mistakes = [{"answer": 1, "hint": NEXT}, {"answer": 2, "hint": NEXT}]
    found = [
        (
            {"id": "Apakah $P$ mengecil?", "en": "Does $P$ shrink?"},
            {**exercise("choice", 0, 1, choices=yes_no), "mistakes": choice_mistakes},
        ),
        (
            {"id": "Tulislah $F$.", "en": "Write $F$."},
            exercise("code", "1", "0", accept=["1.0"], given="import numpy as np", start="F = "),
        ),
    ]
    for number in range(1, 5):
        text = {
            "id": f"Berapa kg setelah {number} s dengan 1 kg/s?",
            "en": f"How many kg after {number} s with 1 kg/s?",
        }
        found.append((text, exercise("number", number, -number, tolerance=0.1, unit="kg")))
    return found


def pair(name, text):
    """The Indonesian and the English cell of a text."""
    for language in ("id", "en"):
        cell = new_markdown_cell(text[language], metadata={"tags": [f"lang-{language}"]})
        yield {**cell, "id": f"{name}-{language}"}


def code(name, source, **metadata):
    return {**new_code_cell(source, metadata=metadata), "id": name}


def exercise_cells():
    for number, (text, about) in enumerate(exercises(), start=1):
        label = f"8.{number}"
        words = {
            "id": f"**Latihan {label}.** {text['id']}",
            "en": f"**Exercise {label}.** {text['en']}",
        }
        yield from pair(f"exercise-{number}", words)
        metadata = {"book": {"exercise": about}, "tags": ["exercise"]}
        yield code(f"exercise-{number}", f'check("{label}", ...)', **metadata)


def write(path):
    """The notebook, not yet run."""
    live = {"book": FIGURE, "tags": ["nbval-ignore-output"]}
    cells = [
        *pair("title", TITLE),
        *pair("question", QUESTION),
        code("imports", IMPORTS),
        code("explorer", 'explore("toy")', **live),
        code("filter", FILTER, book=FIGURE),
        code("gain", GAIN, book=FIGURE),
        *pair("slider-text", SLIDER_TEXT),
        code("slider", SLIDER, **live),
        *exercise_cells(),
    ]
    notebook = new_notebook(metadata={"book": {"sentence": SENTENCE}}, cells=cells)
    nbformat.write(nbformat.from_dict(notebook), path)
