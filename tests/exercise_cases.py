"""Exercises of every kind for the tests, and answers to them: (answer, right, hints in order)."""

EXERCISES = {
    "1.1": {
        "kind": "number",
        "answer": 2.24,
        "tolerance": 0.005,
        "unit": "m/s",
        "mistakes": [
            {"answer": 2.5, "hint": {"id": "Akarnya.", "en": "The root."}},
            {"answer": -2.24, "hint": {"id": "Tandanya.", "en": "The sign."}},
        ],
        "hint": {"id": "Pertama.", "en": "First."},
        "second": {"id": "Kedua.", "en": "Second."},
        "solution": {"id": r"$v = \sqrt{5}$, jadi 2,24.", "en": r"$v = \sqrt{5}$, so 2.24."},
    },
    "1.2": {
        "kind": "choice",
        "answer": 1,
        "choices": [
            {"id": "naik", "en": "rises"},
            {"id": "turun", "en": "falls"},
            {"id": "tetap $K$", "en": "stays $K$"},
        ],
        "mistakes": [
            {"answer": 0, "hint": {"id": "Bukan naik.", "en": "It does not rise."}},
            {"answer": 2, "hint": {"id": "Bukan tetap.", "en": "It does not stay."}},
        ],
        "hint": {"id": "Pertama.", "en": "First."},
        "second": {"id": "Kedua.", "en": "Second."},
        "solution": {"id": "Turun.", "en": "It falls."},
    },
    "1.3": {
        "kind": "code",
        "answer": "np.array([[1, dt], [0, 1]])",
        "accept": ["np.array([[1,dt],[0,1.0]])"],
        "given": "import numpy as np; dt = 0.1",
        "start": "F = ",
        "mistakes": [
            {
                "answer": "np.array([[1, 0], [dt, 1]])",
                "hint": {"id": "Transpos.", "en": "Transposed."},
            },
            {"answer": "np.array([[1, dt]", "hint": {"id": "Kurung.", "en": "A bracket."}},
        ],
        "hint": {"id": "Pertama.", "en": "First."},
        "second": {"id": "Kedua.", "en": "Second."},
        "solution": {"id": "$F$.", "en": "$F$."},
    },
}

# (exercise, answer as grade() takes it, is it right?, the mistake that it is)
GRADED = [
    ("1.1", 2.24, True, None),
    ("1.1", 2.235, True, None),
    ("1.1", 2.245, True, None),
    ("1.1", 2.2450001, False, None),
    ("1.1", 2.2349999, False, None),
    ("1.1", 5**0.5, True, None),
    ("1.1", 2.495, False, 0),
    ("1.1", 2.505, False, 0),
    ("1.1", 2.51, False, None),
    ("1.1", -2.236, False, 1),
    ("1.1", 0.0, False, None),
    ("1.1", 1e300, False, None),
    ("1.2", 1, True, None),
    ("1.2", 0, False, 0),
    ("1.2", 2, False, 1),
    ("1.3", "np.array([[1, dt], [0, 1]])", True, None),
    ("1.3", " np.array( [[1,dt],[0,1]] ) ", True, None),
    ("1.3", "np.array([[1, dt], [0, 1.0]])", True, None),
    ("1.3", "np.array([[1, 0], [dt, 1]])", False, 0),
    ("1.3", "np.eye(2)", False, None),
    ("1.3", "np.array([[1, dt, 0], [0, 1, 0]])", False, None),
]

# The answers of one reader one after the other, and the hint after each; None: right
SEQUENCES = [
    ("1.1", [9, 9, 9, 9], ["hint", "second", "second", "second"]),
    ("1.1", [2.5, 9, 2.5, 2.5], [0, "hint", "second", "second"]),
    ("1.1", [2.5, 2.5, 2.5, -2.24, 2.24], [0, "hint", "second", 1, None]),
    ("1.2", [0, 2, 0, 1], [0, 1, "hint", None]),
    ("1.1", [9, 2.24, 9], ["hint", None, "second"]),
]
