"""Small inputs that must be refused in one sentence, and huge ones that must be dealt with soon.

Those that are read: table_cases.py.
"""

# --- refused: (text, what else, a part of the sentence in English, in Indonesian) ---------------

REFUSED = [
    ("2026-01-01,21,5\n2026-01-02,21,7", {}, "comma may separate", "koma dapat memisahkan"),
    ("", {}, "no column of numbers", "Tidak ada kolom bilangan"),
    ("a\nb", {}, "no column of numbers", "Tidak ada kolom bilangan"),
    ("1\nx\n3", {}, "Line 2, column '1': 'x'", "Baris 2, kolom '1': 'x'"),
    ("1\nx", {}, "Line 2, column '1': 'x'", "Baris 2, kolom '1': 'x'"),
    ("1\n2 3 4", {}, "'2 3 4' is neither", "'2 3 4' bukan"),
    ("1\n=cmd|' /C calc'!A0", {}, "Line 2", "Baris 2"),
    ("12.34.5\n1", {}, "Line 1, column '1': '12.34.5'", "Baris 1, kolom '1'"),
    ("1\n#DIV/0!\n3", {}, "'#DIV/0!' is neither", "'#DIV/0!' bukan"),
    ("a;b\n0,5;12.34\n", {}, "'12.34' in line 2, '0,5' in line 2", "'12.34' di baris 2"),
    ("1,234.5\n2,345.6", {}, "comma may separate", "koma dapat memisahkan"),
    ("harga\n100.000\n120.000", {}, "may be a thousand", "dapat berarti ribuan"),
    ("1;2\n3;4;5", {}, "Line 2 has not as many cells (3)", "Banyaknya sel di baris 2 (3)"),
    (
        "1;2\n3;4;5\n6;7\n8;9",
        {},
        "Line 2 has not as many cells (3)",
        "Banyaknya sel di baris 2 (3)",
    ),
    ('"a\n1', {}, "quotation marks", "Tanda kutip"),
    ("1\ninf", {}, "'inf' is too large", "'inf' terlalu besar"),
    ("1\n1e301", {}, "'1e301' is too large", "'1e301' terlalu besar"),
    ("tanggal\n2024-01-01\n2024-01-02", {}, "no column of numbers", "Tidak ada kolom bilangan"),
    ("t;v\n0;1\n1;satu\n2;3", {}, "Line 3, column 'v': 'satu'", "Baris 3, kolom 'v': 'satu'"),
]

# --- hostile and huge: made, not written down; each must be refused or read within seconds ------

HUGE = {
    "rows": lambda: "1\n" * 1_000_000,
    "bytes": lambda: "1.23456789;" * 3 + "1\n" + "1.23456789;1;2;3\n" * 1_000_000,
    "columns": lambda: ";".join(["x"] * 100_000) + "\n" + ";".join(["1"] * 100_000),
    "equal names": lambda: ";".join(["x"] * 900) + "\n" + ";".join(["1"] * 900),
    "blanks in a header": lambda: "a" + " " * 200_000 + "b\n1\n2",
    "underscores in a header": lambda: "_" * 600_000 + "\n1\n2",
    "blanks at ends of lines": lambda: "1" + " " * 500_000 + "x\n2\n",
    "digits": lambda: "1\n" + "9" * 120_000 + "x\n3",
    "brackets": lambda: "[" * 300_000 + "1\n",
    "commas": lambda: "," * 2_000_000,
    "blank lines": lambda: "1" + "\n" * 1_000_000 + "2",
    "quotation marks": lambda: '"' * 400_001,
    "colons": lambda: "1:" * 300_000,
    "long list": lambda: "[" + "1, " * 2_000_000 + "1]",
}
